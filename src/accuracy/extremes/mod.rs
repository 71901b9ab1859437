//! Motions at the edges of what floating-point numbers and the equation allow, and how well they are
//! answered.
//!
//! [`lattice`] lists them: every combination of a few extreme values of each parameter with a few extreme
//! starts. [`verdict`] follows each by every event-driven method and says what it answered, how many of
//! the digits asked for it lost, and at what cost. Nothing is left out for being answered badly. A few more
//! have names and known answers ([`mod@named`]). [`mod@sets`] asks for the limit cycles at the same parameters.

pub mod lattice;
pub mod named;
pub mod sets;
pub mod verdict;

pub(crate) use lattice::*;
pub use lattice::{Case, cases};
pub use named::{NamedExtreme, named};
pub use sets::{SetVerdict, judge_set, sets};
pub use verdict::{MethodAnswer, MethodsVerdict, judge};
