//! Dry friction without events, for comparison: turned into a field, so that common integrators can run across `v = 0`,
//! or balanced over fixed steps.
//!
//! There are two common practices of the first kind. One replaces the sign by `tanh(v/epsilon)`. The field is then smooth
//! but stiff, with rate `r/epsilon` near `v = 0`, and vanishes nowhere else in the sticking set, so that nothing
//! else ever rests. The other keeps the sign. What should rest then chatters across `v = 0`, and the steps lose
//! the order of their method.
//!
//! Moreau and Jean's time stepping requires a balance of impulses over each fixed step, in which friction takes whatever
//! value within `[-r, r]` the balance needs.
//!
//! Over a step of length h the midpoint rule covers restoring force and damping; friction acts with one value
//! of the set-valued sign of the velocity at the end of the step. If friction can bring the velocity to rest,
//! it does. The method therefore sticks where it should, but it locates no crossing, and each passage of
//! `v = 0` costs an error of order `h^2` in v (J. J. Moreau, *Unilateral contact and dry friction in finite
//! freedom dynamics*, 1988; M. Jean, *The non-smooth contact dynamics method*, Computer Methods in Applied
//! Mechanics and Engineering 177, 1999).

use super::{Cost, Powers, Step, StepPoint, Stepper, check_stability, powers};
use crate::model::{Field, HalfPlane, PlaneField, Reason, Result};
use crate::numerics::{tanh, times_power};

/// The field of the whole phase plane with friction as a function of the velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothField {
    /// Damping and restoring force.
    pub smooth: HalfPlane,
    /// Intensity of the friction.
    pub r: f64,
    /// The velocity over which `tanh(v/epsilon)` smoothes the sign of `v`; `None`: the sign itself, 0 at 0.
    pub epsilon: Option<f64>,
}

impl Field for SmoothField {
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        let sign = match self.epsilon {
            Some(epsilon) => tanh(v / epsilon),
            None if v == 0.0 => 0.0,
            None => v.signum(),
        };
        self.smooth.acceleration(x, v) - self.r * sign
    }

    fn divergence(&self, v: f64) -> f64 {
        let slope = self.epsilon.map_or(0.0, |epsilon| {
            let tanh = tanh(v / epsilon);
            (1.0 - tanh) * (1.0 + tanh) / epsilon
        });
        self.smooth.divergence(v) - self.r * slope
    }
}

impl PlaneField for SmoothField {
    fn in_units(&self, k: i32) -> Self {
        SmoothField {
            smooth: self.smooth.in_units(k),
            r: times_power(self.r, -k),
            epsilon: self.epsilon.map(|epsilon| times_power(epsilon, -k)),
        }
    }

    fn magnitude(&self, x: f64, v: f64) -> f64 {
        self.smooth.magnitude(x, v) + self.r
    }

    fn frictionless(&self) -> HalfPlane {
        self.smooth
    }
}

/// Newton iterations for the velocity at the end of a step. The residual is nearly linear.
const ITERATIONS: usize = 50;

/// The time stepper, in coordinates `(q, v)` of the whole phase plane. Of its field it needs the smooth part and the
/// intensity of the friction.
#[derive(Clone, Debug)]
pub struct TimeStepping {
    field: SmoothField,
    length: f64,
    start: StepPoint,
    end: StepPoint,
    duration: f64,
    cost: Cost,
}

impl TimeStepping {
    /// A stepper with steps of this length.
    pub fn new(field: SmoothField, length: f64) -> Self {
        let start = StepPoint { x: 0.0, v: 0.0 };
        let cost = Cost::default();
        TimeStepping { field, length, start, end: start, duration: length, cost }
    }

    /// The impulse still needed from friction if the step is to end with velocity `v`.
    fn missing(&mut self, h: f64, v: f64) -> f64 {
        self.cost.evaluations += 1;
        let StepPoint { x, v: before } = self.start;
        let middle = 0.5 * (before + v);
        let position = x + 0.5 * h * middle;
        (v - before) - h * self.field.smooth.acceleration(position, middle)
    }

    /// Velocity at the end of a step under constant `friction`, by Newton's method.
    fn solve(&mut self, h: f64, friction: f64) -> Result<f64> {
        let mut v = self.start.v;
        let mut change = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let residual = self.missing(h, v) - h * friction;
            let middle = 0.5 * (self.start.v + v);
            let slope = 1.0 + 0.25 * h * h - 0.5 * h * self.field.smooth.divergence(middle);
            let step = residual / slope;
            v -= step;
            change = step.abs();
            if change <= 4.0 * f64::EPSILON * v.abs().max(self.start.v.abs()) {
                return Ok(v);
            }
            if !v.is_finite() {
                return Err(Reason::OutOfRange);
            }
        }
        Err(Reason::NoConvergence { sought: "the velocity after a step", change })
    }
}

impl Stepper<SmoothField> for TimeStepping {
    fn begin(&mut self, field: &SmoothField) {
        self.field = *field;
    }

    /// It looks for no arrival.
    fn advance(&mut self, from: StepPoint, longest: f64, _: bool) -> Result<Step> {
        let h = self.length.min(longest);
        self.start = from;
        check_stability(h, self.field.smooth.divergence(from.v).abs())?;
        let to_rest = self.missing(h, 0.0);
        let strongest = h * self.field.r;
        let v = if to_rest.abs() <= strongest {
            0.0
        } else {
            // The missing impulse grows with v: if it exceeds what friction can supply, v ends below 0.
            self.solve(h, if to_rest > 0.0 { self.field.r } else { -self.field.r })?
        };
        self.duration = h;
        self.end = StepPoint { x: from.x + 0.5 * h * (from.v + v), v };
        if !self.end.size().is_finite() {
            return Err(Reason::OutOfRange);
        }
        Ok(Step { duration: h, end: self.end, crossed: false })
    }

    /// Within a step the velocity is taken to be linear, as in the method.
    fn at(&self, time: f64) -> StepPoint {
        let part = time / self.duration;
        let v = self.start.v + part * (self.end.v - self.start.v);
        StepPoint { x: self.start.x + 0.5 * time * (self.start.v + v), v }
    }

    fn powers(&self) -> Powers {
        self.duration * powers(0.5 * (self.start.v + self.end.v))
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}

#[cfg(test)]
mod tests;
