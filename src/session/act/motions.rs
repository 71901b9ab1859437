//! Commands of the motions: starting them beside each other, such as one on each side of the border of the basin,
//! removing them, and playing the present one.

use std::f64::consts::TAU;

use crate::model::State;
use crate::numerics::{by_number, decimal_sum, shortest};
use crate::portrait::Drawing;
use crate::scene::{Layer, Topic};
use crate::session::act::parameters::put;
use crate::session::{Done, MOST_MOTIONS, PACES, Pace, Playback, Session, Setup};
use crate::words::counted;

/// Clearance of a start relative to that of the border: near enough to stay close for a while, far enough to be
/// distinguished.
pub const INSIDE: f64 = 0.95;

/// Like [`INSIDE`], on the other side.
pub const OUTSIDE: f64 = 1.05;

/// Why a motion is not removed.
const ONLY: &str = "the only motion cannot be removed";

/// Starts a motion beside the present ones; if there are too many, the oldest is removed.
pub fn start(session: &mut Session, initial: State) {
    let before = session.problem.initial;
    if initial == before {
        return;
    }
    let mut setup = session.setup();
    setup.others.retain(|start| ![initial, before].contains(start));
    setup.others.push(before);
    if setup.others.len() == MOST_MOTIONS {
        setup.others.remove(0);
        session.inform(format!("{MOST_MOTIONS} motions at most: the oldest gave way"));
    }
    setup.problem.initial = initial;
    put(session, setup);
}

/// Removes the newest motion; the previous one becomes the present one.
pub fn drop_newest(session: &mut Session) -> Done {
    let mut setup = session.setup();
    let initial @ State { q, v } = setup.others.pop().ok_or(ONLY)?;
    setup.problem.initial = initial;
    let motions = counted(setup.others.len() + 1, "motion");
    put(session, setup);
    let place = format!("q0 = {}, v0 = {}", shortest(q), shortest(v));
    session.inform(format!("{motions} on show; {place}"));
    Ok(())
}

/// Removes all motions but the newest.
pub fn drop_others(session: &mut Session) -> Done {
    let differs = put(session, Setup { others: Vec::new(), ..session.setup() });
    if differs { Ok(()) } else { Err(ONLY.to_owned()) }
}

/// Starts a motion at rest beside a turning point of the border: the right one of the smallest unstable cycle,
/// or that of the separatrix.
pub fn beside_edge(session: &mut Session, factor: f64) -> Done {
    let q = beside(session, factor)?;
    start(session, State { q, v: 0.0 });
    Ok(())
}

/// The clearance of the border from the sticking set, and the side (1 or -1) of its turning point.
fn edge(found: &Drawing) -> Option<(f64, f64)> {
    if !found.portrait.border.parts_without_cycle() {
        return Some((found.cycles.iter().find(|cycle| !cycle.stable)?.clearance, 1.0));
    }
    // Motions escape to the side where D2 feeds them: for D2 > 0 to the left, from a turning point on the
    // right.
    let displacement = found.margin.displacement?;
    Some(((displacement - found.parameters.r).max(0.0), 1.0_f64.copysign(found.parameters.d2)))
}

fn beside(session: &Session, factor: f64) -> Done<f64> {
    if let Some(why) = session.failure(Topic::Cycles, session.plot) {
        return Err(format!("the cycles are not known: {why}"));
    }
    let edge = session.cycles().and_then(edge);
    let (clearance, side) =
        edge.ok_or("there is no border to start beside: neither cycle nor separatrix")?;
    let r = session.problem.parameters.r;
    let outside = factor > 1.0;
    let keeps_side = |q: &f64| {
        if outside {
            q - r > clearance
        } else {
            q - r < clearance
        }
    };
    // Three digits are enough and easy to read, unless the border is very close to the sticking set.
    let short = format!("{:.2e}", factor * clearance).parse().unwrap_or(clearance);
    let candidates = [decimal_sum(r, short), r + factor * clearance];
    // A border can pass closer to r than floating-point numbers resolve: only rest is then inside of it.
    let last = if outside { (r + clearance).next_up() } else { r };
    Ok(side * candidates.into_iter().find(keeps_side).unwrap_or(last))
}

const NO_MOTION: &str = "there is no motion on show to play";

/// Plays or pauses the motion; at its end, starts again.
pub fn play(session: &mut Session) -> Done {
    let shown = session.shows(Layer::Trajectory) || session.shows(Layer::Mass);
    let given_up = session.failure(Topic::Trajectory, session.plot).is_some();
    if !shown || given_up || session.trajectory().is_none() {
        return Err(NO_MOTION.to_owned());
    }
    let end = session.last_moment();
    let Playback { at, playing, .. } = &mut session.playback;
    *playing = !*playing;
    if at.is_none_or(|at| at >= end && *playing) {
        *at = Some(0.0);
    }
    Ok(())
}

/// Number of steps of a key per period.
const STEPS: f64 = 40.0;

/// Moves the head forward or back by some steps, whether the motion is played or paused.
pub fn step(session: &mut Session, steps: f64) -> Done {
    session.trajectory().ok_or(NO_MOTION)?;
    session.advance(steps * TAU / STEPS);
    Ok(())
}

/// Selects the next faster pace, and the slowest after the fastest. The real pace exists only for a machine.
pub fn pace(session: &mut Session) {
    let real = session.scene.machine.is_some().then_some(Pace::Real);
    let mut paces: Vec<Pace> = PACES.into_iter().chain(real).collect();
    paces.sort_by(by_number(|pace| session.rate(*pace)));
    let now = paces.iter().position(|pace| *pace == session.playback.pace);
    session.playback.pace = now.and_then(|now| paces.get(now + 1)).copied().unwrap_or(paces[0]);
    session.inform(format!("pace: {}", session.pace()));
}

/// Takes the head away: the whole motion is on show again.
pub fn drop_head(session: &mut Session) {
    session.playback = Playback { pace: session.playback.pace, ..Playback::default() };
}

impl Session {
    /// Advances the head with time; it stops at the end.
    pub(crate) fn elapse(&mut self, seconds: f64) {
        if self.playback.playing && seconds > 0.0 {
            self.advance(seconds * self.rate(self.playback.pace));
        }
    }

    /// Moves the head by a dimensionless time, within the motion. At the end it stays there, also when another motion
    /// takes the place of this one.
    pub(crate) fn advance(&mut self, by: f64) {
        let end = self.last_moment().max(0.0);
        let at = self.playback.at.unwrap_or(0.0).min(end) + by;
        let ended = at >= end;
        self.playback.at = Some(if ended { f64::INFINITY } else { at.max(0.0) });
        self.playback.playing &= !ended;
    }
}
