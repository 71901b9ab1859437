//! What goes into the machine, and what it asks of the outer rings.

pub mod key;
pub mod pointer;

use std::path::PathBuf;

use crate::oscillator::Symbol;
use crate::question::Failure;
use crate::scene::{Answer, Answered, Request};
use crate::session::message::key::Key;
use crate::session::message::pointer::Pointed;

/// Everything that can happen to a session.
#[derive(Clone, Debug)]
pub enum Msg {
    /// A key was pressed.
    Key(Key),
    /// Text was pasted, all at once.
    Paste(String),
    /// The mouse did something.
    Pointed(Pointed),
    /// The screen has this size now, in cells.
    Resize { width: u16, height: u16 },
    /// The worker answered a request, or failed to.
    Answered(Box<Answered>),
    /// The worker has nothing left to do (sent after the last answer).
    Idle,
    /// A line of the command line, without the line: `<run "set D=-0.3">` in a keystroke file.
    Run(String),
    /// What stands here is what the session starts with; these parameters belong to its scene.
    Start(Vec<Symbol>),
    /// A caption of a tour, to be shown until the next one; empty: none. With it which it is of how many,
    /// where that is known.
    Say(String, Option<(usize, usize)>),
    /// A file that was asked for, or why it cannot be read.
    Read {
        path: PathBuf,
        purpose: Purpose,
        /// Its text, or one line.
        result: Result<String, String>,
    },
    /// So much time has passed since the last such message, or since the motion is played.
    Elapsed { seconds: f64 },
    /// The figure that was being written is, or is not.
    Written(Notice),
    /// The outer rings tell how an effect ended, such as a file written or not, or a replay.
    Told(Notice),
}

impl Msg {
    /// The whole answer to a request, or why there is none, and the seconds that it took.
    pub fn answered(request: Request, result: Result<Answer, Failure>, seconds: f64) -> Self {
        Msg::Answered(Box::new(Answered { request, result, seconds, complete: true }))
    }
}

/// What a file is read for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To go on with the session that it holds.
    Open,
    /// The same, with one that was kept when it was interrupted.
    Restore,
    /// To press its keys.
    Play,
    /// To have its keys in a register.
    Register(char),
    /// To be fitted, as a record of a motion, with what else was said about it.
    Fit(String),
    /// To be looked at, as a machine.
    Machine,
    /// The table of friction that a machine names.
    Table {
        /// The file of the machine.
        path: PathBuf,
        machine: String,
    },
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Whether something was refused or failed.
    pub error: bool,
    pub text: String,
}
