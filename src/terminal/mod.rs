//! The terminal: what it can do, its modes, and the way of a frame to it.
//!
//! - [`capabilities`]: what the environment says the terminal can show;
//! - [`guard`]: the modes that the explorer turns on, turned off again whatever happens;
//! - [`painter`]: changed cells to bytes, each frame one write; with `strokes`, the order and the
//!   cursor moves that cost least, and [`pen`], the shortest change of colours;
//! - [`pacing`]: when the next frame may be sent;
//! - [`screen`]: painter and pacing in one place, for the loop to draw on.

pub mod capabilities;
pub mod guard;
pub mod pacing;
pub mod painter;
pub mod pen;
pub mod screen;
mod strokes;

pub use capabilities::{Environment, Refusal};
pub use guard::Guard;
pub use screen::Screen;
