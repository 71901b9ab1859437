//! What goes into the machine, and what it asks of the outer rings.

use super::key::Key;
use super::replay::Script;
use super::state::Notice;
use crate::scene::Answered;

/// Everything that can happen to a session.
#[derive(Clone, Debug)]
pub enum Msg {
    /// A key was pressed.
    Key(Key),
    /// Text was pasted, all at once.
    Paste(String),
    /// The screen has this size now, in cells.
    Resize {
        /// Columns.
        width: u16,
        /// Rows.
        height: u16,
    },
    /// The worker answered a request, or failed to.
    Answered(Box<Answered>),
    /// The worker has nothing left to do (sent after the last answer).
    Idle,
    /// The outer rings tell how an effect ended, such as a file written or not, or a replay.
    Told(Notice),
}

/// What a session asks of the outer rings; `update` itself touches nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// End the program with exit code 0.
    Quit,
    /// Stop the process as Ctrl-Z does; repaint when it goes on.
    Suspend,
    /// Repaint everything (the screen may be disturbed).
    Repaint,
    /// Play these keys, as if they were typed, before anything else.
    Play(Script),
    /// Put this text on the clipboard (OSC 52) and into a file beside the session.
    Copy(String),
    /// Write a file; the outcome comes back as a message line.
    Write {
        /// Where.
        path: std::path::PathBuf,
        /// What.
        text: String,
    },
}
