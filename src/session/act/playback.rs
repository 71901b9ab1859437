//! Commands for playback of the motion.

use std::f64::consts::TAU;

use crate::scene::{Layer, Topic};
use crate::session::act::notice::inform;
use crate::session::effect::Done;
use crate::session::state::playback::PACES;
use crate::session::state::{Pace, Session};

const NO_MOTION: &str = "there is no motion on show to play";

/// Plays or pauses the motion; at its end, starts again.
pub fn play(session: &mut Session) -> Done {
    let shown = session.shows(Layer::Trajectory) || session.shows(Layer::Mass);
    let given_up = session.failure(Topic::Trajectory, session.plot).is_some();
    if !shown || given_up || session.trajectory().is_none() {
        return Err(NO_MOTION.to_owned());
    }
    let at_end = session.playback.at.is_some_and(|at| at >= session.last_moment());
    session.playback.playing = !session.playback.playing;
    if session.playback.at.is_none() || (at_end && session.playback.playing) {
        session.playback.at = Some(0.0);
    }
    let text = if session.playback.playing {
        format!("playing: {}", session.pace())
    } else {
        "held".to_owned()
    };
    inform(session, text);
    Ok(())
}

/// Moves the head forward or back by some steps.
pub fn step(session: &mut Session, steps: f64) -> Done {
    session.trajectory().ok_or(NO_MOTION)?;
    session.step_head(steps);
    Ok(())
}

/// Selects the next pace.
pub fn pace(session: &mut Session) {
    session.next_pace();
    inform(session, format!("pace: {}", session.pace()));
}

/// Number of steps of a key per period.
const STEPS: f64 = 40.0;

impl Session {
    /// Advances the head with time; it stops at the end.
    pub(in crate::session) fn elapse(&mut self, seconds: f64) {
        if self.playback.playing && seconds > 0.0 {
            self.advance(seconds * self.rate(self.playback.pace));
        }
    }

    /// Moves the head by a dimensionless time, within the motion.
    pub(in crate::session) fn advance(&mut self, by: f64) {
        let end = self.last_moment();
        let at = (self.playback.at.unwrap_or(0.0) + by).clamp(0.0, end.max(0.0));
        self.playback.at = Some(at);
        if at >= end {
            self.playback.playing = false;
        }
    }

    /// Moves the head by `steps` steps and stops playback.
    pub(in crate::session) fn step_head(&mut self, steps: f64) {
        self.playback.playing = false;
        self.advance(steps * TAU / STEPS);
    }

    /// Selects the next faster pace, and the slowest after the fastest. The real pace exists only for a
    /// machine.
    pub(in crate::session) fn next_pace(&mut self) {
        let real = self.scene.machine.is_some().then_some(Pace::Real);
        let mut paces: Vec<Pace> = PACES.into_iter().chain(real).collect();
        paces.sort_by(|one, other| self.rate(*one).total_cmp(&self.rate(*other)));
        let now = paces.iter().position(|pace| *pace == self.playback.pace);
        self.playback.pace = now.and_then(|now| paces.get(now + 1)).copied().unwrap_or(paces[0]);
    }
}
