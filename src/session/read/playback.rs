//! The motion in time: a head that moves along it while it is played.
//!
//! Nothing here reads a clock. The outer rings tell how much time has passed (`super::Msg::Elapsed`)
//! while [`Session::is_playing`], and a keystroke file does the same with `<elapse SECONDS>`.

use std::f64::consts::TAU;

use crate::flow::{Sample, Trajectory};
use crate::scene::Topic;
use crate::session::state::playback::Pace;
use crate::session::state::session::Session;
use crate::study::belt::FollowedOnBelt;

impl Session {
    /// Whether time matters to what is on show.
    pub fn is_playing(&self) -> bool {
        self.playback.playing
    }

    /// Whether time passes for what is on show. It stands still while the motion is computed again, so that
    /// the head is where it is however long that takes.
    pub fn is_moving(&self) -> bool {
        let asked = self.request(Topic::Trajectory, self.plot);
        self.is_playing() && asked.is_none_or(|request| !self.is_open(&request))
    }

    /// Where the head is on the motion; `None` before anything was played.
    pub fn head(&self) -> Option<Sample> {
        let at = self.playback.at?;
        self.trajectory()?.at(at.min(self.last_moment()))
    }

    /// Where the motion ends: at its outcome, or where the mass would overtake its belt.
    pub fn last_moment(&self) -> f64 {
        let contact = self.contact().map(|(tau, _)| tau);
        contact.or_else(|| self.trajectory().map(Trajectory::end)).unwrap_or(0.0)
    }

    /// Time and displacement where the motion reaches the speed of its belt; `None` where it does not, or
    /// there is none.
    pub fn contact(&self) -> Option<(f64, f64)> {
        self.contact_of(self.trajectory()?)
    }

    /// The same of any motion on show.
    pub fn contact_of(&self, motion: &Trajectory) -> Option<(f64, f64)> {
        if self.course().is_some() {
            return None;
        }
        let sticking = self.running()?.reduced.sticking_velocity;
        FollowedOnBelt::of(motion, sticking).sticks
    }

    /// Dimensionless time that passes in a second at a pace.
    pub fn rate(&self, pace: Pace) -> f64 {
        match (pace, self.running()) {
            (Pace::Period(seconds), _) => TAU / seconds,
            (Pace::Real, Some(machine)) => machine.reduced.units.omega_0,
            (Pace::Real, None) => TAU,
        }
    }

    /// The pace in words.
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
}
