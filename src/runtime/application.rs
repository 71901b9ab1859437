//! What the loop runs.

use std::path::Path;

use ratatui::Frame;
use ratatui::layout::Size;

use super::figure_writer::Work;
use crate::scene::Request;
use crate::session::{Effect, Msg, Place};

/// A session and the way it is drawn; tests have simpler ones.
pub trait Application {
    fn update(&mut self, msg: Msg) -> Vec<Effect>;

    /// The requests to be computed now: wanted, and neither answered nor failed.
    fn wants(&self) -> Vec<Request>;

    /// Whether the passing of time changes the state, so that it wants to be told of it.
    fn is_moving(&self) -> bool {
        false
    }

    /// Whether a press waits for an answer: then everything that the user does has to wait.
    fn is_waiting(&self) -> bool {
        false
    }

    /// How many presses the last command took that asked for something outside.
    fn asked(&self) -> u32 {
        1
    }

    /// What a cell of a screen of this size stands for, if anything.
    fn place(&self, _size: Size, _column: u16, _row: u16) -> Option<Place> {
        None
    }

    /// What to keep of it if it is interrupted, as the text of a file; `None`: nothing would be missed.
    fn what_to_keep(&self) -> Option<String> {
        None
    }

    /// Makes a figure of what it shows, or of one plot of it, in the form that the ending of a file asks
    /// for; the work is done elsewhere.
    ///
    /// # Errors
    /// One line that says why there is none.
    fn figure(&self, _path: &Path, _plot: Option<usize>) -> Result<Work, String> {
        Err("nothing to write".to_owned())
    }

    fn draw(&self, frame: &mut Frame);
}
