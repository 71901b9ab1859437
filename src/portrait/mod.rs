//! What an oscillator does: its limit cycles, what borders the basin of rest, and the kicks that it survives.
//!
//! ```
//! use hopfscope::model::{Belt, Model, belt::FrictionLaw};
//! use hopfscope::portrait::Portrait;
//!
//! let belt = Belt {
//!     mass: 1.0,
//!     stiffness: 1.0,
//!     damping: 0.0,
//!     cubic_damping: 0.0,
//!     normal_force: 1.0,
//!     friction: 0.0,
//!     belt_speed: 0.5,
//!     law: FrictionLaw::Constant { mu: 0.2 },
//!     static_coefficient: Some(0.4),
//!     static_guide: None,
//! };
//! let model = Model::new(&belt).unwrap();
//! // Stick-slip: the belt carries the mass until friction at rest no longer holds it.
//! let lines = model.lines.unwrap();
//! assert!((lines.release - 0.2).abs() < 1e-15);
//! let portrait = Portrait::of(&model).unwrap();
//! assert!(portrait.cycles.iter().any(|cycle| cycle.stable && cycle.sticks()));
//! ```

pub mod basin;
#[doc(hidden)]
pub mod closing;
#[doc(hidden)]
pub mod design;
#[doc(hidden)]
pub mod guarantee;
pub mod kicks;
pub(crate) mod on_belt;
#[doc(hidden)]
pub mod proved;
pub mod return_map;

mod border;
mod cycle;
#[expect(clippy::module_inception, reason = "the portrait itself, beside what belongs to it")]
mod portrait;
mod without_belt;

pub use basin::capture::bands;
pub use basin::cycle::{Cycles, Drawing, cycles};
pub use basin::stability::Share;
pub use basin::{Counts, StartWindow};
pub use border::Edge;
pub use closing::return_map::{Return, ReturnMap, return_map};
pub use cycle::{Cycle, CycleErrors, Ride};
pub use portrait::Portrait;

pub(crate) use self::{
    basin::*, closing::*, design::*, guarantee::*, kicks::*, on_belt::*, portrait::*, proved::*,
    return_map::*, without_belt::*,
};
// They stand in the model so that the proofs, which share nothing with this ring, say the same words.
pub use crate::model::{Border, Kicks, Margin, Reach, RestMargin};
