//! Implicit collocation for stiff motions: Radau IIA of order 5, 9 or 13, L-stable.
//!
//! Far out, cubic damping forces the velocity onto a slow manifold at a rate that may be millions of times that
//! of the motion along it. An explicit step must follow that rate, an implicit one need not.
//!
//! The stages are the unknowns. Positions depend on velocities linearly, `X = x + h A V`, so only the
//! velocities remain: S equations with the analytic Jacobian `1 - h A div(V) + h^2 A^2`, solved by Newton's
//! method. The error estimate is the difference from an embedded solution of order S, filtered as described by
//! Hairer and Wanner in section IV.8 of *Solving Ordinary Differential Equations II*.
//!
//! Where damping is not stiff over a step, the order of the solution is higher than that of this difference and
//! its error correspondingly smaller. Where damping is stiff, the order is reduced to that of the stages and
//! the solution is hardly more accurate than the difference. The tolerance of the difference therefore depends
//! on both.

mod arrival;

use super::{
    Collocation, Cost, Differences, LONGEST, MOST, Powers, SCHEMES, StageMatrix, Stages, Step,
    StepPoint, Stepper, allowed_error, first_length, powers_of_stages, stopping_time,
};
use crate::model::{HalfPlane, PlaneField, Reason, Result};
use crate::numerics::{pow, real, rough_exp2, rough_log2};

/// The tolerance down to which three stages are enough.
const LOOSE: f64 = 5e-4;

/// The tolerance down to which five stages are enough.
const MEDIUM: f64 = 1e-8;

/// Fraction of the way to an arrival after which the arrival is sought anew, from nearby. Where a motion creeps
/// in along `v^2 = -x/D2`, a hundredth of the way out is left.
const SHORT_OF: f64 = 0.9;

/// Newton iterations before a step is repeated with a shorter length. They converge quadratically.
const ITERATIONS: usize = 12;

/// Smallest tolerance for the embedded solution: the difference from it is not known more accurately.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Difference from the embedded solution caused by rounding, in units of the rounding error of one velocity.
const NOISE: f64 = 16.0;

/// Fraction of the tolerance that Newton's method may leave as error.
const LEFT: f64 = 0.01;

/// Longest step, as a multiple of the previous one, for which the last polynomial gives a good initial guess.
const FORESEEN: f64 = 3.0;

/// The implicit stepper.
#[derive(Clone, Debug)]
pub struct StiffStepper<F: PlaneField = HalfPlane> {
    scheme: &'static Collocation,
    field: F,
    /// Tolerance of a step for the embedded solution, where damping is not stiff.
    tolerance: f64,
    /// The requested tolerance, that of the solution.
    asked: f64,
    /// Length to try next; 0 before the first step.
    pub(super) next: f64,
    start: StepPoint,
    /// Slope of v at the start.
    slope: f64,
    end: StepPoint,
    duration: f64,
    /// Velocities and accelerations of the stages.
    velocity: Stages,
    acceleration: Stages,
    /// Divided differences of x and v over the start and the nodes.
    dense: [Differences; 2],
    cost: Cost,
}

impl<F: PlaneField> StiffStepper<F> {
    /// A stepper with a relative error per step of about `tolerance`.
    pub fn new(field: F, tolerance: f64) -> Self {
        let [three, five, seven] = &*SCHEMES;
        let scheme = match tolerance {
            tolerance if tolerance >= LOOSE => three,
            tolerance if tolerance >= MEDIUM => five,
            _ => seven,
        };
        let stages = real(scheme.nodes.len());
        StiffStepper {
            scheme,
            field,
            // That which gives the solution, of order `2 S - 1`, about the requested one, where damping is not stiff
            // (as in the authors' program).
            tolerance: 0.1 * pow(tolerance, (stages + 1.0) / (2.0 * stages)),
            asked: tolerance,
            next: 0.0,
            start: StepPoint { x: 0.0, v: 0.0 },
            slope: 0.0,
            end: StepPoint { x: f64::NAN, v: f64::NAN },
            duration: 0.0,
            velocity: Stages::zeros(),
            acceleration: Stages::zeros(),
            dense: [[0.0; MOST + 1]; 2],
            cost: Cost::default(),
        }
    }

    fn start_at(&mut self, from: StepPoint) {
        self.slope = self.field.acceleration(from.x, from.v);
        self.cost.evaluations += 1;
        // The last polynomial gives an initial guess only where this step continues it.
        if !self.is_continued(from) {
            self.duration = 0.0;
        }
        self.start = from;
        if self.next == 0.0 {
            self.next = first_length(from, self.slope);
        }
    }

    /// Whether a step from here continues the last one. Where rounding holds a motion in place, the swing moves it to the
    /// next number.
    fn is_continued(&self, from: StepPoint) -> bool {
        let StepPoint { x, v } = self.end;
        from.v == v && [x.next_down(), x, x.next_up()].contains(&from.x)
    }

