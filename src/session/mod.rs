//! The session: a pure state machine of state, commands and keys.
//!
//! It stands on floors, and each file uses only files further down, but for the default keys of a session, which
//! `commands` knows:
//!
//! - [`message`] is what can happen to a session, [`replay`] the same as text;
//! - [`state`] is plain data, with [`state::session::Session`] on top;
//! - [`read`] answers questions about the state and changes nothing;
//! - [`act`] changes the state, one family of commands per file, and runs commands and typed lines in `act/run.rs`;
//! - [`save`] converts a session to text and back;
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
#[cfg(test)]
pub(crate) mod tests;
pub mod update;

pub use act::run::run_line;
pub use commands::commands;
pub use key::{Code, Key};
pub use message::{
    Content, Done, Effect, Gesture, MouseAction, Msg, Notice, PointerTarget, Purpose,
};
pub use read::answers::NoErrorReason;
pub use read::contexts::Hint;
pub use read::lists::PaletteRow;
pub use read::machine::MachineMargins;
pub use read::plots::{ShownMotion, VariantTag};
pub use read::{fate, ledger, motion, wants};
pub use replay::script::{Instruction, Script, ScriptStep};
pub use state::answers::{AnswerState, Answers, Course};
pub use state::history::{Bookmark, Bookmarks, EarlierState, History, ScreenSetup, Snapshot};
pub use state::keymap::{Candidates, Command, CommandAction, Context, Keymap};
pub use state::overlay::{Completion, Input, List, ListKind, Overlay, Prompt, SessionCaption};
pub use state::scan::{ScanOnShow, ScanProgress};
pub use state::session::{
    BranchStop, Framing, KeptSession, Pace, Pane, PendingInput, Playback, Plot, Price,
    Recomputation, Session, Size, WaitingPress,
};
pub use state::setup::{MOST_MOTIONS, Row, Setup, StepSizes, Uncertainty};
pub use state::{overlay, scan, settings};
pub use update::{settle, update};
