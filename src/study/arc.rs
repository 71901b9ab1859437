//! One half swing as a curve: its speed as a function of the displacement.
//!
//! Above `v = 0` displacement only grows, below it only falls, so within its half plane every motion is
//! a graph over q. That is what makes basins cheap: whether a start lies inside a closed orbit is one
//! comparison with the graph at its q. The graph is kept as the polynomials of the
//! integration steps and evaluated to rounding by Newton's method in time.

use super::half_map::{HalfMap, HalfSwing, Length, NoEnd};
use crate::flow::auto::LastStep;
use crate::flow::scaling::times_power;
use crate::flow::step::Powers;
use crate::flow::tableau::GAUSS;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{HalfPlane, Parameters, Side, State};

/// Integration tolerance of an arc.
const TOLERANCE: f64 = 1e-14;

/// Part of its start below which an arc is not resolved: it is drawn and compared, not continued.
const DETAIL: f64 = 1e-12;

/// Most evaluations of an arc. All its steps are kept, and this many take some ten megabytes.
const BUDGET: u64 = 400_000;

/// The direction in which an arc is computed; as a curve it is the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From where the swing starts.
    Forward,
    /// From where the swing ends, backward in time.
    Backward,
}

/// One integration step of an arc.
#[derive(Clone, Debug)]
struct Piece {
    step: LastStep,
    unit: i32,
    duration: f64,
    /// Position at its end, in the direction of the computation.
    end: f64,
}

/// A half swing as a graph `v(q)`.
#[derive(Clone, Debug)]
pub struct Arc {
    side: Side,
    r: f64,
    /// -1 where the arc was computed backward: positions are then those of `y = -x`.
    sense: f64,
    start: f64,
    pieces: Vec<Piece>,
    /// The swing, or why it has no end.
    pub swing: Result<HalfSwing, NoEnd>,
    /// What it cost.
    pub cost: Cost,
}

impl Arc {
    /// The swing on `side` that starts with clearance `length` (forward), or ends at position `length`
    /// of its half plane (backward).
    ///
    /// # Errors
    /// The [`Reason`] why it could not be computed; escape is not an error.
    pub fn new(
        parameters: &Parameters,
        side: Side,
        direction: Direction,
        length: Length,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let forward = HalfPlane::new(parameters, side);
        let (field, sense) = match direction {
            Direction::Forward => (forward, 1.0),
            Direction::Backward => (forward.reversed(), -1.0),
        };
        let detail = DETAIL * (length.value + parameters.r);
        let mut map = HalfMap::integrating_above(detail, field, TOLERANCE);
        let mut pieces: Vec<Piece> = Vec::new();
        let limits =
            Limits { evaluations: limits.evaluations.min(BUDGET), interrupted: limits.interrupted };
        let swing = map.swing_watched(length, &limits, |stepper, unit, duration| {
            let step = stepper.last_step();
            let end = times_power(step.at(duration).x, unit);
            pieces.push(Piece { step, unit, duration, end });
        });
        if let Err(NoEnd::Failed(reason)) = swing {
            return Err(reason);
        }
        Ok(Arc {
            side,
            r: parameters.r,
            sense,
            start: -length.value,
            pieces,
            swing,
            cost: map.cost(),
        })
    }

    /// Speed `abs(v)` where the arc passes the displacement `q`: `None` beyond its turning points,
    /// infinity beyond where it ran away.
    #[must_use]
    pub fn speed_at(&self, q: f64) -> Option<f64> {
        let target = self.sense * self.side.position(q, self.r);
        if target < self.start {
            return None;
        }
        let index = self.pieces.partition_point(|piece| piece.end < target);
        let Some(piece) = self.pieces.get(index) else {
            let gone = matches!(self.swing, Err(NoEnd::Escapes));
            return gone.then_some(f64::INFINITY);
        };
        Some(piece.speed_at(target))
    }

    /// Whether it was computed backward in time.
    #[must_use]
    pub fn is_backward(&self) -> bool {
        self.sense < 0.0
    }

    /// Area between the arc and `v = 0`: the integral of `v dq`, which is that of `v^2 dtau`.
    #[must_use]
    pub fn area(&self) -> f64 {
        let piece_area = |piece: &Piece| {
            let second = piece.step.powers().second;
            times_power(times_power(second, piece.unit), piece.unit)
        };
        self.pieces.iter().map(piece_area).sum()
    }

    /// The integrals of powers of the speed over time.
    #[must_use]
    pub fn powers(&self) -> Powers {
        let mut sum = Powers::default();
        for Piece { step, unit, .. } in &self.pieces {
            let powers = step.powers();
            let square = times_power(times_power(1.0, *unit), *unit);
            sum.second += square * powers.second;
            sum.third += times_power(square * powers.third, *unit);
            sum.fourth += square * (square * powers.fourth);
        }
        sum
    }

    /// The integral of the displacement over time.
    #[must_use]
    pub fn time_integral(&self) -> f64 {
        let piece_integral = |piece: &Piece| {
            let displacement = |time: f64| {
                let x = self.sense * times_power(piece.step.at(time).x, piece.unit);
                self.side.displacement(x, self.r)
            };
            let node = |(node, weight): &(f64, f64)| weight * displacement(node * piece.duration);
            piece.duration * GAUSS.iter().map(node).sum::<f64>()
        };
        self.pieces.iter().map(piece_integral).sum()
    }

    /// Points along the arc in the order of time, `count` on each integration step.
    #[must_use]
    pub fn points(&self, count: u16) -> Vec<State> {
        let mut points = Vec::new();
        for piece in &self.pieces {
            let first = u16::from(!points.is_empty());
            for index in first..=count {
                let point = piece.step.at(piece.duration * f64::from(index) / f64::from(count));
                let x = self.sense * times_power(point.x, piece.unit);
                let v = self.side.sign() * times_power(point.v, piece.unit);
                points.push(State { q: self.side.displacement(x, self.r), v });
            }
        }
        if self.sense < 0.0 {
            points.reverse();
        }
        points
    }
}

impl Piece {
    /// v where the position is `target`, which lies on this piece.
    fn speed_at(&self, target: f64) -> f64 {
        /// Newton steps; the position is monotone in time, so that a bracket always holds.
        const STEPS: usize = 60;
        let target = times_power(target, -self.unit);
        let (mut low, mut high) = (0.0, self.duration);
        let mut time = 0.5 * self.duration;
        for _ in 0..STEPS {
            let point = self.step.at(time);
            let newton = time - (point.x - target) / point.v;
            if (newton - time).abs() <= 1e-12 * self.duration {
                break;
            }
            if point.x > target {
                high = time;
            } else {
                low = time;
            }
            time = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        }
        times_power(self.step.at(time).v, self.unit).max(0.0)
    }
}
