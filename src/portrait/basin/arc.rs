//! One half swing as a curve: its speed as a function of the displacement.
//!
//! Above `v = 0` displacement only grows, below it only falls, so within its half plane every motion is
//! a graph over q. That is what makes basins cheap: whether a start lies inside a closed orbit is one
//! comparison with the graph at its q. The graph is kept as the polynomials of the
//! integration steps and evaluated to rounding by Newton's method in time.

use std::sync::Arc as Shared;

use crate::flow::{Cost, ExactStepper, KeptStep, Limits, Powers, Result, StepPoint, Stepper};
use crate::model::{HalfPlane, Parameters, Side, State};
use crate::numerics::{Bracket, PlaceTolerance, newton, times_power};
use crate::portrait::{Direction, HalfMap, HalfSwing, Length};

/// Integration tolerance of an arc.
const TOLERANCE: f64 = 1e-14;

/// Part of its start below which an arc is not resolved: it is drawn and compared, not continued.
const DETAIL: f64 = 1e-12;

/// Maximum number of evaluations of an arc. All its steps are kept, and this many take some ten megabytes.
const BUDGET: u64 = 400_000;

/// One integration step of an arc.
#[derive(Clone, Debug)]
struct ArcStep {
    step: KeptStep,
    unit: i32,
    duration: f64,
    /// Position at its end, in the direction of the computation.
    end: f64,
}

/// A half swing as a graph `v(q)`.
#[derive(Clone, Debug)]
pub struct Arc {
    side: Side,
    pub(super) r: f64,
    /// That in which the arc was computed.
    field: HalfPlane,
    /// As a curve the arc is the same in both. Computed backward, positions are those of `y = -x`.
    direction: Direction,
    /// Of the swing (forward), or of the next one (backward).
    pub(super) clearance: Length,
    pieces: Vec<ArcStep>,
    /// From where the motion is linear to its end, if it was not followed there.
    rest: Option<ArcStep>,
    /// The swing.
    pub swing: HalfSwing,
    pub cost: Cost,
}

impl Arc {
    /// The swing on `side` that starts with this `clearance` (forward), or after which the next one starts
    /// starts with it (backward). Fails with the `Reason` why it could not be computed; escape is not an error.
    pub fn new(
        parameters: &Parameters,
        side: Side,
        direction: Direction,
        clearance: Length,
        limits: &Limits,
    ) -> Result<Self> {
        let forward = HalfPlane::new(parameters, side);
        let (field, length) = match direction {
            Direction::Forward => (forward, clearance),
            Direction::Backward => (forward.reversed(), clearance.plus(2.0 * parameters.r)),
        };
        // Where friction is many times the natural scale, the motion is not linear yet at that size.
        let mut map = HalfMap::new(field, TOLERANCE);
        map.linear_below = map.linear_below.min(DETAIL * (clearance.value + parameters.r));
        let mut pieces = Vec::new();
        let limits = limits.up_to(BUDGET);
        let swing = map.swing_watched(length, true, &limits, |stepper, unit, duration| {
            let step = stepper.last_step();
            let end = times_power(step.at(duration).x, unit);
            pieces.push(ArcStep { step, unit, duration, end });
        })?;
        Ok(Arc {
            side,
            r: parameters.r,
            field,
            direction,
            clearance,
            rest: rest(&field, &pieces, map.linear_below),
            pieces,
            swing,
            cost: map.cost(),
        })
    }

    /// Speed `abs(v)` where the arc passes the displacement `q`: `None` beyond its turning points,
    /// infinity beyond where it ran away.
    pub fn speed_at(&self, q: f64) -> Option<f64> {
        let target = self.direction.sense() * self.side.position(q, self.r);
        if self.direction == Direction::Backward {
            let short = self.clearance.value - (self.side.sign() * q - self.r);
            if short < 0.0 {
                return None;
            }
            if let Some(speed) = self.speed_before_end(short) {
                return Some(speed);
            }
        }
        if target < -self.swing.start.value {
            return None;
        }
        let index = self.pieces.partition_point(|piece| piece.end < target);
        let rest = self.rest.as_ref().filter(|rest| target <= rest.end);
        let Some(piece) = self.pieces.get(index).or(rest) else {
            return (self.swing.end == Length::INFINITE).then_some(f64::INFINITY);
        };
        Some(piece.speed_at(target))
    }

