//! The terminal: its capabilities, its modes, and the path of a frame to it.
//!
//! - [`capabilities`]: what the environment says the terminal can show;
//! - [`guard`]: the modes that the explorer turns on, and that are turned off again in every case;
//! - [`screen`]: converts changed cells to bytes, each frame in one write; with `strokes`, the cheapest order
//!   and cursor moves, and [`pen`], the shortest change of colours;
//! - [`cast`]: frames as a file that plays;
//! - [`pacing`]: when the next frame may be sent;
//! - [`system`]: what each system does with a terminal.

pub mod capabilities;
pub mod cast;
pub mod guard;
pub mod pacing;
pub mod pen;
pub mod screen;
mod strokes;
#[cfg_attr(windows, path = "windows/system.rs")]
pub mod system;

pub use capabilities::Environment;
pub use cast::Cast;
pub use guard::Guard;
pub use screen::Screen;
