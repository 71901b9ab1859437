//! The half-swing map: from the clearance at which a swing starts to the position at which it ends.
//!
//! In the frame of a half plane a swing leads from `(-c, 0)` to `(X, 0)`. The map `c -> X` contains no
//! friction; dry friction only turns the end of one swing into the start of the next, `c' = X - 2 r`.
//! It is smooth, increasing and invertible, and its inverse is the same map of another field: with
//! time reversed, `y = -x` obeys the equation of `-D, -D2, -D3`. So inverse half maps need no code of
//! their own, and they contract where the forward map explodes.
//!
//! Lengths are carried with their logarithm. Near the end point of the sticking set the motion is a
//! linear spiral that scales with `c` exactly, so a swing may start or end at lengths that underflow.

use super::Errors;
use super::roundoff::Roundoff;
use crate::closed_form::LinearFlow;
use crate::flow::{
    AutoStepper, Cost, Limits, Reason, Result, Step, StepPoint, Stepper, blow_up, swing,
};
use crate::model::{HalfPlane, PlaneField};
use crate::numerics::{atan2, exp, hypot, ln, ln_1p, sin_cos, times_power};

/// Below this fraction of its natural scale, in units of the tolerance of a step, the damping is linear to far
/// below that tolerance.
const LINEAR_BELOW: f64 = 1e-5;

/// The least tolerance that counts there: rounding.
const ROUNDING: f64 = 1e-16;

/// A half swing longer than this is taken to never arrive; slow ones of 1e100 do (D3 = 1 from 1e150).
const LONGEST: f64 = 1e300;

/// A positive length with its logarithm, which exists even where the length underflows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// The length; 0 where it underflows.
    pub value: f64,
    /// Its natural logarithm.
    pub log: f64,
}

impl Length {
    /// No length at all.
    pub const ZERO: Length = Length { value: 0.0, log: f64::NEG_INFINITY };
    /// Beyond all lengths.
    pub const INFINITE: Length = Length { value: f64::INFINITY, log: f64::INFINITY };

    /// From a length.
    pub fn new(value: f64) -> Self {
        Length { value, log: ln(value) }
    }

    /// From the logarithm of a length.
    pub fn from_log(log: f64) -> Self {
        Length { value: exp(log), log }
    }

    /// This length, another one where it is beyond all.
    pub fn or(self, other: Self) -> Self {
        if self == Length::INFINITE { other } else { self }
    }

    /// Difference of the logarithms, which is the relative difference where that is small.
    pub fn apart(self, other: Self) -> f64 {
        if self.log == other.log {
            0.0
        } else {
            (self.log - other.log).abs()
        }
    }

    /// This length and another one put together.
    pub fn plus(self, more: f64) -> Self {
        if more == 0.0 {
            self
        } else {
            Length::new(self.value + more)
        }
    }
}

/// The size of motions at which the damping by D2 or by D3 is as large as the spring's force.
pub fn natural_size(d2: f64, d3: f64) -> f64 {
    (1.0 / d2.abs()).min(1.0 / d3.abs().sqrt())
}

/// The direction in which a swing is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From where it starts.
    Forward,
    /// From where it ends, backward in time.
    Backward,
}

