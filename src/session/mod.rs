//! The session: a pure state machine of state, commands and keys.
//!
//! It stands on floors, and each file uses only files further down:
//!
//! - [`message`] is what can happen to a session, [`replay`] the same as text;
//! - [`state`] is plain data, with [`state::session::Session`] on top;
//! - [`read`] answers questions about the state and changes nothing;
//! - [`act`] changes the state, one family of commands per file;
//! - [`save`] and [`opening`] convert a session to text and back;
//! - `commands` and `lines` are the tables of everything that can be run by name, with the functions that do
//!   it, and [`config`] applies a settings file to the keys;
//! - `update` takes a message in.

pub(crate) mod act;
mod command_row;
pub mod commands;
pub mod config;
pub mod effect;
pub mod lines;
pub mod message;
pub mod opening;
mod press;
pub mod read;
pub mod replay;
pub mod save;
pub mod state;
#[cfg(test)]
pub(crate) mod tests;
pub mod update;

pub use commands::commands;
pub use effect::Effect;
pub use lines::lines;
pub use message::key::{self, Code, Key};
pub use message::pointer::{Gesture, Pointed, PointerTarget};
pub use message::{Msg, Notice, Purpose};
pub use press::run_line;
pub use read::contexts::Hint;
pub use read::variants::ShownMotion;
pub use read::{fate, ledger, motion, requirement};
pub use state::{
    AnswerState, BranchStop, Command, Context, Entry, Framing, Input, Kept, Keymap, LineCommand,
    List, Listed, Overlay, Pane, Pending, Plot, Price, Prompt, Row, ScanOnShow, Session, Setup,
    Size, StepSizes, Uncertainty, Waiting, keymap, overlay, scan, settings, starts,
};
pub use update::{settle, update};
