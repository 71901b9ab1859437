//! Trying kicks: the mass is kicked where it rests, and the motion is played; then keys change the size.

use crate::flow::{Outcome, Problem};
use crate::model::{Knob, State};
use crate::numerics::StepSize;
use crate::session::act::parameters::change;
use crate::session::{Done, Session};

/// The first kick, as a part of the margin there.
const FIRST: f64 = 0.9;

/// Steps of a key in a margin.
const STEPS: f64 = 20.0;

/// What stands for the margin where none is known, in units of the friction.
const USUAL: f64 = 5.0;

/// Kicks the mass where it rests, and plays what becomes of it; while kicks are tried, plays that again.
pub fn kick(session: &mut Session) -> Done {
    if session.kicking {
        play(session);
        return Ok(());
    }
    if session.scene.recording.is_some() {
        return Err("a recorded motion has its own start: it cannot be kicked".to_owned());
    }
    if !session.follows_motion() {
        let text = "no plot shows what a kick does: {views} or :view phase shows it";
        return Err(session.with_keys(text));
    }
    // Where the motion on show ends, otherwise where the smallest impulse is lost.
    let q = match session.trajectory().map(|motion| motion.outcome) {
        Some(Outcome::Captured { q, .. }) => q,
        _ => session.cycles().and_then(|found| found.nearest).map_or(0.0, |nearest| nearest.q),
    };
    let (limit, step) = scale(session, q);
    let (one, _) = session.unit_of_kick(false);
    start(session, State { q, v: step.multiple_from(FIRST * limit * one, 0) / one })
}

/// The velocity with which the nearest border is met from a place of rest, and the step of kicks there, in the unit in
/// which they are told.
fn scale(session: &Session, q: f64) -> (f64, StepSize) {
    let found = session.cycles();
    let nearest = found.and_then(|found| found.portrait.nearest_border([q]));
    // Where no border was traced, a margin can still be known.
    let least = || found?.margin.from_rest.impulse.filter(|least| *least > 0.0);
    let r = session.problem.parameters.r;
    let usual = if r > 0.0 { USUAL * r } else { 1.0 };
    let limit = nearest.map(|border| border.v).or_else(least).unwrap_or(usual);
    let (one, _) = session.unit_of_kick(false);
    (limit, StepSize::near(limit.abs() * one / STEPS))
}

/// Makes the kick larger by some steps.
pub fn resize(session: &mut Session, by: i32) -> Done {
    let State { q, v } = session.problem.initial;
    let (one, _) = session.unit_of_kick(false);
    let (_, step) = scale(session, q);
    let size = step.multiple_from(v.abs() * one, by);
    if size <= 0.0 {
        return Err(session.with_keys("no smaller kick; {kick-turn} turns its direction"));
    }
    start(session, State { q, v: (size / one).copysign(v) })
}

/// Turns the direction of the kick.
pub fn turn(session: &mut Session) -> Done {
    let State { q, v } = session.problem.initial;
    start(session, State { q, v: -v })
}

/// Makes a kick the start of the motion, and plays it.
fn start(session: &mut Session, initial: State) -> Done {
    Knob::V0.check(initial.v)?;
    change(session, Problem { initial, ..session.problem });
    session.kicking = true;
    play(session);
    Ok(())
}

fn play(session: &mut Session) {
    (session.playback.at, session.playback.playing) = (Some(0.0), true);
}

/// Ends the trial when the motion on show starts by no kick any more, or is no longer shown.
pub fn keep(session: &mut Session) {
    let kicked = session.kick().is_some_and(|kick| !kick.is_shift);
    session.kicking &= kicked && session.follows_motion();
}
