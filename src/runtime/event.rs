//! Events of the running program, and those that stop the loop.

use crate::session::{Gesture, Msg};

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
    /// The process is asked to stop until it is continued.
    Suspend,
    /// The process continues after having been stopped.
    Continued,
    /// A signal asks the program to end.
    Ended { signal: i32 },
    /// There will be no more input: the terminal is gone.
    Closed,
}

/// Why the loop ended or paused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}
