//! Measures at many points, in rows that may be shared out.

pub mod grid;
pub mod measure;
pub mod sweep;

pub use self::{grid::*, measure::*, sweep::*};
