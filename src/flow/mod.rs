//! Trajectories, half swing by half swing.
//!
//! A motion is a chain of smooth half swings glued at `v = 0`. Each is integrated in the frame of
//! [`crate::oscillator::HalfPlane`] by one of the [`Method`]s, and ends at the first root of `v` after
//! its start. No step ever crosses the switching line, so no method sees the discontinuity.

pub mod auto;
mod between;
pub mod exact;
pub mod explicit;
pub mod limits;
pub mod method;
pub mod precise;
pub mod quality;
pub mod regularized;
pub mod run;
pub mod scaling;
pub mod step;
pub mod stiff;
pub mod stop;
pub mod swing;
pub mod tableau;
pub mod taylor;
pub mod time;
pub mod time_stepping;
pub mod trajectory;
pub mod without_events;

pub use limits::{Limits, Reason};
pub use method::{METHODS, Method, MethodSpec};
pub use quality::{QUALITIES, Quality};
pub use trajectory::{Cost, Crossing, Detail, Outcome, Problem, Sample, Trajectory};
