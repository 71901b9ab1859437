//! The interface of an integration method: one step of the smooth field on one side of `v = 0`.

use std::fmt::Debug;

use nalgebra::Vector3;

use super::Cost;
use crate::model::{Field, HalfPlane, Reason, Result};
use crate::numerics::{GAUSS, Scalar, real};

/// A point `(x, v)` in the frame of a half plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPoint<N = f64> {
    /// Position.
    pub x: N,
    /// Velocity, not negative inside a half swing.
    pub v: N,
}

impl<N: Scalar> StepPoint<N> {
    /// Size of the state, `max(abs(x), abs(v))`.
    pub fn size(self) -> f64 {
        self.x.value().abs().max(self.v.value().abs())
    }

    /// The point rounded to doubles.
    pub fn rounded(self) -> StepPoint {
        StepPoint { x: self.x.value(), v: self.v.value() }
    }

    /// The point `2^k` times as far out.
    pub fn times_power(self, k: i32) -> Self {
        StepPoint { x: self.x.times_power(k), v: self.v.times_power(k) }
    }
}

/// The error allowed in each component of a step between these points with this relative tolerance.
///
/// For the position it is relative to the state, for the velocity to the velocities of the step. Far out,
/// velocities are much smaller than the position, yet it is the velocity that escapes, creeps or changes sign.
pub fn allowed_error(tolerance: f64, start: StepPoint, end: StepPoint) -> StepPoint {
    StepPoint {
        x: tolerance * start.size().max(end.size()),
        v: tolerance * start.v.abs().max(end.v.abs()),
    }
}

/// Longest step of a method that looks for `v = 0` where damping is below critical: half of the shortest half
/// swing of a linear oscillator (pi), rounded up. No step of at most this length passes two crossings.
pub const LONGEST: f64 = 2.0;

/// Refuses a step of fixed length in which damping at this rate is too fast.
pub fn check_stability(step: f64, rate: f64) -> Result<()> {
    /// A step counts as stable below this many damping times. The bound of the classical method is 2.785 for real
    /// eigenvalues, but the eigenvalue may grow within the step; the equation of a time step is a contraction below
    /// this number, and can be solved.
    const STABLE: f64 = 2.0;
    if step * rate > STABLE {
        return Err(Reason::StepTooLong { step, stable: STABLE / rate });
    }
    Ok(())
}

/// The longest first step worth trying when the velocity falls at once: a few times the time in which it would
/// reach zero at this rate. Without this bound an arrival after 1e-300 would be sought in steps of 1.
pub fn stopping_time(v: f64, acceleration: f64) -> f64 {
    const FEW: f64 = 4.0;
    if v > 0.0 && acceleration < 0.0 {
        FEW * v / -acceleration
    } else {
        f64::INFINITY
    }
}

/// A first step: the state may change by a hundredth of its size (Hairer, Norsett and Wanner II.4).
pub fn first_length(from: StepPoint, acceleration: f64) -> f64 {
    let slope = from.v.abs().max(acceleration.abs());
    if slope > 0.0 {
        (0.01 * from.size() / slope).min(LONGEST)
    } else {
        LONGEST
    }
}

/// An accepted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<N = f64> {
    /// Duration of the step.
    pub duration: N,
    /// End point.
    pub end: StepPoint<N>,
    /// Whether it ended by arriving at `v = 0`; `end.v` is then exactly 0.
    pub crossed: bool,
}

impl<N: Scalar> Step<N> {
    /// Whether a motion above `v = 0` can arrive at the end point: at `x < 0` the field would lift it off again.
    pub fn is_possible(&self) -> bool {
        self.end.x >= N::default()
    }
}

/// Integrals of `v^2`, `v^3` and `v^4` over a piece of a motion; they give the work of the damping terms.
pub type Powers = Vector3<f64>;

/// These powers of a velocity.
pub fn powers(v: f64) -> Powers {
    let square = v * v;
    Powers::new(square, square * v, square * square)
}

/// The integrals of a velocity from 0 to `duration`, by Gauss's rule on so many pieces.
pub fn powers_over(duration: f64, pieces: usize, velocity: impl Fn(f64) -> f64) -> Powers {
    let width = duration / real(pieces);
    let node = |piece, (node, weight)| weight * width * powers(velocity((piece + node) * width));
    (0..pieces).flat_map(|piece| GAUSS.map(|at| node(real(piece), at))).sum()
}

/// The integrals over `duration` by the quadrature of a method, whose stages are the nodes.
pub fn powers_of_stages(duration: f64, weights: &[f64], velocity: &[f64]) -> Powers {
    let nodes = weights.iter().zip(velocity);
    nodes.map(|(weight, v)| weight * duration * powers(*v)).sum()
}

/// A method that integrates a smooth field, by default that of one side, in numbers of one kind.
///
/// The field stays the same between calls of [`Stepper::begin`]. After an accepted step, [`Stepper::at`] and
/// [`Stepper::powers`] refer to that step.
pub trait Stepper<F: Field = HalfPlane, N: Scalar = f64>: Debug {
    /// Prepares for steps in this field.
    fn begin(&mut self, field: &F);

    /// Takes one step of at most `longest`. If it `arrives`, it begins at a point with `v >= 0` (on `v = 0`: with
    /// `x < 0`) and leads not beyond the first arrival at `v = 0`; otherwise wherever it leads. Fails with
    /// [`Reason::StepTooSmall`] or [`Reason::OutOfRange`] where no step meets the tolerance.
    fn advance(&mut self, from: StepPoint<N>, longest: N, arrives: bool) -> Result<Step<N>>;

    /// The point at `time` after the start of the last step.
    fn at(&self, time: f64) -> StepPoint;

    /// The integrals of the powers of `v` over the last step.
    fn powers(&self) -> Powers;

    /// Number of pieces of moderate curvature in the last step, for drawing.
    fn pieces(&self) -> usize {
        1
    }

    /// Evaluations and rejected steps so far; accepted steps are not counted.
    fn cost(&self) -> Cost;
}
