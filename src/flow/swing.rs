//! One half swing: steps of the smooth field until `v = 0`, the end time, or certain escape.
//!
//! The state is kept near 1 in units of a power of two. Motions of any size are thus computed alike, and a
//! motion scaled by a power of two is the same to the last bit.

use std::ops::ControlFlow;

use super::limits::{Limits, Reason};
use super::step::{Step, StepPoint, Stepper};
use crate::model::HalfPlane;
use crate::numerics::elementary::ln_1p;
use crate::numerics::scaling::{exponent, times_power};
use crate::numerics::sum::Sum;

/// Size, as a power of two, at which the unit is chosen anew.
const FAR: i32 = 300;

/// Relative error allowed in the time of a blow-up when it is taken from its asymptotic form.
const BLOW_UP_ERROR: f64 = 1e-14;

/// How a half swing ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SwingEnd {
    /// At `v = 0`, at this position.
    Crossing {
        /// Position in the frame of the half plane.
        x: f64,
    },
    /// At the end time, or where the watcher stopped it.
    Stopped {
        /// The point reached.
        point: StepPoint,
    },
    /// The velocity becomes infinite before the end time.
    Escape,
}

/// A half swing and how long it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// How it ended.
    pub end: SwingEnd,
    /// Duration (until the blow-up where it escaped).
    pub duration: f64,
    /// Accepted steps.
    pub steps: u64,
}

/// A half swing that could not be completed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failed {
    /// Why it failed.
    pub reason: Reason,
    /// The time reached.
    pub duration: f64,
    /// Accepted steps.
    pub steps: u64,
}

/// Runs one half swing from `start` (`v > 0`, or `v = 0` and `x < 0`), given in units of `2^unit`, for at most
/// `longest`.
///
/// `watch` is called after each accepted step with the stepper that holds it, the time at which it began, the
/// exponent of its unit, and the step; it may stop the swing there. Errors are [`Failed`], with the reason and
/// the time reached.
pub fn swing<S: Stepper>(
    stepper: &mut S,
    field: &HalfPlane,
    (start, unit): (StepPoint, i32),
    longest: f64,
    limits: &Limits,
    watch: impl FnMut(&mut S, f64, i32, &Step) -> ControlFlow<()>,
) -> Result<Swing, Failed> {
    drive(stepper, S::advance, field, (start, unit), longest, limits, watch)
}

/// Follows a motion for `longest` without looking for `v = 0`, through as many half swings as occur.
///
/// Assumption: there is no friction. Then the field of the upper side holds on both sides.
pub fn glide<S: Stepper>(
    stepper: &mut S,
    field: &HalfPlane,
    start: StepPoint,
    longest: f64,
    limits: &Limits,
    watch: impl FnMut(&mut S, f64, i32, &Step) -> ControlFlow<()>,
) -> Result<Swing, Failed> {
    drive(stepper, S::pass, field, (start, 0), longest, limits, watch)
}

