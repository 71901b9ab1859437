//! The interface of what the loop runs, the events to which it reacts, and why it ends.

use std::io;
use std::path::Path;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};

use super::Work;
use crate::scene::Request;
use crate::session::replay::{Recorder, ScriptError};
use crate::session::{ComputedContent, Effect, Gesture, Key, Msg, PointerTarget, Session, save};
use crate::terminal::Cast;
use crate::view;

/// A session and how it is drawn; tests have simpler implementations.
pub trait Application {
    fn update(&mut self, msg: Msg) -> Vec<Effect>;

    /// The session that runs; `None` where a test has something simpler.
    fn session(&self) -> Option<&Session> {
        None
    }

    /// The requests to compute now: those that are wanted and have neither an answer nor a failure.
    fn wants(&self) -> Vec<Request> {
        let Some(session) = self.session() else { return Vec::new() };
        let mut wants = session.wants();
        wants.retain(|request| session.is_open(request));
        wants
    }

    /// Whether the state changes with time, so that it must be told how much time has passed.
    fn is_moving(&self) -> bool {
        self.session().is_some_and(Session::is_moving)
    }

    /// Whether a command waits for an answer: all further input of the user must then wait, too.
    fn is_waiting(&self) -> bool {
        self.session().is_some_and(|session| session.waiting.is_some())
    }

    /// Whether a key has its usual effect while a caption is shown, instead of continuing the replay.
    fn tries(&self, key: Key) -> bool {
        self.session().is_some_and(|session| session.tries(key))
    }

    /// Number of key presses of the last command that asked for something outside the session.
    fn asked(&self) -> u32 {
        self.session().map_or(1, |session| session.asked)
    }

    /// The target at a cell of a screen of this size, if there is one.
    fn place(&self, size: Size, column: u16, row: u16) -> Option<PointerTarget> {
        let screen = Rect::from((Position::ORIGIN, size));
        view::place(screen, self.session()?, Position { x: column, y: row })
    }

    /// The text of a file that preserves its state for the case of an interruption; `None` if nothing would be
    /// lost.
    fn what_to_keep(&self) -> Option<String> {
        let session = self.session().filter(|session| session.is_worth_keeping())?;
        save::text(session).ok()
    }

    /// Prepares what takes time to make; the returned work makes it. `keys` is what was pressed so far. Fails with one line
    /// that says why there is none.
    fn make(
        &self,
        _path: &Path,
        _content: ComputedContent,
        _keys: &Recorder,
    ) -> Result<Work, String> {
        Err("nothing to write".to_owned())
    }

    /// Whether the background colour of the terminal matters and is unknown.
    fn asks_for_background(&self) -> bool {
        false
    }

    /// Sets whether the background of the terminal is light.
    fn background(&mut self, _is_light: bool) {}

    /// Its picture at this size.
    fn picture(&self, size: Size) -> Buffer;
}

/// An event to which the loop must react.
#[derive(Clone, Debug)]
pub enum Event {
    /// Something for the session.
    Session(Msg),
    /// The mouse did something in a cell of the screen; column and row count from 0.
    Mouse { gesture: Gesture, column: u16, row: u16 },
    /// A cursor position report: the terminal has shown everything sent before the request.
    Shown,
    /// The terminal reported whether its background is light.
    Background { is_light: bool },
    /// The terminal's size may have changed.
    Resized,
    /// Something that ends or pauses the loop.
    End(LoopEnd),
}

/// Why the loop ended or paused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LoopEnd {
    /// The user has left.
    Quit,
    /// The user wants the job to be stopped, as Ctrl-Z does.
    Suspend,
    /// The user wants the mouse reported, or left alone.
    Mouse(bool),
    /// A signal asks this process to stop until it is continued.
    Suspended,
    /// The process continues after a stop.
    Continued,
    /// A signal ends the program.
    Ended { signal: i32 },
    /// The terminal is gone.
    Closed,
    /// The terminal cannot be used any more: it cannot be written to, or the thread that reads it has panicked, with
    /// this message.
    Broken(String),
}

impl From<io::Error> for LoopEnd {
    /// If the terminal is gone, writing to it fails before the signal arrives.
    fn from(error: io::Error) -> Self {
        /// `EIO` of every Unix; of Windows the number of a console that is not admitted any more.
        const GONE: i32 = 5;
        if error.raw_os_error() == Some(GONE) {
            LoopEnd::Closed
        } else {
            LoopEnd::Broken(error.to_string())
        }
    }
}

/// The result of a keystroke file that was played without a terminal.
pub struct ReplayResult<M> {
    /// The application at the end.
    pub application: M,
    /// The last picture; [`crate::view::screen::text`] has its characters.
    pub screen: Buffer,
    /// The pictures that the file asks for by name, in its order.
    pub kept: Vec<(String, Buffer)>,
    /// The first expectation that was not met; playing ended there.
    pub unmet: Option<ScriptError>,
    /// Why the first file that was to be written was not.
    pub unwritten: Option<String>,
    /// All frames, if they were asked for.
    pub cast: Option<Cast>,
}
