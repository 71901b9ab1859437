//! Measures at many points, in rows that may be shared out; and one motion while a number glides, to be heard.

pub mod grid;
pub mod list;
pub mod measure;
pub mod sound;
pub mod sweep;

pub use self::{grid::*, list::PointList, measure::*, sound::Sound, sweep::*};