/// Takes steps with `advance` until a crossing, the end of the time span, or certain escape.
fn drive<S: Stepper>(
    stepper: &mut S,
    advance: impl Fn(&mut S, StepPoint, f64) -> Result<Step, Reason>,
    field: &HalfPlane,
    (start, unit): (StepPoint, i32),
    longest: f64,
    limits: &Limits,
    mut watch: impl FnMut(&mut S, f64, i32, &Step) -> ControlFlow<()>,
) -> Result<Swing, Failed> {
    let size = exponent(start.size());
    let mut point = StepPoint { x: times_power(start.x, -size), v: times_power(start.v, -size) };
    let mut unit = unit + size;
    let mut scaled = field.in_units(unit);
    let mut clock = Sum::default();
    let mut steps = 0;
    stepper.begin(&scaled);
    loop {
        let time = clock.value();
        let failed = |reason| Failed { reason, duration: time, steps };
        if (limits.interrupted)() {
            return Err(failed(Reason::Interrupted));
        }
        if stepper.evaluations() > limits.evaluations {
            return Err(failed(Reason::Budget { evaluations: stepper.evaluations() }));
        }
        if !(scaled.d2.is_finite() && scaled.d3.is_finite()) {
            return Err(failed(Reason::OutOfRange));
        }
        let remaining = longest - time;
        let step = advance(stepper, point, remaining).map_err(failed)?;
        steps += 1;
        let goes_on = watch(stepper, time, unit, &step).is_continue();
        let step = progress(step, point, remaining);
        clock.add(step.duration);
        let time = clock.value();
        point = step.end;
        let done = |end| Ok(Swing { end, duration: time, steps });
        if step.crossed {
            return done(SwingEnd::Crossing { x: times_power(point.x, unit) });
        }
        let in_time = step.duration < remaining;
        if !(in_time && goes_on) {
            let (x, v) = (times_power(point.x, unit), times_power(point.v, unit));
            let duration = if in_time { time } else { longest };
            return Ok(Swing {
                end: SwingEnd::Stopped { point: StepPoint { x, v } },
                duration,
                steps,
            });
        }
        if let Some(rest) = time_to_blow_up(&scaled, point, time)
            && time + rest <= longest
        {
            return Ok(Swing { end: SwingEnd::Escape, duration: time + rest, steps });
        }
        let drift = exponent(point.size());
        if drift.abs() > FAR {
            unit += drift;
            scaled = field.in_units(unit);
            point = StepPoint { x: times_power(point.x, -drift), v: times_power(point.v, -drift) };
            stepper.begin(&scaled);
        }
    }
}

/// The step itself or, if it changed nothing, as many like it as it takes to move x to the next number.
///
/// Far out, where large terms balance, rounding creates spurious points of rest: x moves by less than its own
/// rounding error, and every further step would be the same again.
fn progress(step: Step, from: StepPoint, longest: f64) -> Step {
    if step.crossed || step.end != from || from.v == 0.0 {
        return step;
    }
    let x = if from.v > 0.0 { from.x.next_up() } else { from.x.next_down() };
    let duration = (x - from.x) / from.v;
    if duration < longest {
        Step { duration, end: StepPoint { x, ..from }, crossed: false }
    } else {
        Step { duration: longest, ..step }
    }
}

/// Time until v becomes infinite, where escape is certain and this time is known to rounding.
///
/// The time is that of the two driving terms alone ([`blow_up`]). It is used once the effect of the other terms
/// is below [`BLOW_UP_ERROR`] of the time so far.
pub(super) fn time_to_blow_up(field: &HalfPlane, point: StepPoint, elapsed: f64) -> Option<f64> {
    let (rest, others) = blow_up(field, point)?;
    (rest * others <= BLOW_UP_ERROR * elapsed).then_some(rest)
}

/// Whether v is certain to become infinite.
pub(crate) fn is_escaping(field: &HalfPlane, point: StepPoint) -> bool {
    blow_up(field, point).is_some()
}

/// Where escape is certain: the time until then from the terms that drive v alone, and the size of all other
/// terms relative to theirs.
///
/// For `v < 0` (reached only without friction) the mirror image is taken. With `a = -D2` and `b = -D3` the
/// terms `a v^2 + b v^3` drive v. Escape is certain once they exceed eight times all others together and x can
/// no longer catch up; if `a` brakes, it must do so with at most half of what `b` gives. From then on v grows,
/// and these ratios with it.
fn blow_up(field: &HalfPlane, point: StepPoint) -> Option<(f64, f64)> {
    let v = point.v.abs();
    let (a, b) = (if point.v < 0.0 { field.d2 } else { -field.d2 }, -field.d3);
    let drives = if a < 0.0 { b * v >= -2.0 * a } else { b >= 0.0 && (a > 0.0 || b > 0.0) };
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
        let bend = if s.abs() < f64::MIN_POSITIVE { 0.0 } else { s * ln_1p(1.0 / s) };
        return (1.0 - bend) / (a * v);
    }
    // 1/(b v^2) times the sum of (-1/s)^k/(k + 2).
    let part = -a / (b * v);
    let series = (2..=10).rev().fold(0.0, |sum, k| sum * part + 1.0 / f64::from(k));
    series / (b * v * v)
}
