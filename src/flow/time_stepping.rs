//! Moreau and Jean's time stepping, for comparison: fixed steps that require a balance of impulses, in which
//! friction takes whatever value within `[-r, r]` the balance needs.
//!
//! Over a step of length h the midpoint rule covers restoring force and damping; friction acts with one value
//! of the set-valued sign of the velocity at the end of the step. If friction can bring the velocity to rest,
//! it does. The method therefore sticks where it should, but it locates no crossing, and each passage of
//! `v = 0` costs an error of order `h^2` in v (J. J. Moreau, *Unilateral contact and dry friction in finite
//! freedom dynamics*, 1988; M. Jean, *The non-smooth contact dynamics method*, Computer Methods in Applied
//! Mechanics and Engineering 177, 1999).

use super::motion::Cost;
use super::regularized::SmoothField;
use super::step::{Powers, Step, StepPoint, Stepper};
use crate::model::Reason;

/// Newton iterations for the velocity at the end of a step. The residual is nearly linear.
const ITERATIONS: usize = 50;

/// Below this many damping times the equation of a step is a contraction and can be solved.
const STABLE: f64 = 2.0;

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
        TimeStepping { field, length, start, end: start, duration: length, cost: Cost::default() }
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
    fn solve(&mut self, h: f64, friction: f64) -> Result<f64, Reason> {
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
    fn advance(&mut self, from: StepPoint, longest: f64, _: bool) -> Result<Step, Reason> {
        let h = self.length.min(longest);
        self.start = from;
        let rate = self.field.smooth.divergence(from.v).abs();
        if h * rate > STABLE {
            return Err(Reason::StepTooLong { step: h, stable: STABLE / rate });
        }
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
        Powers::of_stages(self.duration, &[1.0], &[0.5 * (self.start.v + self.end.v)])
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}
