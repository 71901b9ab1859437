//! Explicit Runge-Kutta: the adaptive pairs DOP853 and DOPRI5, and the classical method of fixed step.
//!
//! One stepper serves all [`Scheme`]s. The adaptive schemes use the step size control of Hairer, Norsett and
//! Wanner (sections II.4 and II.10 of their book). A step that passes `v = 0` is repeated with Newton's method
//! on its length until it ends there, so a crossing is as accurate as a step.

use std::cell::Cell;

use super::{
    Cost, ErrorEstimate, LONGEST, Powers, Scheme, Step, StepPoint, Stepper, allowed_error,
    check_stability, first_length, powers_of_stages, stopping_time,
};
use crate::model::{Field, HalfPlane, Reason, Result};
use crate::numerics::{Bracket, PlaceTolerance, newton, rough_exp2, rough_log2};

/// Relative change of the length of the last step below which it counts as settled. This takes about four
/// attempts; one more would change the length by the square of this.
const SETTLED: f64 = 1e-9;

/// An explicit Runge-Kutta stepper.
#[derive(Clone, Debug)]
pub struct ExplicitStepper<const S: usize, const R: usize, F: Field = HalfPlane> {
    scheme: &'static Scheme<S, R>,
    field: F,
    /// Largest estimated relative error of a step; unused where steps have a fixed length.
    tolerance: f64,
    /// Length to try next; 0 before the first step of an adaptive scheme.
    next: f64,
    start: StepPoint,
    end: StepPoint,
    duration: f64,
    /// Slopes of x (the velocities of the stages) and of v.
    velocity: [f64; S],
    acceleration: [f64; S],
    /// Error estimates of the last attempt.
    errors: [(f64, f64); 2],
    cost: Cost,
    /// Evaluations for points within steps.
    within: Cell<u64>,
}

impl<const S: usize, const R: usize, F: Field> ExplicitStepper<S, R, F> {
    /// A stepper whose estimated relative error of each step stays below `accuracy`; without an error estimate, one
    /// with steps of this length.
    pub fn new(scheme: &'static Scheme<S, R>, field: F, accuracy: f64) -> Self {
        let fixed = scheme.estimate == ErrorEstimate::None;
        ExplicitStepper {
            scheme,
            field,
            tolerance: accuracy,
            next: if fixed { accuracy } else { 0.0 },
            start: StepPoint { x: 0.0, v: 0.0 },
            end: StepPoint { x: f64::NAN, v: f64::NAN },
            duration: 0.0,
            velocity: [0.0; S],
            acceleration: [0.0; S],
            errors: [(0.0, 0.0); 2],
            cost: Cost::default(),
            within: Cell::default(),
        }
    }

    fn is_fixed(&self) -> bool {
        self.scheme.estimate == ErrorEstimate::None
    }

    /// Makes `from` the start of the next attempts and evaluates the slope there unless it is known.
    fn start_at(&mut self, from: StepPoint) {
        let slope = if self.scheme.last_is_end && from == self.end {
            self.acceleration[S - 1]
        } else {
            self.cost.evaluations += 1;
            self.field.acceleration(from.x, from.v)
        };
        (self.start, self.velocity[0], self.acceleration[0]) = (from, from.v, slope);
    }

    /// One step of length `h` from `self.start`, whose slope is already known.
    fn attempt(&mut self, h: f64) -> StepPoint {
        let columns = &self.scheme.columns;
        let (mut sum_x, mut sum_v) = ([0.0; R], [0.0; R]);
        for (j, column) in columns.iter().enumerate() {
            if j > 0 {
                let x = self.start.x + h * sum_x[j - 1];
                let v = self.start.v + h * sum_v[j - 1];
                self.velocity[j] = v;
                self.acceleration[j] = self.field.acceleration(x, v);
            }
            let (velocity, acceleration) = (self.velocity[j], self.acceleration[j]);
            for i in 0..R {
                sum_x[i] += column[i] * velocity;
                sum_v[i] += column[i] * acceleration;
            }
        }
        self.cost.evaluations += S as u64 - 1;
        for (error, i) in self.errors.iter_mut().zip(S..R) {
            *error = (sum_x[i], sum_v[i]);
        }
        StepPoint { x: self.start.x + h * sum_x[S - 1], v: self.start.v + h * sum_v[S - 1] }
    }

    /// Error of the attempt in units of the tolerance (accepted up to 1), and the power of the step length with
    /// which it grows.
    fn error(&self, h: f64, end: StepPoint) -> (f64, f64) {
        let scale = allowed_error(self.tolerance, self.start, end);
        let norm = |(x, v): (f64, f64)| {
            let (x, v) = (x / scale.x, v / scale.v);
            x * x + v * v
        };
        match self.scheme.estimate {
            ErrorEstimate::None => (if end.size().is_finite() { 0.0 } else { f64::INFINITY }, 1.0),
            ErrorEstimate::Embedded(power) => (h * (0.5 * norm(self.errors[0])).sqrt(), power),
            ErrorEstimate::Combined(power) => {
                let (fifth, third) = (norm(self.errors[0]), norm(self.errors[1]));
                if fifth == 0.0 && third == 0.0 {
                    return (0.0, power);
                }
                // Two components; 0.01 is the published weight of the third-order estimate.
                (h * fifth / (2.0 * (fifth + 0.01 * third)).sqrt(), power)
            }
        }
    }

