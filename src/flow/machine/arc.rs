//! A motion within one phase, up to the switching line at which it ends.
//!
//! `y'' = -y` wherever `y' = 0`: the speed has one maximum in each phase and no minimum. A step during which
//! the acceleration keeps its sign is therefore monotone in y, and one during which it changes it turns
//! exactly once. So the values at the ends of a step and at that maximum decide whether a line was reached,
//! however shallow the contact; nothing is sampled.

use super::curve::{MachineStep, ORDER};
use super::series::PhaseSeries;
use crate::flow::Cost;
use crate::model::force::ForceBranch;
use crate::model::model::FINEST;
use crate::model::{ContactState, Model, Phase, Reason};
use crate::numerics::polynomial::{derivative, value, value_and_slope};
use crate::numerics::{Bracket, PlaceTolerance, ln, newton};

/// The end of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcEnd {
    /// Displacement.
    pub x: f64,
    /// Velocity: that of the belt, or 0.
    pub y: f64,
    /// Logarithm of the acceleration just after its start over the one just before its end.
    pub log_ratio: f64,
}

impl ArcEnd {
    /// Whether it ended on the belt's line; otherwise at `y = 0`.
    #[must_use]
    pub fn is_on_belt(&self) -> bool {
        self.y != 0.0
    }
}

/// Maximum number of steps of an arc.
const STEPS: u32 = 20_000;

/// Steps of a loosened tolerance are no longer than this, in `1/omega_0`, so that none of them turns twice; at
/// the finest one the terms of a swing see to that.
const LONGEST: f64 = 1.0;

/// A motion that has shrunk by this factor within one arc turns no more.
const SETTLED: f64 = 1e-200;

/// One that creeps to its balance is followed this far.
const NEAR: f64 = 1e-16;

/// A motion this small is at rest: its series would underflow.
const LEAST: f64 = 1e-250;

/// Velocities that have grown by this factor count as escaped.
const ESCAPED: f64 = 1e60;

/// Computes motions of a model, with the room that it needs for it.
pub struct Flow<'a> {
    /// The model.
    pub model: &'a Model,
    /// The last step, and for how long a motion is still to be followed.
    pub series: PhaseSeries,
    /// Whether a motion that turns no more is to be followed to its end nevertheless.
    pub follows: bool,
    steps: u64,
}

impl<'a> Flow<'a> {
    /// Ready to compute.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        Flow { model, series: PhaseSeries::new(), follows: false, steps: 0 }
    }

    /// What its steps cost: an evaluation for each term of a series.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost { evaluations: self.steps * ORDER as u64, steps: self.steps, rejected: 0 }
    }

    /// Takes a step, which `watch` sees first.
    pub(super) fn passes(&mut self, step: MachineStep, watch: &mut impl FnMut(&PhaseSeries)) {
        self.series.step = step;
        watch(&self.series);
        self.series.left -= self.series.step.duration;
    }

    /// Follows a motion from `(x, y)` to the end of its phase, forward in time or backward; `watch` sees each of its steps.
    ///
    /// # Errors
    /// [`Reason`] where it does not get there.
    pub fn arc(
        &mut self,
        phase: Phase,
        (x, y): (f64, f64),
        backward: bool,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<ArcEnd, Reason> {
        let model = self.model;
        let (side, offset) = (model.side(phase), model.offset(phase));
        let (least, most) = model.range(phase);
        let forward = if backward { -1.0 } else { 1.0 };
        let (mut x, mut y) = (x + offset, y);
        let started = x.abs().max(y.abs());
        if started < LEAST {
            return Err(Reason::Settles);
        }
        // On the belt's line at the fold the acceleration vanishes exactly.
        let touching = phase == Phase::Between
            && y == most
            && model.lines.is_some_and(|lines| x - offset == lines.fold);
        let mut known = touching.then_some(0.0);
        let mut first = None;
        let mut rising = None;
        for _ in 0..STEPS {
            let rising_here = rising.unwrap_or_else(|| self.rises(phase, (x, y), forward, known));
            let piece = side.piece(y, rising_here).ok_or(self.outside(y))?;
            self.series.expand((side, piece), (x, y), forward, known.take());
            self.steps += 1;
            let (series, left) = (&self.series, self.series.left);
            let terms = &series.step.y;
            let entered = *first.get_or_insert(forward * terms[1]);
            let length = series.length(model.tolerance);
            let length = if model.tolerance > FINEST { length.min(LONGEST) } else { length };
            if !(length > 0.0 && length.is_finite()) {
                // Without terms nothing moves; with terms that overflow it moves beyond all bounds.
                return Err(if length == f64::INFINITY {
                    Reason::Settles
                } else {
                    Reason::Escapes
                });
            }
            let (low, high) = (piece.low.max(least), piece.high.min(most));
            let velocity = |t: f64| value_and_slope(terms, t);
            let turning = |t: f64| value_and_slope(&derivative(terms), t);
            let (peak, hit) = crossing(phase, length, (low, high), &velocity, &turning);
            let (duration, level) = match hit {
                Some((time, level)) if time <= left => (time, Some(level)),
                _ => (length.min(left), None),
            };
            let peak = peak.filter(|peak| *peak <= duration);
            let (last, slope) = velocity(duration);
            (x, y) = (value(&series.step.x, duration), level.unwrap_or(last));
            let place = ContactState::Slips(phase);
            let step = MachineStep { place, duration, peak, offset, ..series.step };
            self.passes(step, watch);
            if let Some(level) = level {
                if level == most || level == least {
                    let log_ratio = ln((entered / (forward * slope)).abs());
                    return Ok(ArcEnd { x: x - offset, y, log_ratio });
                }
                let outer = if level == high { side.pieces.last() } else { side.pieces.first() };
                if outer.is_some_and(|outer| outer.low == piece.low) {
                    return Err(self.outside(level));
                }
            }
            rising = Some(slope > 0.0);
            let size = x.abs().max(y.abs());
            let end = if self.follows { NEAR * started } else { f64::INFINITY };
            let turns = size > end || !creeps(phase, side, (x, y), forward);
            if size < SETTLED * started || !turns || self.series.left <= 0.0 {
                return Err(Reason::Settles);
            }
            if size.is_nan() || size > ESCAPED * started {
                return Err(Reason::Escapes);
            }
        }
        Err(Reason::Steps)
    }

    /// Whether the velocity rises, along the direction of integration.
    fn rises(&self, phase: Phase, (x, y): (f64, f64), forward: f64, known: Option<f64>) -> bool {
        let rate = forward * known.unwrap_or_else(|| self.model.force(phase, y).0 - x);
        // Without acceleration the speed has its maximum here.
        if rate == 0.0 { phase == Phase::Below } else { rate > 0.0 }
    }

    pub(super) fn outside(&self, y: f64) -> Reason {
        Reason::BeyondLaw { slip: (self.model.speed - y).abs() * self.model.omega_0 }
    }
}

