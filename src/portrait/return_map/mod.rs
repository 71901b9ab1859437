//! The return map of a machine on its belt, which never decreases: it orders all cycles, and what a start ends as is
//! read off the next turning point.

pub(crate) mod fixed_points;
pub mod machine_return;
pub(crate) mod portrait;

pub(crate) use self::{fixed_points::*, machine_return::*};