    /// A number for each stage of the scheme, and its position.
    fn stages(&self, number: impl Fn(usize, f64) -> f64) -> Stages {
        let node = |stage: usize| self.scheme.nodes.get(stage);
        Stages::from_fn(|stage, _| node(stage).map_or(0.0, |node| number(stage, *node)))
    }

    /// Initial guess of the stage velocities over a step of length `h`.
    fn guess(&self, h: f64) -> Stages {
        let rate = self.field.divergence(self.start.v).min(0.0);
        self.stages(|_, node| {
            if self.duration > 0.0 && h <= FORESEEN * self.duration {
                let after = 1.0 + node * h / self.duration;
                self.scheme.interpolated(&self.dense[1], after)
            } else {
                // One linearly implicit Euler step.
                let t = node * h;
                self.start.v + t * self.slope / (1.0 - t * rate + t * t)
            }
        })
    }

    /// Solves for the stages of a step of length `h`; `None` where Newton's method does not converge.
    fn attempt(&mut self, h: f64, mut velocity: Stages) -> Option<StepPoint> {
        let Collocation { integrals, square, .. } = self.scheme;
        let StepPoint { x: start, v: first } = self.start;
        let mut before = f64::NAN;
        for _ in 0..ITERATIONS {
            let way = integrals * velocity;
            let slope = |j, _| self.field.acceleration(start + h * way[j], velocity[j]);
            let mut acceleration = self.stages(slope);
            let rate = self.stages(|j, _| self.field.divergence(velocity[j]));
            let gain = integrals * acceleration;
            let missing = self.stages(|j, _| first - velocity[j] + h * gain[j]);
            self.cost.evaluations += self.scheme.nodes.len() as u64;
            // Beyond the stages of the scheme nothing changes.
            let matrix = StageMatrix::from_fn(|i, k| {
                let one = if i == k { 1.0 } else { 0.0 };
                one + h * (h * square[(i, k)] - integrals[(i, k)] * rate[k])
            });
            let change = matrix.lu().solve(&missing)?;
            velocity += change;
            let (moved, size) = (change.amax(), velocity.amax().max(first.abs()));
            if !(moved.is_finite() && size.is_finite()) {
                return None;
            }
            let shrunk = moved / before;
            // Convergence is quadratic: the next change would be about this one times `shrunk^2`.
            let settled = moved * shrunk * shrunk <= LEFT * self.asked * size;
            if settled || moved <= (f64::EPSILON * size).max(self.rounding(h)) {
                // The effect of the last change on the accelerations needs no evaluation.
                acceleration += rate.component_mul(&change) - integrals * change * h;
                (self.velocity, self.acceleration) = (velocity, acceleration);
                let last = self.scheme.nodes.len() - 1;
                let x = start + h * (integrals * velocity)[last];
                return Some(StepPoint { x, v: velocity[last] });
            }
            if shrunk > 2.0 {
                return None;
            }
            before = moved;
        }
        None
    }

    /// Error of the stage velocities over a step of length `h` from rounding of the acceleration.
    ///
    /// On a slow manifold large terms balance. Their rounding error, divided by the damping, limits the
    /// accuracy of a velocity there, however short the step.
    fn rounding(&self, h: f64) -> f64 {
        let StepPoint { x, v } = self.start;
        let part = self.scheme.start * h;
        let damped = 1.0 + part * self.field.divergence(v).abs() + part * part;
        f64::EPSILON * self.field.magnitude(x, v) * part / damped
    }

    /// The error allowed in the embedded solution for an attempt over a step of length `h` to `end`.
    fn scale(&self, h: f64, end: StepPoint) -> StepPoint {
        let rate = |v: f64| self.field.divergence(v).abs();
        let damping_times = h * rate(self.start.v).max(rate(end.v));
        let reduced = self.asked / self.scheme.reduced_order(damping_times);
        let tolerance = self.tolerance.min(reduced.max(ROUNDING));
        let scale = allowed_error(tolerance, self.start, end);
        StepPoint { v: scale.v.max(NOISE * self.rounding(h)), ..scale }
    }

    /// Error of the last attempt in units of the allowed error; accepted up to 1.
    fn error(&mut self, h: f64, scale: StepPoint, first: bool) -> f64 {
        let Collocation { error: weights, start: own, .. } = self.scheme;
        let part = h * own;
        let rate = self.field.divergence(self.start.v);
        let sums = StepPoint {
            x: h * weights.dot(&self.velocity),
            v: h * weights.dot(&self.acceleration),
        };
        // The difference from the embedded solution times `(1 - part J)^-1`, which keeps it bounded where
        // damping is stiff.
        let filtered = |x: f64, v: f64| {
            let determinant = 1.0 - part * rate + part * part;
            StepPoint {
                x: ((1.0 - part * rate) * x + part * v) / determinant,
                v: (v - part * x) / determinant,
            }
        };
        let norm = |error: StepPoint| (error.x / scale.x).abs().max((error.v / scale.v).abs());
        let error = filtered(part * self.start.v + sums.x, part * self.slope + sums.v);
        if norm(error) < 1.0 || !first {
            return norm(error);
        }
        // On a first or repeated step, the error of a start off the slow manifold is filtered once more.
        let v = self.start.v + error.v;
        let slope = self.field.acceleration(self.start.x + error.x, v);
        self.cost.evaluations += 1;
        norm(filtered(part * v + sums.x, part * slope + sums.v))
    }

