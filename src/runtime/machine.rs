//! What the loop runs.

use ratatui::Frame;

use crate::scene::Request;
use crate::session::{Effect, Msg};

/// A session and the way it is drawn; tests have simpler ones.
pub trait Machine {
    /// Something happened.
    fn update(&mut self, msg: Msg) -> Vec<Effect>;

    /// The requests to be computed now: wanted, and neither answered nor failed.
    fn wants(&self) -> Vec<Request>;

    /// Draws the state.
    fn draw(&self, frame: &mut Frame);
}