/// Whether a motion creeps to the balance of its phase without another turn.
///
/// Where every velocity up to `x` decays at least twice as fast as `x` pulls, no motion leaves the wedge
/// `y = 0 .. -x`: on its edge `y = -x` the sum `x + y` moves inwards.
fn creeps(phase: Phase, side: &ForceBranch, (x, y): (f64, f64), forward: f64) -> bool {
    const OVERDAMPED: f64 = 2.0;
    phase != Phase::Above
        && x * y * forward <= 0.0
        && y.abs() <= x.abs()
        && side.decay(x.abs(), forward).is_some_and(|decay| decay >= OVERDAMPED)
}

/// Where a step turns, and the first of two levels that it reaches, with the time at which it does; given that the speed
/// turns at most once, from growing to falling.
///
/// `inside` is the velocity with its derivative at a time from the start of the step, `turning` this one with the next.
pub(super) fn crossing(
    phase: Phase,
    end: f64,
    (low, high): (f64, f64),
    inside: &impl Fn(f64) -> (f64, f64),
    turning: &impl Fn(f64) -> (f64, f64),
) -> (Option<f64>, Option<(f64, f64)>) {
    let sign = phase.sign();
    let (outer, inner) = if sign > 0.0 { (high, low) } else { (low, high) };
    let grows = |slope: f64| sign * slope > 0.0;
    let beyond = |y: f64, level: f64| sign * (y - level);
    // On a bracket in which y is monotone.
    let root = |level: f64, (low, high): (f64, f64), rising: bool| {
        let settled = PlaceTolerance::Absolute(1e-16 * high);
        let ahead = |t: f64| {
            let (velocity, slope) = inside(t);
            (velocity - level, slope)
        };
        newton(Bracket { low, high, rising }, high, settled, ahead).at
    };
    let (velocity, slope) = inside(end);
    let mut peak = None;
    if grows(inside(0.0).1) {
        let (until, fastest) = if grows(slope) {
            (end, velocity)
        } else {
            let bracket = Bracket { low: 0.0, high: end, rising: sign < 0.0 };
            // Where the velocity is flat, an error e in time costs only e^2 in it.
            let settled = PlaceTolerance::Absolute(1e-9 * end);
            let turn = newton(bracket, 0.5 * end, settled, turning).at;
            peak = Some(turn);
            (turn, inside(turn).0)
        };
        if beyond(fastest, outer) >= 0.0 {
            return (peak, Some((root(outer, (0.0, until), sign > 0.0), outer)));
        }
    }
    let falls = beyond(velocity, inner) <= 0.0 && !grows(slope);
    let begin = peak.unwrap_or(0.0);
    (peak, falls.then(|| (root(inner, (begin, end), sign < 0.0), inner)))
}
