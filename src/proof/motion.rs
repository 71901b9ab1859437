//! Enclosure of a motion, half swing by half swing, until it comes to rest, reaches the end time, or escapes.

use serde::Serialize;

use super::ball::MOST_STEPS;
use super::field::ParameterBox;
use super::swing::swing;
use super::{
    Ball, Effort, FieldBox, Passage, ProvedMap, ProvedSwing, StartBox, never_returns, scaled,
};
use crate::numerics::{Interval, cbrt};

/// A point of a motion, as far as it is enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedPoint {
    /// Time.
    pub tau: Interval,
    /// Displacement.
    pub q: Option<Interval>,
    /// Velocity.
    pub v: Option<Interval>,
    /// Why nothing is known of the motion from here on.
    pub open: Option<&'static str>,
}

impl ProvedPoint {
    /// A point that is enclosed.
    pub fn of(tau: Interval, q: Interval, v: Interval) -> Self {
        ProvedPoint { tau, q: Some(q), v: Some(v), open: None }
    }
}

/// How a motion certainly ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProvedFate {
    /// At rest.
    Captured,
    /// Still moving at the end time.
    Moving,
    /// Unbounded after a finite time.
    Escaped,
    /// Uncertain from some time on.
    Open,
}

/// A motion as far as it is enclosed, valid for all given parameters and starts.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedMotion {
    /// Every arrival at `v = 0`, the last one included.
    pub turns: Vec<ProvedPoint>,
    /// How it ends.
    pub fate: ProvedFate,
    /// Where and when.
    pub end: ProvedPoint,
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
pub fn follow(parameters: &ParameterBox, start: [Interval; 2], until: f64) -> ProvedMotion {
    let mut turns = Vec::new();
    let (fate, end) = followed(parameters, start, until, &mut turns);
    ProvedMotion { turns, fate, end }
}

/// The end of such a motion, after its turns.
fn followed(
    parameters: &ParameterBox,
    [q, v]: [Interval; 2],
    until: f64,
    turns: &mut Vec<ProvedPoint>,
) -> (ProvedFate, ProvedPoint) {
    let (r, none) = (parameters.r, Interval::point(0.0));
    let at = |tau| ProvedPoint { tau, q: None, v: None, open: None };
    let captured = |tau, q| (ProvedFate::Captured, ProvedPoint { q: Some(q), ..at(tau) });
    let open = |tau, reason| (ProvedFate::Open, ProvedPoint { open: Some(reason), ..at(tau) });
    let mut tau = none;
    let rests = v == none;
    if rests && q.magnitude() <= r.lower() {
        return captured(tau, q);
    }
    // 0 below v = 0, where x = r - q, and 1 above, where x = q + r.
    let mut index = match (v > 0.0, v < 0.0) {
        (true, _) => 1,
        (_, true) => 0,
        _ if rests && q > r.upper() => 0,
        _ if rests && q < -r.upper() => 1,
        _ => return open(tau, if rests { EDGE } else { START }),
    };
    // The frame of a half plane turns the other one round.
    let turned = |index, it: Interval| if index == 1 { it } else { -it };
    let mut start = StartBox { x: turned(index, q) + r, v: turned(index, v) };
    let map = ProvedMap::new(parameters);
    while turns.len() < MOST {
        let field = map.forward.0[index].field;
        let moving = || {
            let time = (until < f64::INFINITY).then(|| Interval::point(until) - tau)?;
            let (x, v) = state_at(&field, &start, time)?;
            let (q, v) = (turned(index, x - r), turned(index, v));
            Some((ProvedFate::Moving, ProvedPoint::of(Interval::point(until), q, v)))
        };
        let found = match swing(&field, &start) {
            Passage::Arrives(found) => found,
            Passage::Never => {
                let escape = blow_up(&field, &start).map(|after| tau + after);
                return match escape.filter(|escape| escape.upper() <= until) {
                    Some(escape) => (ProvedFate::Escaped, at(escape)),
                    None => moving().unwrap_or(open(tau, NEVER)),
                };
            }
            Passage::Unknown | Passage::Exceeds(_) => {
                return moving().unwrap_or(open(tau, STIFF));
            }
        };
        let arrived = tau + found.duration;
        if arrived > until {
            return moving().unwrap_or(open(tau, STIFF));
        }
        if arrived.upper() > until {
            return open(tau, END_TIME);
        }
        let end = end(&field, &start, &found);
        tau = arrived;
        let q = turned(index, end - r);
        turns.push(ProvedPoint::of(tau, q, none));
        if end.upper() <= map.gap.lower() {
            return captured(tau, q);
        }
        let clearance = end - map.gap;
        if !(clearance > 0.0) {
            return open(tau, EDGE);
        }
        (start, index) = (StartBox::at_rest(clearance), 1 - index);
    }
    open(tau, LONG)
}

