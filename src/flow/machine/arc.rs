//! A motion within one phase, up to the switching line at which it ends.
//!
//! `y'' = -y` wherever `y' = 0`: the speed has one maximum in each phase and no minimum. A step during which
//! the acceleration keeps its sign is therefore monotone in y, and one during which it changes it turns
//! exactly once. So the values at the ends of a step and at that maximum decide whether a line was reached,
//! however shallow the contact; nothing is sampled.

use super::series::{ORDER, PhaseSeries};
use crate::flow::Cost;
use crate::model::force::ForceBranch;
use crate::model::model::FINEST;
use crate::model::{Model, Phase, Reason};
use crate::numerics::elementary::ln;
use crate::numerics::polynomial::{derivative, value, value_and_slope};
use crate::numerics::root::{Bracket, PlaceTolerance, newton};

/// One step of a motion, as its series.
pub struct SeriesStep<'a> {
    /// The phase.
    pub phase: Phase,
    /// The series, of which `duration` belongs to the step.
    pub series: &'a PhaseSeries,
    /// Duration, in `1/omega_0`.
    pub duration: f64,
    /// Where the velocity has its extremum in the step.
    pub peak: Option<f64>,
}

/// What looks at a motion while it is computed.
pub trait Watch {
    /// A step in slip.
    fn step(&mut self, model: &Model, step: &SeriesStep);
    /// A step in slip by a method without series: its duration, and displacement and velocity at its end.
    fn passes(&mut self, _duration: f64, _end: (f64, f64)) {}
    /// A piece during which the mass rides on the belt.
    fn stick(&mut self, _model: &Model, _from: f64, _to: f64) {}
    /// Whether a motion that turns no more is to be followed to its end nevertheless.
    fn follows(&self) -> bool {
        false
    }
    /// For how long the motion is still to be followed, in `1/omega_0`.
    fn left(&self) -> f64 {
        f64::INFINITY
    }
}

impl Watch for () {
    fn step(&mut self, _: &Model, _: &SeriesStep) {}
}

impl<A: Watch, B: Watch> Watch for (&mut A, &mut B) {
    fn step(&mut self, model: &Model, step: &SeriesStep) {
        self.0.step(model, step);
        self.1.step(model, step);
    }
    fn stick(&mut self, model: &Model, from: f64, to: f64) {
        self.0.stick(model, from, to);
        self.1.stick(model, from, to);
    }
    fn follows(&self) -> bool {
        self.0.follows() || self.1.follows()
    }
}

/// The end of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcEnd {
    /// Displacement.
    pub x: f64,
    /// Whether it ended on the belt's line; otherwise at `y = 0`.
    pub on_belt: bool,
    /// Accelerations just after its start and just before its end.
    pub accelerations: (f64, f64),
}

impl ArcEnd {
    /// Logarithm of the first acceleration over the last, in the direction of integration.
    #[must_use]
    pub fn log_ratio(&self) -> f64 {
        ln((self.accelerations.0 / self.accelerations.1).abs())
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
    series: PhaseSeries,
    /// Steps taken.
    pub steps: u64,
}

impl<'a> Flow<'a> {
    /// Ready to compute.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        Flow { model, series: PhaseSeries::new(), steps: 0 }
    }