    /// Repeats the step, at most `longest` long, until its error is within the tolerance.
    ///
    /// With `above`, a step that ends above `v = 0` is also repeated if its position does not grow.
    fn accepted(&mut self, longest: f64, above: bool) -> Result<(f64, StepPoint)> {
        let stages = self.scheme.nodes.len();
        let power = -1.0 / (real(stages) + 1.0);
        let mut grow = 8.0;
        let mut first = self.duration == 0.0;
        let mut length = self.next.min(longest);
        loop {
            if length < f64::MIN_POSITIVE {
                return Err(Reason::StepTooSmall { step: length });
            }
            let guess = self.guess(length);
            let attempt = self.attempt(length, guess);
            let shrink = match attempt {
                None => 0.25,
                Some(end) => {
                    let error = self.error(length, self.scale(length, end), first);
                    let factor = if error == 0.0 {
                        grow
                    } else {
                        0.9 * rough_exp2(power * rough_log2(error))
                    };
                    let turned = above && end.v > 0.0 && end.x < self.start.x;
                    if error <= 1.0 && !turned {
                        let next = length * factor.clamp(0.2, grow);
                        // A step cut short by the end time says nothing about the length of the next one.
                        self.next = if length < self.next {
                            self.next.max(next)
                        } else {
                            next
                        };
                        return Ok((length, end));
                    }
                    if error.is_finite() {
                        factor.clamp(0.1, 0.9)
                    } else {
                        0.1
                    }
                }
            };
            self.cost.rejected += 1;
            (grow, first) = (1.0, true);
            length *= shrink;
            self.next = length;
        }
    }

    /// Keeps an attempt as the last step.
    fn keep(&mut self, duration: f64, end: StepPoint) {
        (self.duration, self.end) = (duration, end);
        let way = self.scheme.integrals * self.velocity;
        let position = way.map(|way| self.start.x + duration * way);
        let through = |first, values| self.scheme.differences(first, values);
        self.dense = [through(self.start.x, &position), through(self.start.v, &self.velocity)];
    }

    /// The longest step that cannot pass two crossings; unlimited where damping is above critical.
    ///
    /// Where neighbouring motions diverge, the step length is bounded by their rate: a long step would damp
    /// what grows and stay on a manifold that every motion leaves.
    fn longest(&self) -> f64 {
        const CRITICAL: f64 = 2.0;
        let rate = self.field.divergence(self.start.v);
        if rate < -CRITICAL {
            f64::INFINITY
        } else if rate > 0.0 {
            LONGEST.min(1.0 / rate)
        } else {
            // The rate may be -0, whose reciprocal is no bound.
            LONGEST
        }
    }
}

impl<F: PlaneField> Stepper<F> for StiffStepper<F> {
    fn begin(&mut self, field: &F) {
        self.field = *field;
        // What is known about the last step belonged to another field.
        self.end = StepPoint { x: f64::NAN, v: f64::NAN };
    }

    fn advance(&mut self, from: StepPoint, longest: f64, arrives: bool) -> Result<Step> {
        let continues = self.is_continued(from);
        self.start_at(from);
        let mut longest = longest.min(self.longest());
        if arrives && !continues {
            longest = longest.min(stopping_time(from.v, self.slope));
        }
        loop {
            let (duration, end) = self.accepted(longest, arrives)?;
            let last = self.end;
            self.keep(duration, end);
            let mut velocities = self.velocity.iter().take(self.scheme.nodes.len());
            if !(arrives && velocities.any(|&v| v <= 0.0)) {
                return Ok(Step { duration, end, crossed: false });
            }
            let arrival = self.arrive().filter(Step::is_possible);
            if let Some(arrival) = arrival
                && self.is_sharp(&arrival)
            {
                return Ok(arrival);
            }
            self.cost.rejected += 1;
            (self.end, self.duration) = (last, 0.0);
            longest = arrival.map_or(0.5 * duration, |arrival| SHORT_OF * arrival.duration);
        }
    }

    fn at(&self, time: f64) -> StepPoint {
        let part = time / self.duration;
        let value = |dense| self.scheme.interpolated(dense, part);
        StepPoint { x: value(&self.dense[0]), v: value(&self.dense[1]) }
    }

    /// The quadrature of the collocation scheme, exact for polynomials of degree below its order.
    fn powers(&self) -> Powers {
        let weights = self.scheme.integrals.row(self.scheme.nodes.len() - 1).transpose();
        powers_of_stages(self.duration, weights.as_slice(), self.velocity.as_slice())
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}

#[cfg(test)]
mod tests;
