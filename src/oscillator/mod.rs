//! The oscillator of the paper: its parameters, its field on each side of `v = 0`, its segment of
//! equilibria and its energy, and the machine that it describes.
//!
//! The model is `q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q in f_R` (equations 4 and 5) with set-valued dry
//! friction of intensity `r`. Everything here is a formula; nothing is integrated.

pub mod belt;
pub mod energy;
pub mod half_plane;
pub mod interval;
pub mod parameters;
pub mod scaling;
pub mod sticking;

pub use belt::Belt;
pub use energy::Ledger;
pub use half_plane::{HalfPlane, Side};
pub use interval::{Interval, ParameterBox};
pub use parameters::{PARAMETERS, ParameterSpec, Parameters, State, Symbol};