impl Direction {
    /// The direction of time.
    pub fn sense(self) -> f64 {
        if self == Direction::Forward { 1.0 } else { -1.0 }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct HalfSwing {
    /// Clearance at which it starts: at `(-start, 0)`.
    pub start: Length,
    /// Position at which it ends: at `(end, 0)`. Infinite where the velocity runs to infinity; zero where the motion
    /// creeps towards the centre of its spiral and never arrives at `v = 0`.
    pub end: Length,
    /// How long it takes.
    pub duration: f64,
    /// Integral of `v^2` (0 for a linear field, where nothing needs it).
    pub square: f64,
    /// Largest v, if asked for.
    pub fastest: f64,
    /// Logarithm of the elasticity of the map, `d ln(end) / d ln(start)`.
    ///
    /// From the divergence with the turning points built in (Liouville): `dX/dc = (c/X) exp(integral of
    /// the divergence)`; the D2 part of the integral is exact because the integral of v is `X + c`.
    pub log_elasticity: f64,
    /// What rounding does to these numbers, and a relative error 1 of the start; zero unless asked for.
    pub errors: [Errors; 2],
}

impl HalfSwing {
    /// A swing of which only its ends are known: all there is of one that never arrives, whose end is zero or infinite.
    pub(crate) fn between(start: Length, end: Length) -> Self {
        HalfSwing {
            start,
            end,
            duration: f64::INFINITY,
            square: 0.0,
            fastest: 0.0,
            log_elasticity: if end == Length::ZERO {
                f64::NEG_INFINITY
            } else {
                f64::NAN
            },
            errors: [Errors::default(); 2],
        }
    }

    /// Whether it arrives at `v = 0`.
    pub fn arrives(&self) -> bool {
        self.end.log.is_finite()
    }
}

/// The half-swing map of one field.
pub struct HalfMap {
    /// Its field.
    pub field: HalfPlane,
    stepper: AutoStepper,
    /// Relative error of a step.
    pub tolerance: f64,
    /// States smaller than this move linearly: all others are integrated step by step.
    pub linear_below: f64,
    /// Whether to find the largest velocity of each swing, and the errors of its numbers.
    pub fastest: bool,
    steps: u64,
    /// Swings computed so far.
    pub swings: u64,
}

impl HalfMap {
    /// The map of this field, each step within the relative `tolerance`.
    pub fn new(field: HalfPlane, tolerance: f64) -> Self {
        let stepper = AutoStepper::new(tolerance);
        let natural = natural_size(field.d2, field.d3);
        let linear_below = LINEAR_BELOW * tolerance.max(ROUNDING) * natural;
        // A node that repels has no part worth skipping.
        let linear_below = if field.d > -1.0 { linear_below } else { 0.0 };
        HalfMap { field, stepper, tolerance, linear_below, fastest: false, steps: 0, swings: 0 }
    }

    /// What the swings so far cost.
    pub fn cost(&self) -> Cost {
        Cost { steps: self.steps, ..self.stepper.cost() }
    }

    /// Swings from `(-start, 0)`. Fails with the [`Reason`] why the motion could not be followed.
    pub fn swing(&mut self, start: Length, limits: &Limits) -> Result<HalfSwing> {
        self.swing_watched(start, false, limits, |_, _, _| {})
    }

    /// The same, handing each step to `watch` as (stepper, unit exponent, duration); a motion that is certain to escape
    /// is followed further only if its `tail` is wanted.
    pub fn swing_watched(
        &mut self,
        start: Length,
        tail: bool,
        limits: &Limits,
        mut watch: impl FnMut(&mut AutoStepper, i32, f64),
    ) -> Result<HalfSwing> {
        self.swings += 1;
        // A swing in closed form takes no steps, but thousands of them take time.
        limits.go_on()?;
        let spent = self.stepper.cost().evaluations + self.swings;
        if spent > limits.evaluations {
            return Err(Reason::Budget { evaluations: spent });
        }
        let spiral = Spiral::of(self.field.d);
        let (from, skipped) = match spiral.grow(start, self.linear_below) {
            Ok((end, duration)) => {
                let fastest = spiral.fastest(start);
                let errors = Roundoff::closed(end.log, duration, fastest);
                let swing = HalfSwing::between(start, end);
                return Ok(self.finish(HalfSwing { duration, fastest, errors, ..swing }));
            }
            Err(reached) => reached,
        };
        let (mut square, mut fastest) = (0.0, 0.0_f64);
        let begun = (start.log, from, skipped);
        let mut roundoff = self.fastest.then(|| Roundoff::new(self.field, self.tolerance, begun));
        let nonlinear = !self.field.is_linear();
        let (field, mut escapes) = (self.field, false);
        // Once small, a decaying motion stays small and is linear to its end.
        let small = if self.field.d >= 0.0 { self.linear_below } else { 0.0 };
        let mut see = |stepper: &mut AutoStepper, _: f64, unit: i32, step: &Step| {
            let mut squared = 0.0;
            if nonlinear {
                squared = stepper.square_integral();
                square += times_power(times_power(squared, unit), unit);
            }
            if let Some(roundoff) = &mut roundoff {
                let largest = stepper.fastest(step.duration);
                if let Some(v) = largest {
                    fastest = fastest.max(times_power(v, unit));
                }
                roundoff.step(unit, step, squared, largest);
            }
            watch(stepper, unit, step.duration);
            if step.crossed {
                return true;
            }
            escapes = !tail && blow_up(&field.in_units(unit), step.end).is_some();
            let ends = escapes || times_power(step.end.size(), unit) < small;
            !ends
        };
        let stepper = &mut self.stepper;
        let done = swing(stepper, &self.field, (from, 0), (LONGEST, true), limits, &mut see);
        self.steps += done.steps;
        let duration = skipped + done.duration;
        let lost = |end| Ok(HalfSwing::between(start, end));
        let point = match done.end {
            Err(Reason::Escapes) => return lost(Length::INFINITE),
            end => end?,
        };
        let (end, rest) = if done.crossed {
            (Length::new(point.x), 0.0)
        } else if escapes {
            return lost(Length::INFINITE);
        } else if point.size() >= small {
            return lost(Length::ZERO);
        } else if self.field.d < 1.0 {
            spiral.arrive(point)
        } else {
            match LinearFlow::new(self.field.d).first_standstill(point.x, point.v) {
                Some(end) => (Length::new(end.x), end.time),
                None => return lost(Length::ZERO),
            }
        };
        let errors = roundoff.map(|it| it.done(end.log, rest)).unwrap_or_default();
        let (swing, duration) = (HalfSwing::between(start, end), duration + rest);
        Ok(self.finish(HalfSwing { duration, square, fastest, errors, ..swing }))
    }

    /// A swing that arrives, with its elasticity.
    fn finish(&self, swing: HalfSwing) -> HalfSwing {
        let HalfPlane { d, d2, d3 } = self.field;
        let HalfSwing { start, end, duration, square, .. } = swing;
        let path = start.value + end.value;
        let divergence = -2.0 * d * duration - 2.0 * d2 * path - 3.0 * d3 * square;
        HalfSwing { log_elasticity: 2.0 * (start.log - end.log) + divergence, ..swing }
    }
}

/// The linear spiral about the centre of a half plane.
struct Spiral {
    d: f64,
    /// Not a number where nothing swings: at `abs(D) > 1`.
    omega: f64,
}

impl Spiral {
    fn of(d: f64) -> Self {
        Spiral { d, omega: ((1.0 - d) * (1.0 + d)).sqrt() }
    }

    /// Largest v of the spiral from `(-start, 0)` (equation 33, corrected).
    fn fastest(&self, start: Length) -> f64 {
        exp(start.log - self.d * atan2(self.omega, self.d) / self.omega)
    }

    /// Follows the spiral from `(-start, 0)`: position and duration at its end, or, where it does not stay smaller than
    /// `bound`, the state at which it no longer is, and when.
    fn grow(&self, start: Length, bound: f64) -> Result<(Length, f64), (StepPoint, f64)> {
        let half_turn = std::f64::consts::PI / self.omega;
        // The spiral scales as e^(-D t); beside this factor it is at most 1 + t in size.
        let room = ln(bound) - start.log - ln_1p(half_turn);
        // Overdamped motions, of which omega is no number, do not swing.
        if room.is_nan() || room <= 0.0 {
            return Err((StepPoint { x: -start.value, v: 0.0 }, 0.0));
        }
        if -self.d * half_turn <= room {
            return Ok((Length::from_log(start.log - self.d * half_turn), half_turn));
        }
        let time = room / -self.d;
        let (sine, cosine) = sin_cos(self.omega * time);
        let size = exp(start.log + room);
        let velocity = sine / self.omega;
        Err((StepPoint { x: -size * (cosine + self.d * velocity), v: size * velocity }, time))
    }

    /// Follows the spiral from a point with `v > 0` to `v = 0`: position there, and duration.
    ///
    /// `x^2 + 2 D x v + v^2` decays as `e^(-2 D t)` exactly and equals `x^2` at the end.
    fn arrive(&self, point: StepPoint) -> (Length, f64) {
        let along = point.x + self.d * point.v;
        let across = self.omega * point.v;
        let time = atan2(across, along) / self.omega;
        (Length::from_log(ln(hypot(along, across)) - self.d * time), time)
    }
}
