//! Enclosure of a motion, half swing by half swing, until it comes to rest, reaches the end time, or escapes.

use super::field::{Field, ParameterBox};
use super::map::{Direction, ProvedMap};
use super::ride::{blow_up, state_at};
use super::swing::{Passage, StartBox, Swing, swing};
use crate::numerics::Interval;

/// An arrival at `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedTurn {
    /// Time of the arrival.
    pub tau: Interval,
    /// Displacement.
    pub q: Interval,
}

/// How a motion certainly ends, or why that is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProvedFate {
    /// At rest.
    Captured {
        /// Time of the arrival.
        tau: Interval,
        /// Displacement at rest.
        q: Interval,
    },
    /// Still moving at the end time.
    Moving {
        /// Displacement at the end time.
        q: Interval,
        /// Velocity at the end time.
        v: Interval,
    },
    /// Unbounded after a finite time.
    Escaped {
        /// Time of the blow-up.
        tau: Interval,
    },
    /// Uncertain from some time on.
    Open {
        /// Time up to which the motion is enclosed.
        tau: Interval,
        /// Why it is not enclosed further.
        reason: &'static str,
    },
}

/// A motion as far as it is enclosed, valid for all given parameters and starts.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedMotion {
    /// Every arrival at `v = 0`, the last one included.
    pub turns: Vec<ProvedTurn>,
    /// How it ends.
    pub fate: ProvedFate,
}

const EDGE: &str = "it arrives within its error of an end of the sticking set";
const START: &str = "its start may lie on either side of v = 0";
const END_TIME: &str = "it arrives at v = 0 within its error of the end time";
const STIFF: &str = "a half swing is too stiff or too wide to be enclosed";
const NEVER: &str = "it never turns again, and the time of its escape has no bound";
const LONG: &str = "its half swings are too many";

/// Half swings after which a motion is abandoned.
const MOST: usize = 20_000;

/// Encloses the motion from displacements `q` and velocities `v` until a time, which may be infinite.
pub fn follow(parameters: &ParameterBox, [q, v]: [Interval; 2], until: f64) -> ProvedMotion {
    let r = parameters.r;
    let mut turns = Vec::new();
    let mut tau = Interval::point(0.0);
    let rests = v == Interval::point(0.0);
    if rests && q.magnitude() <= r.lower() {
        return ProvedMotion { turns, fate: ProvedFate::Captured { tau, q } };
    }
    // 0 below v = 0, where x = r - q, and 1 above, where x = q + r.
    let mut index = match (v.lower() > 0.0, v.upper() < 0.0) {
        (true, _) => 1,
        (_, true) => 0,
        _ if rests && q.lower() > r.upper() => 0,
        _ if rests && q.upper() < -r.upper() => 1,
        _ => {
            let reason = if rests { EDGE } else { START };
            return ProvedMotion { turns, fate: ProvedFate::Open { tau, reason } };
        }
    };
    let mut start =
        if index == 1 { StartBox { x: q + r, v } } else { StartBox { x: r - q, v: -v } };
    let mut map = ProvedMap::new(parameters);
    let fate = loop {
        let field = *map.halves[index].field(Direction::Forward);
        let time = Interval::point(until) - tau;
        let state = || {
            let (x, v) =
                if until < f64::INFINITY { state_at(&field, &start, time)? } else { None? };
            let (q, v) = if index == 1 { (x - r, v) } else { (r - x, -v) };
            Some(ProvedFate::Moving { q, v })
        };
        let open = |reason| ProvedFate::Open { tau, reason };
        if turns.len() == MOST {
            break open(LONG);
        }
        match swing(&field, &start, false) {
            Passage::Arrives(found) => {
                let arrived = tau + found.duration;
                if arrived.lower() > until {
                    break state().unwrap_or(open(STIFF));
                }
                if arrived.upper() > until {
                    break open(END_TIME);
                }
                let end = end(&mut map, &field, &start, &found);
                tau = arrived;
                let q = if index == 1 { end - r } else { r - end };
                turns.push(ProvedTurn { tau, q });
                if end.upper() <= map.gap.lower() {
                    break ProvedFate::Captured { tau, q };
                }
                let clearance = end - map.gap;
                if !(clearance.lower() > 0.0) {
                    break ProvedFate::Open { tau, reason: EDGE };
                }
                (start, index) = (StartBox::at_rest(clearance), 1 - index);
            }
            Passage::Never => {
                let escape = blow_up(&field, &start).map(|after| tau + after);
                break match escape {
                    Some(escape) if escape.upper() <= until => ProvedFate::Escaped { tau: escape },
                    _ => state().unwrap_or(open(NEVER)),
                };
            }
            Passage::Unknown | Passage::Exceeds(_) => break state().unwrap_or(open(STIFF)),
        }
    };
    ProvedMotion { turns, fate }
}

/// End of a swing; for a wide interval of starts at rest, from the motions of its two ends (lemma 8).
fn end(map: &mut ProvedMap, field: &Field, start: &StartBox, whole: &Swing) -> Interval {
    let point = start.x.is_point() && field.is_point();
    if point || start.v != Interval::point(0.0) {
        return whole.end;
    }
    map.steps = 0;
    let mut bound = |field: &Field, x: f64| map.run(field, Interval::point(-x)).arrived();
    let low = bound(&field.strongest(), start.x.upper());
    let high = bound(&field.weakest(), start.x.lower());
    let ends = low.zip(high).map(|(low, high)| Interval::new(low.end.lower(), high.end.upper()));
    ends.and_then(|ends| ends.intersection(whole.end)).unwrap_or(whole.end)
}
