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
#[doc(hidden)]
pub mod kicks;
pub(crate) mod on_belt;
#[doc(hidden)]
pub mod proved;
#[doc(hidden)]
pub mod return_map;

mod border;
mod cycle;
#[expect(clippy::module_inception, reason = "the portrait itself, beside what belongs to it")]
mod portrait;
mod without_belt;

pub use basin::capture::bands;
pub(crate) use basin::cycle::picture_reach;
pub use basin::cycle::{Cycles, Drawing, cycles};
pub use basin::stability::Share;
pub use basin::{Counts, StartWindow};
pub use border::Edge;
pub(crate) use closing::all::{STEP, all_closings, closings};
pub(crate) use closing::balance::weighed_closing;
pub(crate) use closing::equation::{Equation, Route, WayFromRim, first_side};
pub(crate) use closing::half_map::{Direction, Length};
pub(crate) use closing::pair::SwingPair;
pub(crate) use closing::polish::polish_near;
pub use closing::return_map::{Return, ReturnMap};
pub(crate) use closing::search::Node;
pub(crate) use closing::weak::weak_closing;
pub use cycle::{Cycle, CycleErrors, Ride};
pub(crate) use design::{FrictionNeed, Kick, friction_for};
pub(crate) use kicks::RandomKick;
pub(crate) use kicks::repeated::Survival;
pub use portrait::Portrait;

// They stand in the model so that the proofs, which share nothing with this ring, say the same words.
pub use crate::model::{Border, Kicks, Margin, Reach, RestMargin};
