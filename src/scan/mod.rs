//! Measures at many points, in rows that may be shared out; the curves over two numbers along which a measured number has a
//! value; and one motion while a number glides, to be heard.

pub mod grid;
pub mod level;
pub mod measure;
pub mod sound;
pub mod sweep;

pub use self::{grid::*, level::*, measure::*, sound::Sound, sweep::*};
