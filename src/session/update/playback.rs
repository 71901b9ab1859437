//! Commands that play the motion in time.

use super::{inform, refuse};
use crate::scene::{Layer, Slot};
use crate::session::message::Effect;
use crate::session::state::Session;

/// Plays the motion, or holds it; at its end, from the start again.
pub fn play(session: &mut Session) -> Vec<Effect> {
    let shown = session.shows(Layer::Trajectory) || session.shows(Layer::Mass);
    let given_up = session.failure(Slot::Trajectory, session.plot).is_some();
    if !shown || given_up || session.trajectory().is_none() {
        refuse(session, "there is no motion on show to play");
        return Vec::new();
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
    Vec::new()
}

/// Moves the head a little on, or back.
pub fn step(session: &mut Session, steps: f64) -> Vec<Effect> {
    if session.trajectory().is_some() {
        session.step_head(steps);
    } else {
        refuse(session, "there is no motion on show to play");
    }
    Vec::new()
}

/// Plays faster or slower.
pub fn pace(session: &mut Session) -> Vec<Effect> {
    session.next_pace();
    inform(session, format!("pace: {}", session.pace()));
    Vec::new()
}
