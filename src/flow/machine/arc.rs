//! A motion within one phase, up to the switching line at which it ends.

use super::levels::{PhaseStep, crossing};
use super::stepped::{self, PhaseField, PhaseStepper, pair_step};
use super::{MachineStep, ORDER, PhaseSeries};
use crate::flow::{Cost, StepPoint};
use crate::model::{ContactState, FINEST, ForceBranch, Model, Phase, Reason, Result};
use crate::numerics::{derivative, ln, value, value_and_slope};

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
const STEPS: u64 = 20_000;

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
    /// The last step, and the time left.
    pub series: PhaseSeries,
    /// Whether a motion that turns no more is to be followed to its end nevertheless.
    pub follows: bool,
    /// What takes steps in place of Taylor series, forward in time alone.
    pub(super) stepper: Option<PhaseStepper<'a>>,
    pub(super) steps: u64,
}

impl<'a> Flow<'a> {
    /// Ready to compute.
    #[must_use]
    pub fn new(model: &'a Model) -> Self {
        Flow { model, series: PhaseSeries::new(), follows: false, stepper: None, steps: 0 }
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

    /// Follows a motion from `(x, y)` to the end of its phase, forward in time or backward; `watch` sees each of its
    /// steps.
    ///
    /// # Errors
    /// [`Reason`] where it does not get there.
    pub fn arc(
        &mut self,
        phase: Phase,
        (x, y): (f64, f64),
        backward: bool,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<ArcEnd> {
        let model = self.model;
        let (least, most) = model.range(phase);
        let offset = model.offset(phase);
        let forward = if backward { -1.0 } else { 1.0 };
        let mut from = StepPoint { x: x + offset, v: y };
        let started = from.size();
        if started < LEAST {
            return Err(Reason::Settles);
        }
        // On the belt's line at the fold the acceleration vanishes exactly.
        let touching = phase == Phase::Between
            && y == most
            && model.lines.is_some_and(|lines| from.x - offset == lines.fold);
        let mut known = touching.then_some(0.0);
        let by_series = self.stepper.is_none();
        let field = PhaseField { model, phase };
        if let Some(stepper) = &mut self.stepper {
            stepper.begin(&field);
        }
        let mut first = None;
        let mut rising = None;
        let most_steps = if by_series { STEPS } else { stepped::STEPS };
        for _ in 0..most_steps {
            let taken = if let Some(stepper) = &mut self.stepper {
                pair_step(stepper, field, from, (self.series.left, first.is_none()))?
            } else {
                self.series_step(phase, from, forward, (rising, known.take()))?
            };
            let PhaseStep { step, end, slopes: (begun, slope), level } = taken;
            let entered = *first.get_or_insert(begun);
            (from, rising) = (end, Some(slope > 0.0));
            self.passes(step, watch);
            match level {
                Some((y, _)) if y == most || y == least => {
                    let log_ratio = ln((entered / slope).abs());
                    return Ok(ArcEnd { x: end.x - offset, y, log_ratio });
                }
                Some((y, true)) => return Err(self.outside(phase, y)),
                _ if self.series.left <= 0.0 => return Err(Reason::Settles),
                _ if by_series => self.stays((phase, forward), started, end)?,
                _ => {}
            }
        }
        Err(Reason::Steps)
    }

    /// A step by Taylor series within a piece of the force; along the direction of integration the velocity is known to
    /// rise or fall, or the acceleration is known.
    fn series_step(
        &mut self,
        phase: Phase,
        StepPoint { x, v: y }: StepPoint,
        forward: f64,
        (rising, known): (Option<bool>, Option<f64>),
    ) -> Result<PhaseStep> {
        let model = self.model;
        let (side, (least, most)) = (model.side(phase), model.range(phase));
        let rising = rising.unwrap_or_else(|| {
            let rate = forward * known.unwrap_or_else(|| model.force(phase, y).0 - x);
            // Without acceleration the speed has its maximum here.
            if rate == 0.0 {
                phase == Phase::Below
            } else {
                rate > 0.0
            }
        });
        let piece = side.piece(y, rising).ok_or_else(|| self.outside(phase, y))?;
        self.series.expand((side, piece), (x, y), forward, known);
        self.steps += 1;
        let (series, left) = (&self.series, self.series.left);
        let length = series.length(model.tolerance);
        let length = if model.tolerance > FINEST {
            length.min(LONGEST)
        } else {
            length
        };
        if !(length > 0.0 && length.is_finite()) {
            // Without terms nothing moves; with terms that overflow it moves beyond all bounds.
            let settles = length == f64::INFINITY;
            return Err(if settles { Reason::Settles } else { Reason::Escapes });
        }
        let terms = &series.step.y;
        let velocity = |t: f64| value_and_slope(terms, t);
        let turning = |t: f64| value_and_slope(&derivative(terms), t);
        let (low, high) = (piece.low.max(least), piece.high.min(most));
        let (peak, hit) = crossing(phase, length, (low, high), &velocity, &turning);
        let (duration, level) = match hit {
            Some((time, level)) if time <= left => (time, Some(level)),
            _ => (length.min(left), None),
        };
        let peak = peak.filter(|peak| *peak <= duration);
        let (last, slope) = velocity(duration);
        let end = StepPoint { x: value(&series.step.x, duration), v: level.unwrap_or(last) };
        let (place, offset) = (ContactState::Slips(phase), model.offset(phase));
        let is_last = |level: f64| {
            let outer = if level == high {
                side.pieces.last()
            } else {
                side.pieces.first()
            };
            outer.is_some_and(|outer| outer.low == piece.low)
        };
        Ok(PhaseStep {
            step: MachineStep { place, duration, peak, offset, ..series.step },
            end,
            slopes: (terms[1], slope),
            level: level.map(|level| (level, is_last(level))),
        })
    }

    /// Fails where a motion of some size at its start has settled, or turns no more, or has escaped.
    fn stays(&self, (phase, forward): (Phase, f64), started: f64, end: StepPoint) -> Result<()> {
        let size = end.size();
        let near = if self.follows { NEAR * started } else { f64::INFINITY };
        let settles = size <= near && creeps(phase, self.model.side(phase), end, forward);
        if settles || size < SETTLED * started {
            return Err(Reason::Settles);
        }
        let escapes = size.is_nan() || size > ESCAPED * started;
        if escapes { Err(Reason::Escapes) } else { Ok(()) }
    }

    /// That a velocity is beyond the law, which ends at the slip that is told.
    fn outside(&self, phase: Phase, y: f64) -> Reason {
        let pieces = &self.model.side(phase).pieces;
        let low = pieces.first().map_or(y, |piece| piece.low);
        let end = pieces.last().map_or(y, |piece| y.max(low).min(piece.high));
        Reason::BeyondLaw { slip: (self.model.speed - end).abs() * self.model.omega_0 }
    }
}

/// Whether a motion creeps to the balance of its phase without another turn.
///
/// Where every velocity up to `x` decays at least twice as fast as `x` pulls, no motion leaves the wedge
/// `y = 0 .. -x`: on its edge `y = -x` the sum `x + y` moves inwards.
fn creeps(phase: Phase, side: &ForceBranch, end: StepPoint, forward: f64) -> bool {
    const OVERDAMPED: f64 = 2.0;
    let StepPoint { x, v: y } = end;
    phase != Phase::Above
        && x * y * forward <= 0.0
        && y.abs() <= x.abs()
        && side.decay(x.abs(), forward).is_some_and(|decay| decay >= OVERDAMPED)
}
