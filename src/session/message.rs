//! What goes into the machine, and what it asks of the outer rings.

use std::path::PathBuf;

use super::key::Key;
use super::replay::Script;
use super::state::Notice;
use crate::oscillator::Symbol;
use crate::scene::{Answered, Point};

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
    /// A line of the command line, without the line: `<run "set D=-0.3">` in a keystroke file.
    Run(String),
    /// What stands here is what the session starts with; these parameters belong to its scene.
    Start(Vec<Symbol>),
    /// A caption of a tour, to be shown until the next one; empty: none.
    Say(String),
    /// A file that was asked for, or why it cannot be read.
    Read {
        /// The file.
        path: PathBuf,
        /// What for.
        purpose: Purpose,
        /// Its text, or one line.
        result: Result<String, String>,
    },
    /// So much time has passed since the last such message, or since the motion is played.
    Elapsed {
        /// Seconds.
        seconds: f64,
    },
    /// The figure that was being written is, or is not.
    Written(Notice),
    /// The outer rings tell how an effect ended, such as a file written or not, or a replay.
    Told(Notice),
}

/// What a file is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To go on with the session that it holds.
    Open,
    /// The same, with one that was kept when it was interrupted.
    Restore,
    /// To press its keys.
    Play,
    /// To have its keys in a register.
    Register(char),
}

/// What the mouse did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Its left button went down.
    Click,
    /// Its wheel turned away from the user.
    Nearer,
    /// Its wheel turned towards the user.
    Farther,
}

/// The mouse on something that is on show; which cell of the screen that is, the outer rings know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointed {
    /// What the mouse did.
    pub gesture: Gesture,
    /// Where.
    pub place: Place,
}

/// A place on the screen that means something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A row of the parameter pane, counted from 0.
    Row(usize),
    /// A point of a plot, in its world coordinates; the plot by its index among those of the session.
    Plot(usize, Point),
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
    /// The same with the keys of a register: what the user types meanwhile comes after them.
    PlayRegister(Script),
    /// Have the terminal report the mouse, or leave it alone.
    Mouse(bool),
    /// Put this text on the clipboard (OSC 52) and into a file beside the session.
    Copy(String),
    /// Do the same with the characters on the screen.
    CopyScreen,
    /// Write a file as a whole; the outcome comes back as a message line.
    Write {
        /// Where.
        path: PathBuf,
        /// What.
        text: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Write what was pressed since the start as a keystroke file.
    Record {
        /// Where.
        path: PathBuf,
        /// How many presses at the end are no part of it.
        forget: u32,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Write what plots show as a figure; the ending of the file says in which form. [`Msg::Written`] comes
    /// back when that has ended.
    Figure {
        /// Where.
        path: PathBuf,
        /// The plot; `None`: all that are on show.
        plot: Option<usize>,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Stop writing a figure.
    StopWriting,
    /// Read a file; it comes back as [`Msg::Read`].
    Read {
        /// The file.
        path: PathBuf,
        /// What for.
        purpose: Purpose,
    },
    /// Put the kept file of an interrupted session aside, so that it is not offered again.
    PutAside(PathBuf),
    /// Write the rows of a scan to a file, in the form that its name ends with; a file of another scan
    /// is left alone. The outcome comes back as a message line.
    SaveScan {
        /// Where.
        path: std::path::PathBuf,
        /// The scan.
        scan: std::sync::Arc<crate::study::scan::Scan>,
        /// Its rows, from the first point on.
        rows: Vec<crate::study::scan::Row>,
    },
}
