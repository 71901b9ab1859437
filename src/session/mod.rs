//! The session: a pure state machine of state, commands and keys.
//!
//! It stands on floors, and each file uses only files further down, but for the default keys of a session, which
//! `commands` knows:
//!
//! - [`message`] is what can happen to a session, [`replay`] the same as text;
//! - [`state`] is plain data, with [`state::session::Session`] on top;
//! - [`read`] answers questions about the state and changes nothing;
//! - [`act`] changes the state, one family of commands per file, and runs commands and typed lines in `act/run.rs`;
//! - [`save`] converts a session to text and back, [`study`] to a scene file of which figures are made;
//! - `commands` is the table of everything that can be run by name, with the functions that do it, and [`config`]
//!   applies a settings file to the keys;
//! - `update` takes a message in.

pub(crate) mod act;
pub mod commands;
pub mod config;
pub mod key;
pub mod message;
pub mod read;
pub mod replay;
pub mod save;
pub mod state;
pub mod study;
#[cfg(test)]
pub(crate) mod tests;
pub mod update;

pub use self::{message::*, read::contexts::*, read::kick::*, read::lists::*};
pub use self::{read::machine::*, read::plots::*};
pub use act::files::LESSONS;
pub use act::run::run_line;
pub use commands::commands;
pub use key::{Code, Key};
pub use read::answers::NoErrorReason;
pub use read::{fate, ledger, motion, number_line, wants};
pub use replay::script::{Instruction, Script, ScriptStep};
pub use state::{answers::*, history::*, keymap::*, overlay::*, scan::*};
pub use state::{overlay, scan, session::*, settings, settings::*, setup::*};
pub use update::{settle, update};
