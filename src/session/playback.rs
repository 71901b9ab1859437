//! The motion in time: a head that moves along it while it is played.
//!
//! Nothing here reads a clock. The outer rings tell how much time has passed ([`super::Msg::Elapsed`])
//! while [`Session::is_playing`], and a keystroke file does the same with `<elapse SECONDS>`.

use std::f64::consts::TAU;

use super::state::Session;
use crate::flow::{Sample, Trajectory};
use crate::scene::Slot;
use crate::study::belt::Followed;

/// How fast the motion is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// So many seconds for a period of the free oscillation.
    Period(f64),
    /// As fast as the machine itself; only a scene of one has that.
    Real,
}

/// The paces, in the order in which the key visits them.
const PACES: [Pace; 5] =
    [Pace::Period(4.0), Pace::Period(2.0), Pace::Period(1.0), Pace::Period(8.0), Pace::Real];

/// Parts of a period by which a key steps.
const STEPS: f64 = 40.0;

/// What is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Dimensionless time of the head; `None` before anything was played.
    pub at: Option<f64>,
    /// Whether it moves by itself.
    pub playing: bool,
    /// How fast.
    pub pace: Pace,
}

impl Default for Playback {
    fn default() -> Self {
        Playback { at: None, playing: false, pace: PACES[0] }
    }
}

impl Session {
    /// Whether time matters to what is on show.
    #[must_use]
    pub fn is_playing(&self) -> bool {
        self.playback.playing
    }

    /// Whether time passes for what is on show. It stands still while the motion is computed anew, so that
    /// the head is where it is however long that takes.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        let asked = self.request(Slot::Trajectory, self.plot);
        self.is_playing() && asked.is_none_or(|request| !self.is_open(&request))
    }

    /// Where the head is on the motion; `None` before anything was played.
    #[must_use]
    pub fn head(&self) -> Option<Sample> {
        let at = self.playback.at?;
        self.trajectory()?.at(at.min(self.last_moment()))
    }

    /// Where the motion ends: at its outcome, or where the mass would overtake its belt.
    #[must_use]
    pub fn last_moment(&self) -> f64 {
        let contact = self.contact().map(|(tau, _)| tau);
        contact.or_else(|| self.trajectory().map(Trajectory::end)).unwrap_or(0.0)
    }

    /// Time and displacement where the motion reaches the speed of its belt; `None` where it does not, or
    /// there is none.
    #[must_use]
    pub fn contact(&self) -> Option<(f64, f64)> {
        let sticking = self.running()?.reduced.sticking_velocity;
        Followed::of(self.trajectory()?, sticking).sticks
    }

    /// Dimensionless time that passes in a second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        match (self.playback.pace, self.running()) {
            (Pace::Period(seconds), _) => TAU / seconds,
            (Pace::Real, Some(machine)) => machine.reduced.units.omega_0,
            (Pace::Real, None) => TAU,
        }
    }

    /// The pace in words.
    #[must_use]
    pub fn pace(&self) -> String {
        match (self.playback.pace, self.running()) {
            (Pace::Period(seconds), None) => format!("a period in {seconds} s"),
            (Pace::Period(seconds), Some(machine)) => {
                let slower = machine.reduced.units.omega_0 * seconds / TAU;
                if slower >= 1.0 {
                    format!("{slower:.1} times slower than real time")
                } else {
                    format!("{:.1} times faster than real time", 1.0 / slower)
                }
            }
            (Pace::Real, _) => "in real time".to_owned(),
        }
    }

    /// Time has passed: the head moves on, and stands still at the end.
    pub(super) fn elapse(&mut self, seconds: f64) {
        if self.playback.playing && seconds > 0.0 {
            self.advance(seconds * self.rate());
        }
    }

    /// Moves the head by a dimensionless time, up to the ends of the motion.
    pub(super) fn advance(&mut self, by: f64) {
        let end = self.last_moment();
        let at = (self.playback.at.unwrap_or(0.0) + by).clamp(0.0, end.max(0.0));
        self.playback.at = Some(at);
        if at >= end {
            self.playback.playing = false;
        }
    }

    /// Moves the head by a part of a period.
    pub(super) fn step_head(&mut self, steps: f64) {
        self.playback.playing = false;
        self.advance(steps * TAU / STEPS);
    }

    /// The next pace; only a machine has its own.
    pub(super) fn next_pace(&mut self) {
        let now = PACES.iter().position(|pace| *pace == self.playback.pace).unwrap_or(0);
        let real = self.scene.machine.is_some();
        let usable = |pace: &&Pace| real || **pace != Pace::Real;
        let next = PACES[now + 1..].iter().chain(&PACES[..now]).find(usable);
        self.playback.pace = next.copied().unwrap_or(PACES[0]);
    }
}