    /// Repeats the step until its error is within the tolerance.
    ///
    /// Where it `arrives`, a step that turned around passed two crossings and is repeated as well.
    fn accepted(&mut self, longest: f64, arrives: bool) -> Result<(f64, StepPoint)> {
        if self.next == 0.0 {
            self.next = first_length(self.start, self.acceleration[0]);
        }
        let mut grow = 10.0;
        let mut length = self.next.min(longest);
        loop {
            if length < f64::MIN_POSITIVE {
                return Err(Reason::StepTooSmall { step: length });
            }
            let end = self.attempt(length);
            let (error, power) = self.error(length, end);
            let factor = |error: f64| 0.9 * rough_exp2(-rough_log2(error) / power);
            let turned = arrives && end.v > 0.0 && end.x < self.start.x;
            if error <= 1.0 && !turned {
                (self.end, self.duration) = (end, length);
                if !self.is_fixed() {
                    let factor = if error == 0.0 {
                        grow
                    } else {
                        factor(error).clamp(0.2, grow)
                    };
                    let next = (length * factor).min(LONGEST);
                    // A step cut short by the end time says nothing about the length of the next one.
                    self.next = if length < self.next {
                        self.next.max(next)
                    } else {
                        next
                    };
                }
                return Ok((length, end));
            }
            self.cost.rejected += 1;
            if self.is_fixed() && !error.is_finite() {
                return Err(Reason::OutOfRange);
            }
            grow = 1.0;
            let shorter = factor(error.max(1.0)).clamp(0.2, 0.9);
            length *= if error.is_finite() { shorter } else { 1e-3 };
            if !self.is_fixed() {
                self.next = length;
            }
        }
    }

    /// Shortens the step until it ends at `v = 0`.
    fn arrive(&mut self, h: f64) -> Step {
        let field = self.field;
        let slope = |end: StepPoint| field.acceleration(end.x, end.v);
        let (mut length, mut end) = (h, self.end);
        if (end.v / slope(end)).abs() > SETTLED * h {
            let bracket = Bracket::falling(0.0, h);
            let start = bracket.inside(h - end.v / slope(end));
            newton(bracket, start, PlaceTolerance::Relative(SETTLED), |shorter| {
                (length, end) = (shorter, self.attempt(shorter));
                (end.v, slope(end))
            });
        }
        let slope = slope(end);
        let rest = if slope == 0.0 { 0.0 } else { -end.v / slope };
        // The stages belong to `length`: quantities computed from them must not be stretched by `rest`.
        (self.duration, self.end) = (length, end);
        let end = StepPoint { x: end.x + rest * end.v + 0.5 * rest * rest * slope, v: 0.0 };
        Step { duration: (length + rest).max(0.0), end, crossed: true }
    }
}

impl<const S: usize, const R: usize, F: Field> Stepper<F> for ExplicitStepper<S, R, F> {
    fn begin(&mut self, field: &F) {
        self.field = *field;
        // The slope at the end of the last step belonged to another field.
        self.end = StepPoint { x: f64::NAN, v: f64::NAN };
    }

    fn advance(&mut self, from: StepPoint, mut longest: f64, arrives: bool) -> Result<Step> {
        let continues = from == self.end;
        self.start_at(from);
        if arrives && !continues {
            longest = longest.min(stopping_time(from.v, self.acceleration[0]));
        }
        loop {
            let (duration, end) = self.accepted(longest, arrives)?;
            if self.is_fixed() {
                let rates = self.velocity.iter().map(|v| self.field.divergence(*v).abs());
                check_stability(duration, rates.fold(0.0, f64::max))?;
            }
            if !arrives || end.v > 0.0 {
                return Ok(Step { duration, end, crossed: false });
            }
            let arrival = self.arrive(duration);
            if arrival.is_possible() {
                return Ok(arrival);
            }
            self.cost.rejected += 1;
            longest = 0.5 * duration;
        }
    }

    /// A shorter step of the same method from the same start, which is at least as accurate.
    fn at(&self, time: f64) -> StepPoint {
        let mut shorter = self.clone();
        shorter.cost.evaluations = 0;
        let point = shorter.attempt(time);
        self.within.set(self.within.get() + shorter.cost.evaluations);
        point
    }

    /// The quadrature of the method: its stages are the nodes.
    fn powers(&self) -> Powers {
        powers_of_stages(self.duration, &self.scheme.weights, &self.velocity)
    }

    fn cost(&self) -> Cost {
        Cost { evaluations: self.cost.evaluations + self.within.get(), ..self.cost }
    }
}