/// End of a swing; for a wide interval of starts at rest, from the motions of its two ends (lemma 8).
fn end(field: &FieldBox, start: &StartBox, whole: &ProvedSwing) -> Interval {
    let point = start.x.is_point() && field.is_point();
    if point || start.v != 0.0 {
        return whole.end;
    }
    let ends = Effort::default().extremes(field, -start.x).and_then(|[low, high]| {
        Interval::new(low.end.lower(), high.end.upper()).intersection(whole.end)
    });
    ends.unwrap_or(whole.end)
}

impl Ball {
    /// One step, at most `most` long. The velocity vanishes neither during the step nor at its end (lemma 5).
    fn step(&mut self, most: f64) -> Option<()> {
        let ahead = self.prepare(most)?;
        let (h, reached) = self.reach(ahead)?;
        self.advance(h, &reached);
        (self.state().1 > 0.0).then_some(())
    }

    /// Upper bound of the time until the velocity is infinite; `None` where that is not certain.
    ///
    /// Above the line `v = x + m` the velocity grows at least at the rate `k0 + k1 u + k2 u^2 + k3 u^3`, where
    /// u is its gain (lemma 7). For every U, the constant term bounds the time until `u = U` by `U/k0`, and
    /// `k u^n` bounds the time from there on by `1/((n - 1) k U^(n - 1))`.
    fn remaining(&self) -> Option<f64> {
        let (x, v) = self.state();
        let (x, v) = (x.upper(), v.lower());
        if !never_returns(&self.local.field, x, v) {
            return None;
        }
        let FieldBox { a, b, c } = self.local.field.strongest();
        let at = Interval::point(v);
        let k0 = self.local.field.strongest().acceleration(Interval::point(x), at);
        let k1 = -(a + 1.0 + at * (b * 2.0 + at * c * 3.0));
        let k2 = -(b + at * c * 3.0);
        let k3 = -c;
        if !(k0 > 0.0 && [k1, k2, k3].iter().all(|it| it.lower() >= 0.0)) {
            return None;
        }
        let up_to = |u: f64| Interval::point(u) / k0;
        let square = (k0.lower() / k2.lower()).sqrt();
        let cube = cbrt(k0.lower() / k3.lower());
        let one = Interval::point(1.0);
        let by_square = up_to(square) + one / (k2 * square);
        let by_cube = up_to(cube) + one / (k3 * 2.0 * Interval::point(cube).square());
        let least = by_square.upper().min(by_cube.upper());
        least.is_finite().then_some(least)
    }
}

/// Position and velocity at a time after the start, for all motions of a box of starts and fields.
///
/// `None` where they are not known, or where the velocity may have reached 0 before.
pub fn state_at(
    field: &FieldBox,
    start: &StartBox,
    time: Interval,
) -> Option<(Interval, Interval)> {
    let mut ball = Ball::new(field, start)?;
    let target = time.middle();
    for _ in 0..MOST_STEPS {
        let left = target - ball.time;
        if !(left > 4.0 * f64::EPSILON * target) {
            let off = (time - ball.elapsed(0.0)).magnitude();
            let around = about(&ball.local.field, ball.state(), off)?;
            let [x, v] = around.map(|it| scaled(it, ball.unit));
            return (v.lower() >= 0.0).then_some((x, v));
        }
        ball.step(left)?;
    }
    None
}

/// A larger box that motions do not leave within the time `off` before and after they are in a box.
fn about(field: &FieldBox, (x, v): (Interval, Interval), off: f64) -> Option<[Interval; 2]> {
    let time = Interval::new(-off, off);
    let (mut wide_x, mut wide_v) = (x, v);
    for _ in 0..6 {
        let next_x = x + time * wide_v;
        let next_v = v + time * field.acceleration(wide_x, wide_v);
        if next_x.is_within(wide_x) && next_v.is_within(wide_v) {
            return Some([next_x, next_v]);
        }
        let wider = |it: Interval| Interval::around(it.middle(), 1.1 * it.radius());
        (wide_x, wide_v) = (wider(wide_x.hull(next_x)), wider(wide_v.hull(next_v)));
    }
    None
}

/// The time at which the velocity of motions that never turn becomes infinite; `None` where it has no bound.
pub fn blow_up(field: &FieldBox, start: &StartBox) -> Option<Interval> {
    /// Relative uncertainty of the time at which the bound is good enough.
    const GOOD: f64 = 1e-12;
    let mut ball = Ball::new(field, start)?;
    let mut best: Option<Interval> = None;
    for _ in 0..2 * MOST_STEPS {
        if let Some(remaining) = ball.remaining() {
            let over = ball.elapsed(0.0) + Interval::new(0.0, remaining);
            best = Some(best.and_then(|best| best.intersection(over)).unwrap_or(over));
            if remaining < GOOD * over.upper() {
                break;
            }
        }
        if ball.step(f64::INFINITY).is_none() {
            break;
        }
    }
    best
}
