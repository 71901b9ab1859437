//! What rounding does to a half swing, carried along with it.
//!
//! Two motions of one field that are `delta` apart span with the field f the area `w = delta x f`, which
//! grows by the divergence alone (Liouville): `w' = div w`. So the effect of an error made anywhere is
//! known at the end from what the swing computes anyway: of a relative error e of the start from
//! `w = e c^2`, of the rounding of each step from the size of its terms. At a turning point X, w is `X^2`
//! times the relative error of X; at the largest velocity it is v times that of v; on the way
//! it costs time at the rate `w/(v^2 + a^2)`.
//!
//! Assumption: errors are small beside what they are errors of, and a step rounds by [`UNIT`] at most.

use crate::flow::{Step, StepPoint};
use crate::model::{Field, HalfPlane, PlaneField};
use crate::numerics::{exp, exponent, ln, times_power};

/// Rounding of one step relative to its terms: some operations each, of which the largest term decides.
pub const UNIT: f64 = 6.0 * f64::EPSILON;

/// Bounds on the errors of what a swing gives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Relative error of a length: of the end, in a pair of swings of the clearance at the start.
    pub length: f64,
    /// Error of the duration.
    pub duration: f64,
    /// Error of the integral of `v^2`.
    pub square: f64,
    /// Error of the largest v.
    pub fastest: f64,
}

impl Errors {
    /// These errors and `factor` times others.
    pub fn plus(self, other: Errors, factor: f64) -> Errors {
        // Nothing times an infinite sensitivity is nothing.
        let times = |value: f64| {
            if factor == 0.0 || value == 0.0 {
                0.0
            } else {
                factor * value
            }
        };
        Errors {
            length: self.length + times(other.length),
            duration: self.duration + times(other.duration),
            square: self.square + times(other.square),
            fastest: self.fastest + times(other.fastest),
        }
    }
}

/// The errors of a half swing so far.
pub(super) struct Roundoff {
    field: HalfPlane,
    tolerance: f64,
    unit: i32,
    from: StepPoint,
    /// Areas in units of `2^(2 unit)`: of all roundings, and of a relative error 1 of the start.
    area: [f64; 2],
    errors: [Errors; 2],
}

impl Roundoff {
    /// Before the first step from a point that a closed form reached after `skipped`.
    ///
    /// `log_start` is the logarithm of the clearance c at which the swing started.
    pub(super) fn new(
        field: HalfPlane,
        tolerance: f64,
        (log_start, from, skipped): (f64, StepPoint, f64),
    ) -> Self {
        let rounding = UNIT.max(tolerance);
        let unit = exponent(from.size());
        let from = from.times_power(-unit);
        // The linear field spans `c^2 exp(-2 D t)`.
        let log_size = f64::from(unit) * std::f64::consts::LN_2;
        let area = exp(2.0 * (log_start - field.d * skipped - log_size));
        let duration = Errors { duration: skipped, ..Errors::default() };
        let errors = [Errors::default().plus(duration, rounding), duration];
        let area = [rounding * area, area];
        Roundoff { field, tolerance: rounding, unit, from, area, errors }
    }

    /// The errors of a swing in closed form.
    pub(super) fn closed(log_end: f64, duration: f64, fastest: f64) -> [Errors; 2] {
        let rounding = UNIT * log_end.abs().max(1.0);
        let gain = Errors { length: 1.0, fastest, ..Errors::default() };
        let duration = Errors { duration, ..Errors::default() };
        [Errors::default().plus(gain, rounding).plus(duration, UNIT), gain]
    }

    /// Carries the errors over a step measured in units of `2^unit`; `square` and `fastest` are its integral
    /// of `v^2` and its largest v, in the same units.
    pub(super) fn step(&mut self, unit: i32, step: &Step, square: f64, fastest: Option<f64>) {
        let shift = self.unit - unit;
        if shift != 0 {
            self.from = self.from.times_power(shift);
            self.area = self.area.map(|area| times_power(times_power(area, shift), shift));
            self.unit = unit;
        }
        let field = self.field.in_units(unit);
        let (from, to, time) = (self.from, step.end, step.duration);
        let growth =
            exp(-2.0 * field.d * time - 2.0 * field.d2 * (to.x - from.x) - 3.0 * field.d3 * square);
        let [one, other] = [from, to].map(|at| field.acceleration(at.x, at.v).abs());
        let speed = from.v.max(to.v).max(fastest.unwrap_or(0.0));
        let place = from.x.abs().max(to.x.abs());
        let stiffness = field.divergence(speed).abs();
        let forces = field.magnitude(place, speed) * time.min(1.0 / stiffness);
        let local = self.tolerance * (place * one.max(other) + speed * (speed + forces));
        let slowest = (from.v * from.v + one * one).min(to.v * to.v + other * other);
        let absolute = |value: f64| times_power(value, unit);
        for (index, area) in self.area.iter_mut().enumerate() {
            let local = if index == 0 { local } else { 0.0 };
            let before = *area + local;
            *area = before * growth + local;
            let most = before.max(*area);
            let errors = &mut self.errors[index];
            errors.duration += 2.0 * time * most / slowest;
            errors.square += absolute(absolute(time * most));
            if let Some(fastest) = fastest {
                errors.fastest = errors.fastest.max(absolute(most / fastest));
            }
        }
        let errors = &mut self.errors[0];
        errors.duration += self.tolerance * time + local / slowest;
        errors.square += self.tolerance * absolute(absolute(square));
        if let Some(fastest) = fastest {
            errors.fastest += self.tolerance * absolute(fastest);
        }
        self.from = to;
    }

    /// The errors at the end, which a closed form reaches after another `rest`: of rounding, and of a
    /// relative error 1 of the start.
    pub(super) fn done(mut self, log_end: f64, rest: f64) -> [Errors; 2] {
        let log_size = f64::from(self.unit) * std::f64::consts::LN_2;
        let log_growth = 2.0 * (log_size - self.field.d * rest - log_end);
        for (errors, area) in self.errors.iter_mut().zip(self.area) {
            errors.length = exp(ln(area) + log_growth);
        }
        self.errors[0].length += self.tolerance;
        self.errors
    }
}
