//! What can happen to the running program.

use crate::session::Msg;

/// Something that the loop must react to.
#[derive(Clone, Debug)]
pub enum Event {
    /// Something for the session.
    Session(Msg),
    /// A cursor position report: the terminal has shown everything sent before the request.
    Shown,
    /// The terminal's size may have changed.
    Resized,
    /// The process is asked to stop until it is told to go on.
    Suspend,
    /// The process goes on after having been stopped.
    Continued,
    /// A signal asks the program to end.
    Ended {
        /// Its number.
        signal: i32,
    },
    /// There will be no more input: the terminal is gone.
    Closed,
}
