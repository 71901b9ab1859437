//! The messages that a session takes in, and the effects that it asks of the outer rings.

use std::path::PathBuf;
use std::sync::Arc;

use strum::IntoStaticStr;

use crate::model::Knob;
use crate::question::NoAnswer;
use crate::scan::{Scan, ScanRow};
use crate::scene::{Finding, Point, Reply, Request};
use crate::session::{Key, Script};

/// A message: anything that can happen to a session.
#[derive(Clone, Debug, PartialEq)]
pub enum Msg {
    /// A key was pressed.
    Key(Key),
    /// Text was pasted in one piece.
    Paste(String),
    /// The mouse did something.
    Pointed(MouseAction),
    /// The new size of the screen, in cells.
    Resize { width: u16, height: u16 },
    /// The worker answered a request, or failed to.
    Answered(Box<Reply>),
    /// A line of the command line, run without opening it: `<run "set D=-0.3">` in a keystroke file.
    Run(String),
    /// The present state is the start of the session; these parameters belong to its scene.
    Start(Vec<Knob>),
    /// A caption of a tour, shown until the next one; an empty one ends that. If known, the number of the
    /// caption and the number of all captions.
    Say(String, Option<(usize, usize)>),
    /// A question about what is on the screen, with its answer, or a task, which has none; its place is that of a caption.
    Ask { text: String, answer: Option<Key>, place: Option<(usize, usize)> },
    /// The chapter to which the next captions belong.
    Chapter(String),
    /// A requested file, or why it cannot be read.
    Read {
        path: PathBuf,
        purpose: Purpose,
        /// Its text, or one line that says why there is none.
        result: Done<String>,
    },
    /// Time that has passed since the last such message, or since the motion began to play; none where only what follows from
    /// the state is to be found.
    Elapsed { seconds: f64 },
    /// The outcome of writing what takes time to make.
    Written(Notice),
    /// The outcome of another effect, such as writing a file or playing a replay.
    Told(Notice),
}

impl Msg {
    /// The complete answer to a request, or why there is none, and the seconds that it took.
    pub fn answered(request: Request, result: Result<Finding, NoAnswer>, seconds: f64) -> Self {
        Msg::Answered(Box::new(Reply { request, result, seconds, complete: true }))
    }
}

/// The purpose of reading a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To continue the session that it holds.
    Open,
    /// To continue a session that was kept when it was interrupted.
    Restore,
    /// To play its keys.
    Play,
    /// To fit the record of a motion that it holds; the text has further options.
    Fit(String),
    /// To open the machine that it describes.
    Machine,
    /// To read the table of friction that a machine refers to.
    Table {
        /// The file of the machine.
        path: PathBuf,
        machine: String,
    },
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Whether it reports a refusal or a failure.
    pub error: bool,
    pub text: String,
}

impl From<Done<String>> for Notice {
    fn from(told: Done<String>) -> Self {
        let error = told.is_err();
        Notice { error, text: told.unwrap_or_else(|why| why) }
    }
}

/// What the mouse did, by its word in keystroke files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Gesture {
    /// The left button was pressed.
    Click,
    /// The wheel turned away from the user.
    Nearer,
    /// The wheel turned towards the user.
    Farther,
}

/// The mouse on a target; the outer rings determine it from the cell of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MouseAction {
    /// What the mouse did.
    pub gesture: Gesture,
    pub place: PointerTarget,
}

/// A part of the screen that reacts to the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointerTarget {
    /// A row of the parameter pane, counted from 0.
    Row(usize),
    /// A point of a plot, in its world coordinates; the plot by its index among those of the session.
    Plot(usize, Point),
}

/// Nothing or a value, or one line that says why there is none.
pub type Done<T = ()> = Result<T, String>;

/// An effect for the outer rings; `update` itself touches nothing outside the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// End the program with exit code 0.
    Quit,
    /// Stop the process as Ctrl-Z does; repaint when it continues.
    Suspend,
    /// Repaint everything, because the screen may be disturbed.
    Repaint,
    /// Play these keys, as if they were typed, before anything else.
    Play(Script),
    /// Turn mouse reports of the terminal on or off.
    Mouse(bool),
    /// Put this text on the clipboard (OSC 52) and into a file beside the session.
    Copy(String),
    /// Put the characters on the screen there, too.
    CopyScreen,
    /// Write a file; the outcome comes back as a notice, that of
    /// [`Content::Computed`] as `Msg::Written`.
    Write {
        path: PathBuf,
        content: Content,
        /// Whether a file with other content may be replaced. A recording may be in any case; rows continue a file of the
        /// same scan and leave any other alone, whatever this says.
        replace: bool,
    },
    /// Stop what is being made.
    StopWriting,
    /// Read a file; its text comes back as `Msg::Read`.
    Read { path: PathBuf, purpose: Purpose },
    /// Put the kept file of an interrupted session aside, so that it is not offered again.
    PutAside(PathBuf),
}

/// What is written to a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A complete text.
    Text(String),
    /// All input since the start as a keystroke file, except so many presses at the end.
    Record { forget: u32 },
    /// The rows of a scan, beginning with the first point, in the form given by the file's extension.
    Scan(Arc<Scan>, Vec<ScanRow>),
    /// What takes time to make; only one such file is in work at a time.
    Computed(ComputedContent),
}

/// What is computed once more, to be written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ComputedContent {
    /// A figure of this plot, or of all that are on show, in the format that the file's extension asks for.
    Figure { plot: Option<usize> },
    /// What is on show as a page, and beside it, ending in .cast, how the session came there, without so many presses at the
    /// end.
    Page { forget: u32 },
    /// The motion on show, to be heard.
    Sound,
}
