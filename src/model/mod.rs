//! The oscillator of the paper: its parameters, its field on each side of `v = 0`, its segment of
//! equilibria and its energy, and the machine that it describes.
//!
//! The model is `q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q in f_R` (equations 4 and 5) with set-valued dry
//! friction of intensity `r`. Everything here is a formula; nothing is integrated.
//!
//! ```
//! use hopfscope::model::{Belt, Parameters, belt::FrictionLaw};
//!
//! // A mass of 2 kg on a belt at 0.25 m/s, whose friction falls with the velocity.
//! let belt = Belt {
//!     mass: 2.0,
//!     stiffness: 800.0,
//!     damping: 3.0,
//!     cubic_damping: 40.0,
//!     normal_force: 60.0,
//!     friction: 1.5,
//!     belt_speed: 0.25,
//!     law: FrictionLaw::Polynomial { coefficients: vec![0.5, -0.6, 0.8] },
//!     static_coefficient: None,
//!     static_guide: None,
//! };
//! let Parameters { d, r, .. } = belt.reduce().unwrap().parameters;
//! assert!(d < 0.0, "the belt feeds the motion");
//! // r = R/(F mu(v0)).
//! assert!((r - 1.5 / (60.0 * 0.4)).abs() < 1e-15);
//! ```

pub(crate) mod basin;
pub(crate) mod force;
#[expect(clippy::module_inception, reason = "the model itself, beside what belongs to it")]
pub(crate) mod model;
pub(crate) mod reach;
pub(crate) mod reason;
pub(crate) mod source;

pub mod belt;
pub(crate) mod half_plane;
pub(crate) mod interval;
pub(crate) mod knob;
pub(crate) mod modal;
pub(crate) mod parameters;
#[doc(hidden)]
pub mod unit;

pub(crate) use self::{
    belt::*, force::*, knob::*, model::*, parameters::*, reach::*, source::*, unit::*,
};
pub use basin::{Border, Kicks, Margin, Reach, RestKicks, RestMargin};
pub use belt::Belt;
pub use half_plane::{Field, HalfPlane, PlaneField, Side};
pub use interval::{Interval, ParameterBox};
pub use knob::{Group, KNOBS, Knob, KnobSpec, RangeError};
pub use modal::Mode;
pub use model::{ContactState, Lines, Model, Phase};
pub use parameters::{Ledger, Parameters, State, Work};
pub use reason::{Reason, Result};
pub use source::{Body, Source, Tolerances};
