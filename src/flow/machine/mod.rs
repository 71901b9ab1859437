//! Motions of a machine by the whole model: friction by its own law, two switching lines, riding on the belt and
//! overtaking it.

#[warn(clippy::missing_errors_doc)]
pub(crate) mod arc;
pub(crate) mod curve;
pub(crate) mod levels;
#[doc(hidden)]
pub mod motion;
pub(crate) mod series;
#[doc(hidden)]
pub mod stepped;
#[doc(hidden)]
pub mod turn;
