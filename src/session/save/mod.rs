//! Saved sessions: everything that a session is, as a TOML file, and back.
//!
//! What is saved is what the user made: scene, motion, steps, plots, layers, marks, registers, typed lines
//! and the history. Answers are not: they follow from the rest. How the screen looks belongs to the
//! terminal, and which key means what to the settings. A field of `Session` that should survive the
//! program has its place here.

mod file;
mod read;
mod write;

pub use read::{open, summary};
pub use write::text;
