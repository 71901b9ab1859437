//! Playback of the motion: a head moves along it.
//!
//! Nothing here reads a clock. The outer rings report how much time has passed (`super::Msg::Elapsed`) while
//! [`Session::is_playing`], and a keystroke file does the same with `<elapse SECONDS>`.

use std::f64::consts::TAU;

use crate::flow::{Sample, Trajectory};
use crate::portrait::on_belt::FollowedOnBelt;
use crate::scene::Topic;
use crate::session::state::{Pace, Session};

impl Session {
    /// Whether the motion is being played.
    pub fn is_playing(&self) -> bool {
        self.playback.playing
    }

    /// Whether playback advances with time. It pauses while the motion is recomputed, so that the position of
    /// the head does not depend on how long that takes.
    pub fn is_moving(&self) -> bool {
        let asked = self.request(Topic::Trajectory, self.plot);
        self.is_playing() && asked.is_none_or(|request| !self.is_open(&request))
    }

    /// The state of the motion at the head; `None` before the first playback.
    pub fn head(&self) -> Option<Sample> {
        let at = self.playback.at?;
        self.trajectory()?.at(at.min(self.last_moment()))
    }

    /// The end of playback: the end of the motion, or where the mass would overtake its belt.
    pub fn last_moment(&self) -> f64 {
        let contact = self.contact().map(|(tau, _)| tau);
        contact.or_else(|| self.trajectory().map(Trajectory::end)).unwrap_or(0.0)
    }

    /// Time and displacement where the motion reaches the speed of the belt; `None` if it does not, or there is
    /// no belt.
    pub fn contact(&self) -> Option<(f64, f64)> {
        self.contact_of(self.trajectory()?)
    }

    /// The same for any motion on show.
    pub fn contact_of(&self, motion: &Trajectory) -> Option<(f64, f64)> {
        if self.course().is_some() {
            return None;
        }
        let sticking = self.running()?.reduced.sticking_velocity;
        FollowedOnBelt::of(motion, sticking).sticks
    }

    /// Dimensionless time per second at a pace.
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