    /// What its steps cost: an evaluation for each term of a series.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost { evaluations: self.steps * ORDER as u64, steps: self.steps, rejected: 0 }
    }

    /// Follows a motion from `(x, y)` to the end of its phase, forward in time or backward.
    ///
    /// # Errors
    /// [`Reason`] where it does not get there.
    pub fn arc(
        &mut self,
        phase: Phase,
        (x, y): (f64, f64),
        backward: bool,
        watch: &mut impl Watch,
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
            let series = &self.series;
            let acceleration = forward * series.y[1];
            let entered = *first.get_or_insert(acceleration);
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
            let found = crossing(series, phase, length, (low, high));
            let (duration, level) = found.hit.map_or((length, None), |(t, at)| (t, Some(at)));
            let peak = found.peak.filter(|peak| *peak <= duration);
            watch.step(model, &SeriesStep { phase, series, duration, peak });
            x = value(&series.x, duration);
            let (velocity, slope) = series.velocity(duration);
            y = level.unwrap_or(velocity);
            if let Some(level) = level {
                if level == most || level == least {
                    let accelerations = (entered, forward * slope);
                    let on_belt = level != 0.0;
                    return Ok(ArcEnd { x: x - offset, on_belt, accelerations });
                }
                let outer = if level == high { side.pieces.last() } else { side.pieces.first() };
                if outer.is_some_and(|outer| outer.low == piece.low) {
                    return Err(self.outside(level));
                }
            }
            rising = Some(slope > 0.0);
            let size = x.abs().max(y.abs());
            let end = if watch.follows() { NEAR * started } else { f64::INFINITY };
            let turns = size > end || !creeps(phase, side, (x, y), forward);
            if size < SETTLED * started || !turns || watch.left() <= 0.0 {
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

    fn outside(&self, y: f64) -> Reason {
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

/// A step of any method, as far as the search for its events needs it.
pub trait StepInside {
    /// The velocity at a time from its start, and its derivative.
    fn velocity(&mut self, t: f64) -> (f64, f64);

    /// Where the acceleration vanishes between 0 and `end`, at which it has opposite signs.
    fn turning(&mut self, end: f64) -> f64;
}

impl StepInside for &PhaseSeries {
    fn velocity(&mut self, t: f64) -> (f64, f64) {
        PhaseSeries::velocity(self, t)
    }

    fn turning(&mut self, end: f64) -> f64 {
        let slopes = derivative(&self.y);
        let bracket = Bracket { low: 0.0, high: end, rising: slopes[0] < 0.0 };
        newton(bracket, 0.5 * end, PlaceTolerance::Absolute(1e-16 * end), |t| {
            value_and_slope(&slopes, t)
        })
        .at
    }
}

/// Where a step turns, and where it first reaches a level.
pub struct StepLevels {
    peak: Option<f64>,
    /// Time and level.
    pub hit: Option<(f64, f64)>,
}

/// The first of two levels that a step reaches, given that the speed turns at most once, from growing to
/// falling.
pub fn crossing(
    mut step: impl StepInside,
    phase: Phase,
    end: f64,
    (low, high): (f64, f64),
) -> StepLevels {
    let sign = phase.sign();
    let (outer, inner) = if sign > 0.0 { (high, low) } else { (low, high) };
    let grows = |slope: f64| sign * slope > 0.0;
    let beyond = |y: f64, level: f64| sign * (y - level);
    let (velocity, slope) = step.velocity(end);
    let mut peak = None;
    if grows(step.velocity(0.0).1) {
        let (until, fastest) = if grows(slope) {
            (end, velocity)
        } else {
            let turn = step.turning(end);
            peak = Some(turn);
            (turn, step.velocity(turn).0)
        };
        if beyond(fastest, outer) >= 0.0 {
            let at = root(&mut step, outer, (0.0, until), sign);
            return StepLevels { peak, hit: Some((at, outer)) };
        }
    }
    let falls = beyond(velocity, inner) <= 0.0 && !grows(slope);
    let hit = falls.then(|| {
        let begin = peak.unwrap_or(0.0);
        (root(&mut step, inner, (begin, end), -sign), inner)
    });
    StepLevels { peak, hit }
}

/// The time in a bracket on which y is monotone, with the given direction, at which it is at a level.
fn root(step: &mut impl StepInside, level: f64, (low, high): (f64, f64), direction: f64) -> f64 {
    let bracket = Bracket { low, high, rising: direction > 0.0 };
    let settled = PlaceTolerance::Absolute(1e-16 * high);
    let ahead = |t: f64| {
        let (velocity, slope) = step.velocity(t);
        (velocity - level, slope)
    };
    newton(bracket, high, settled, ahead).at
}