    /// The speed at a place that is `short` of where the swing ends by next to nothing.
    ///
    /// There a position has lost the digits that decide: `v` follows from the way that is left as in
    /// [`crate::flow::stop`], turned round, to second order.
    fn speed_before_end(&self, short: f64) -> Option<f64> {
        /// Part of the position below which it is next to nothing, and largest damping force beside it.
        const NEAR: f64 = 1e-10;
        const WEAK: f64 = 1e-3;
        let end = self.swing.start.value;
        let speed = (2.0 * short).sqrt() * end.sqrt();
        let HalfPlane { d, d2, d3 } = self.field;
        let force = speed * (2.0 * d.abs() + speed * (d2.abs() + speed * d3.abs()));
        let is_near = short <= NEAR * end && force <= WEAK * end;
        is_near.then(|| speed * (1.0 - 2.0 / 3.0 * d * (speed / end)))
    }

    /// The clearance at which the swing starts: 0 where it leaves a node that repels, infinite where it comes
    /// from infinity.
    pub fn clearance(&self) -> Length {
        if self.direction == Direction::Forward {
            self.clearance
        } else {
            self.swing.end
        }
    }

    /// The integrals of powers of the speed over time: that of `v^2` is the area between the arc and `v = 0`.
    pub fn powers(&self) -> Powers {
        let mut sum = Powers::zeros();
        for ArcStep { step, unit, .. } in &self.pieces {
            let [second, third, fourth] = step.powers().into();
            let square = times_power(times_power(1.0, *unit), *unit);
            sum += Powers::new(
                square * second,
                times_power(square * third, *unit),
                square * (square * fourth),
            );
        }
        sum
    }

    /// Points along the arc in the order of time, `count` on each integration step.
    pub fn points(&self, count: u16) -> Vec<State> {
        let mut points = Vec::new();
        for piece in &self.pieces {
            let first = u16::from(!points.is_empty());
            for index in first..=count {
                let time = piece.duration * f64::from(index) / f64::from(count);
                let StepPoint { x, v } = piece.step.at(time).times_power(piece.unit);
                let q = self.side.displacement(self.direction.sense() * x, self.r);
                points.push(State { q, v: self.side.sign() * v });
            }
        }
        if self.direction == Direction::Backward {
            points.reverse();
        }
        points
    }
}

/// What is left of an arc after `pieces` that end below `detail`: linear, so in closed form.
fn rest(field: &HalfPlane, pieces: &[ArcStep], detail: f64) -> Option<ArcStep> {
    /// Time after which a motion that creeps has decayed beyond the range of numbers, in units of its own.
    const DECAYED: f64 = 750.0;
    let &ArcStep { ref step, unit, duration, .. } = pieces.last()?;
    let from = step.at(duration);
    if field.d < 0.0 || from.v <= 0.0 || times_power(from.size(), unit) > detail {
        return None;
    }
    let mut exact = ExactStepper::new();
    exact.begin(&HalfPlane { d: field.d, d2: 0.0, d3: 0.0 });
    // Both times of decay have the product 1, and the sum 2 D.
    let step = exact.advance(from, DECAYED * (2.0 * field.d).max(1.0), true).ok()?;
    let end = times_power(step.end.x, unit);
    Some(ArcStep { step: Shared::new(exact), unit, duration: step.duration, end })
}

impl ArcStep {
    /// v where the position is `target`, which lies on this piece.
    fn speed_at(&self, target: f64) -> f64 {
        // The position is monotone in time.
        let target = times_power(target, -self.unit);
        let bracket = Bracket::rising(0.0, self.duration);
        let settled = PlaceTolerance::Absolute(1e-12 * self.duration);
        let time = newton(bracket, bracket.middle(), settled, |time| {
            let StepPoint { x, v } = self.step.at(time);
            (x - target, v)
        });
        times_power(self.step.at(time).v, self.unit).max(0.0)
    }
}
