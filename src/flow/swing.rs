//! One half swing: steps of the smooth field until `v = 0`, the end time, or certain escape.
//!
//! The state is kept near 1 in units of a power of two. Motions of any size are thus computed alike, and a
//! motion scaled by a power of two is the same to the last bit.

use super::{Limits, Step, StepPoint, Stepper};
use crate::model::{HalfPlane, PlaneField, Reason, Result};
use crate::numerics::{Scalar, Sum, exponent, ln_1p};

/// Size, as a power of two, at which the unit is chosen anew.
const FAR: i32 = 300;

/// Relative error allowed in the time of a blow-up when it is taken from its asymptotic form, as a part of what is
/// negligible.
const BLOW_UP_ERROR: f64 = 1e-2;

/// A half swing and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing<N = f64> {
    /// Where it ended: at `v = 0`, at the end time, or where the watcher stopped it; [`Reason::Escapes`] if the
    /// velocity becomes infinite before the end time.
    pub end: Result<StepPoint<N>>,
    /// Whether it ended at `v = 0`.
    pub crossed: bool,
    /// Duration (until the blow-up where it escaped), or the time reached.
    pub duration: N,
    /// Accepted steps.
    pub steps: u64,
}

/// Runs one half swing from `start` (`v > 0`, or `v = 0` and `x < 0`), given in units of `2^unit`, for at most
/// `longest`; unless it `arrives`, through as many half swings as occur, without looking for `v = 0`.
///
/// `watch` is called after each accepted step with the stepper that holds it, the time at which it began, the
/// exponent of its unit, and the step; it says whether the swing goes on from there.
///
/// Assumption: where it does not arrive, the field holds on both sides: there is no friction, or it is part of the
/// field.
pub fn swing<N: Scalar, F: PlaneField, S: Stepper<F, N>>(
    stepper: &mut S,
    field: &F,
    (start, unit): (StepPoint<N>, i32),
    (longest, arrives): (N, bool),
    limits: &Limits,
    mut watch: impl FnMut(&mut S, f64, i32, &Step<N>) -> bool,
) -> Swing<N> {
    let size = exponent(start.size());
    let mut point = start.times_power(-size);
    let mut unit = unit + size;
    let mut scaled = field.in_units(unit);
    let mut clock = Sum::<N>::default();
    let (mut duration, mut crossed, mut steps) = (N::default(), false, 0);
    stepper.begin(&scaled);
    let mut follow = || loop {
        limits.go_on()?;
        let evaluations = stepper.cost().evaluations;
        if evaluations > limits.evaluations {
            return Err(Reason::Budget { evaluations });
        }
        let smooth = scaled.frictionless();
        if !(smooth.d2.is_finite() && smooth.d3.is_finite()) {
            return Err(Reason::OutOfRange);
        }
        let remaining = longest - duration;
        let step = stepper.advance(point, remaining, arrives)?;
        steps += 1;
        let goes_on = watch(stepper, duration.value(), unit, &step);
        let step = progress(step, point, remaining);
        clock.add(step.duration);
        (point, crossed) = (step.end, step.crossed);
        let in_time = crossed || step.duration < remaining;
        duration = if in_time { clock.value() } else { longest };
        if crossed || !(in_time && goes_on) {
            return Ok(point.times_power(unit));
        }
        let error = BLOW_UP_ERROR * N::NEGLIGIBLE * duration.value();
        // The time is that of the two driving terms alone; its error is the effect of the others.
        if let Some((rest, others)) = blow_up(&smooth, point.rounded())
            && rest * others <= error
            && duration + N::from(rest) <= longest
        {
            duration = duration + N::from(rest);
            return Err(Reason::Escapes);
        }
        let drift = exponent(point.size());
        if drift.abs() > FAR {
            unit += drift;
            scaled = field.in_units(unit);
            point = point.times_power(-drift);
            stepper.begin(&scaled);
        }
    };
    let end = follow();
    Swing { end, crossed, duration, steps }
}

/// The step itself or, if it changed nothing, as many like it as it takes to move x to the next number.
///
/// Far out, where large terms balance, rounding creates spurious points of rest: x moves by less than its own
/// rounding error, and every further step would be the same again.
fn progress<N: Scalar>(step: Step<N>, from: StepPoint<N>, longest: N) -> Step<N> {
    if step.crossed || step.end != from || from.v == N::default() {
        return step;
    }
    let StepPoint { x, v } = from.rounded();
    let next = if v > 0.0 { x.next_up() } else { x.next_down() };
    let duration = N::from((next - x) / v);
    if duration < longest {
        Step { duration, end: StepPoint { x: N::from(next), ..from }, crossed: false }
    } else {
        Step { duration: longest, ..step }
    }
}

/// Where escape is certain: the time until then from the terms that drive v alone, and the size of all other
/// terms relative to theirs.
///
/// For `v < 0` (reached only without friction) the mirror image is taken. With `a = -D2` and `b = -D3` the
/// terms `a v^2 + b v^3` drive v. Escape is certain once they exceed eight times all others together and x can
/// no longer catch up; if `a` brakes, it must do so with at most half of what `b` gives. From then on v grows,
/// and these ratios with it.
pub(crate) fn blow_up(field: &HalfPlane, point: StepPoint) -> Option<(f64, f64)> {
    let v = point.v.abs();
    let (a, b) = (if point.v < 0.0 { field.d2 } else { -field.d2 }, -field.d3);
    let drives = if a < 0.0 {
        b * v >= -2.0 * a
    } else {
        b >= 0.0 && (a > 0.0 || b > 0.0)
    };
    if !drives {
        return None;
    }
    let drive = v * v * (a + b * v);
    let others = point.x.abs() + 2.0 * field.d.abs() * v;
    if drive <= 8.0 * others {
        return None;
    }
    let rest = time_to_infinity(a, b, v);
    (drive > 8.0 * (others + rest * v)).then_some((rest, others / drive))
}

/// The integral of `1/(a v^2 + b v^3)` from v to infinity.
///
/// It is `(1 - s ln(1 + 1/s))/(a v)` with `s = b v/a`; where `a` contributes little, a series in `1/s`.
fn time_to_infinity(a: f64, b: f64, v: f64) -> f64 {
    /// Magnitude of s beyond which nine terms of the series are exact to rounding.
    const LARGE: f64 = 100.0;
    let s = b * v / a;
    if s.abs() <= LARGE {
        // For smaller s, 1/s would overflow; s ln(1/s) is negligible beside 1 long before.
        let bend = if s.abs() < f64::MIN_POSITIVE {
            0.0
        } else {
            s * ln_1p(1.0 / s)
        };
        return (1.0 - bend) / (a * v);
    }
    // 1/(b v^2) times the sum of (-1/s)^k/(k + 2).
    let part = -a / (b * v);
    let series = (2..=10).rev().fold(0.0, |sum, k| sum * part + 1.0 / f64::from(k));
    series / (b * v * v)
}
