//! Machines by the whole model: friction by its own law, sticking to the belt, and overtaking it.
//!
//! ```
//! use hopfscope::machine::Model;
//! use hopfscope::oscillator::{Belt, belt::FrictionLaw};
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

#[warn(clippy::missing_errors_doc)]
pub(crate) mod arc;
pub(crate) mod border;
#[doc(hidden)]
pub mod branch;
#[doc(hidden)]
pub mod by_method;
pub(crate) mod curve;
#[warn(clippy::missing_errors_doc)]
pub(crate) mod cycles;
pub(crate) mod design;
mod force;
#[doc(hidden)]
pub mod guarantee;
#[doc(hidden)]
pub mod jumps;
pub(crate) mod landmarks;
pub(crate) mod law;
pub(crate) mod ledger;
pub mod lost;
mod modal;
#[warn(clippy::missing_errors_doc)]
pub(crate) mod model;
#[doc(hidden)]
pub mod motion;
pub(crate) mod problem;
mod reach;
#[doc(hidden)]
pub mod return_map;
pub(crate) mod search;
mod series;
#[doc(hidden)]
pub mod special;
#[doc(hidden)]
pub mod stepped;
pub(crate) mod subject;
#[doc(hidden)]
pub mod survey;
pub(crate) mod tolerance;
#[doc(hidden)]
pub mod trade;
#[doc(hidden)]
pub mod turn;

pub use crate::oscillator::Modal;
pub use arc::{Flow, LostMotion};
pub use ledger::MachineLedger;
pub use model::{Lines, Model, NoModel, Phase};
pub use motion::MachineMotion;
pub use problem::MachineProblem;
pub use series::ORDER;
pub use subject::{Body, Subject};
pub use tolerance::Tolerances;
