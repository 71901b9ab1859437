//! Saved sessions: the complete state of a session as a TOML file.
//!
//! What the user made is saved: scene, motion, steps, plots, layers, marks, typed lines and the
//! history. Answers are not saved, because they follow from the rest. The appearance of the screen belongs to
//! the terminal, and the keys to the settings file. A field of `Session` that must survive the program has its
//! place here.

mod file;
mod read;
mod write;

pub use read::{open, summary};
pub use write::text;
