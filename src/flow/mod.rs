//! Trajectories, half swing by half swing.
//!
//! A motion is a chain of smooth half swings glued at `v = 0`. Each is integrated in the frame of
//! [`crate::model::HalfPlane`] by one of the [`Method`]s, and ends at the first root of `v` after
//! its start. No step ever crosses the switching line, so no method sees the discontinuity.
//!
//! ```
//! use hopfscope::flow::{Detail, Limits, Outcome, Problem, trajectory::trajectory};
//! use hopfscope::model::{Parameters, State};
//!
//! let problem = Problem {
//!     parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.5 },
//!     initial: State { q: 2.0, v: 0.0 },
//!     ..Problem::default()
//! };
//! let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
//! assert_eq!(motion.crossings.len(), 3);
//! assert!(matches!(motion.outcome, Outcome::Captured { q, .. } if (q + 0.116_144).abs() < 1e-6));
//! ```

pub(crate) mod at_times;
pub(crate) mod auto;
pub(crate) mod comparison;
pub(crate) mod exact;
pub(crate) mod explicit;
pub(crate) mod limits;
#[doc(hidden)]
pub mod machine;
#[doc(hidden)]
pub mod method;
pub(crate) mod motion;
#[doc(hidden)]
pub mod precise;
#[doc(hidden)]
pub mod quality;
pub(crate) mod step;
pub(crate) mod stiff;
pub(crate) mod stop;
pub(crate) mod subject;
pub(crate) mod swing;
pub(crate) mod tableau;
pub(crate) mod taylor;
pub mod trajectory;

pub(crate) use self::{
    auto::*, comparison::*, exact::*, explicit::*, machine::*, precise::*, step::*, stiff::*,
    stop::*, swing::*, tableau::*, taylor::*, trajectory::*,
};
pub use crate::model::{Reason, Result};
pub use limits::{Fate, Limits};
pub use machine::arc::Flow;
pub use machine::motion::{MotionUnits, follow};
pub use method::{METHODS, Method, MethodSpec};
pub use motion::{Cost, Crossing, Detail, Leg, Motion, Outcome, Problem, Sample};
pub use quality::{DRAFT, QUALITIES, Quality};
pub use subject::Subject;
