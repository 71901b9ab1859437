//! Keystroke files: a session as text that people can read, write and play.
//!
//! `parse` reads a whole file before anything runs. A `Player` decides on the next action, whether the keys go
//! to a session without a terminal or into the running explorer. A [`Recorder`] writes the file of a live
//! session. The notation of keys is that of [`super::key`].

pub mod player;
pub mod recorder;
pub mod script;

pub use player::{Action, Player};
pub use recorder::{HEADER, Recorder, comment, heading, lines, text};
pub use script::{ANSWERS, Instruction, LONGEST, Script, ScriptError, ScriptStep, parse};
