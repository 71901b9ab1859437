//! The state of the loop while it plays a file.

use crate::session::replay::{Player, Script};

/// Why a replay is paused.
#[derive(PartialEq)]
pub(super) enum Pause {
    Not,
    /// A caption waits to be read.
    Caption,
    /// The user asked for it.
    Wished,
}

/// A file that is being played.
pub(super) struct Replay {
    pub(super) player: Player,
    /// The player at its beginning, to start over.
    start: Player,
    /// Number of captions to skip on the way to the wanted one.
    pub(super) passed: usize,
    /// Whether keys had their usual effect since the present caption was shown.
    pub(super) tried: bool,
    pub(super) pause: Pause,
    /// Why the first file that it asked for was not written.
    pub(super) unwritten: Option<String>,
}

impl Replay {
    pub(super) fn new(script: Script) -> Self {
        let (player, pause) = (Player::new(script), Pause::Not);
        let start = player.clone();
        Replay { player, start, passed: 0, tried: false, pause, unwritten: None }
    }

    /// Plays everything again up to the caption after so many.
    pub(super) fn again(&mut self, passed: usize) {
        self.player = self.start.clone();
        (self.passed, self.pause, self.tried) = (passed, Pause::Not, false);
    }
}
