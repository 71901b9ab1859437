//! The state of the loop while it plays a file.

use crate::session::replay::{Player, Script};

/// Why a replay is paused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pause {
    Not,
    /// A caption waits to be read.
    Caption,
    /// The user asked for it.
    Wished,
}

/// A file that is being played.
#[derive(Debug)]
pub(super) struct Playing {
    pub(super) player: Player,
    /// The whole script, to start over.
    script: Script,
    /// Number of captions to skip on the way to the wanted one.
    pub(super) passed: usize,
    /// Whether keys had their usual effect since the present caption was shown.
    pub(super) tried: bool,
    pub(super) pause: Pause,
    /// Why the first file that it asked for was not written.
    pub(super) unwritten: Option<String>,
}

impl Playing {
    pub(super) fn new(script: Script) -> Self {
        Playing {
            player: Player::new(script.clone()),
            script,
            passed: 0,
            tried: false,
            pause: Pause::Not,
            unwritten: None,
        }
    }

    /// Goes back to the previous caption: plays everything again up to there.
    pub(super) fn go_back(&mut self) {
        if let Some(passed) = self.player.said().checked_sub(2) {
            self.play_again(passed);
        }
    }

    /// Continues to the next caption. If the user has tried keys, plays everything again up to here to undo
    /// them.
    pub(super) fn go_on(&mut self) {
        if self.tried {
            self.play_again(self.player.said());
        }
        self.pause = Pause::Not;
    }

    fn play_again(&mut self, passed: usize) {
        self.player = Player::new(self.script.clone());
        (self.passed, self.pause, self.tried) = (passed, Pause::Not, false);
    }
}
