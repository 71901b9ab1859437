//! What the loop holds of a file or register while it plays it.

use crate::session::replay::{Player, Recorder, Script};

/// Why a play stands still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pause {
    Not,
    /// A caption waits to be read.
    Caption,
    /// The user wishes it.
    Wished,
}

/// A file or register that is played.
#[derive(Debug)]
pub(super) struct Playing {
    pub(super) player: Player,
    /// What is played, to start over.
    script: Script,
    /// Captions that are passed by, on the way to the one that is wanted.
    pub(super) passed: usize,
    /// Whether keys have done their own work since the caption that waits.
    pub(super) tried: bool,
    /// A register: what the user does comes after it.
    pub(super) register: bool,
    /// Presses that asked for it, the last ones recorded.
    pub(super) asked: u32,
    /// What it has given to the session.
    pub(super) given: Recorder,
    /// Whether time has passed for the session besides what it says itself.
    pub(super) timed: bool,
    pub(super) pause: Pause,
}

impl Playing {
    pub(super) fn new(script: Script, register: bool, asked: u32) -> Self {
        Playing {
            player: Player::new(script.clone()),
            script,
            passed: 0,
            tried: false,
            register,
            asked,
            given: Recorder::default(),
            timed: false,
            pause: Pause::Not,
        }
    }

    /// Goes back to the caption before this one: all is played again up to there.
    pub(super) fn go_back(&mut self) {
        if let Some(passed) = self.player.said().checked_sub(2) {
            self.play_again(passed);
        }
    }

    /// Goes on to the next caption, from what the file made of the session: what was tried out is past.
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
