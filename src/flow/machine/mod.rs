//! Motions of a machine by the whole model: friction by its own law, two switching lines, riding on the belt and
//! overtaking it.

pub(crate) mod arc;
pub(crate) mod curve;
pub(crate) mod levels;
pub mod motion;
pub(crate) mod series;
pub mod stepped;
pub mod turn;

pub(crate) use self::{arc::*, curve::*, series::*, turn::*};
