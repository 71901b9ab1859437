//! A motion to more digits than a double holds, used to measure the error of all other methods.
//!
//! The Taylor series of [`super::taylor`] in twice the working precision. Order and steps are chosen so that
//! truncation stays below rounding. An evaluation takes a hundred times as long as one in doubles.

use super::swing::swing;
use super::{Cost, Detail, Limits, Method, Motion, MotionRun, Problem, StepPoint, Stepper, Taylor};
use crate::model::{HalfPlane, Reason, Result};
use crate::numerics::Twofold;

/// How finely a motion is computed: order and tolerance of the series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Order of the series, at most 32.
    pub order: usize,
    /// Size of the last term, relative to the velocity.
    pub tolerance: f64,
}

/// Truncation below rounding.
pub const FINE: Grain = Grain { order: 32, tolerance: 1e-30 };

/// Three digits fewer, with other steps: the difference between the two bounds the error of the finer one.
pub const COARSE: Grain = Grain { order: 28, tolerance: 1e-27 };

/// Computes the motion of a problem, ignoring its method and tolerance.
///
/// Guarantee: the error is that of some hundred operations of relative error `1e-31`, amplified as the motion
/// itself amplifies disturbances. Compare two grains to measure it.
///
/// # Errors
/// [`Reason`] where the budget does not suffice (stiff motions) or a number leaves the range of doubles.
pub fn precise(problem: &Problem, grain: Grain, limits: &Limits) -> Result<Motion<Twofold>> {
    let run = MotionRun::new(problem, Method::Taylor, Detail::default(), limits);
    let found = run.go(&mut Taylor::with_order(grain.tolerance, grain.order));
    found.outcome.answered().map(|()| found)
}

/// The half swing from rest at `(-start, 0)`: its end and duration, or `None` where its velocity becomes infinite.
///
/// # Errors
/// Those of [`precise`].
pub fn half_swing(
    field: HalfPlane,
    start: Twofold,
    grain: Grain,
    cost: &mut Cost,
    limits: &Limits,
) -> Result<Option<(Twofold, Twofold)>> {
    /// Upper bound on the duration of any half swing that arrives.
    const PATIENCE: f64 = 1e100;
    let mut stepper = Taylor::with_order(grain.tolerance, grain.order);
    let point = StepPoint { x: -start, v: Twofold::default() };
    let watch = |_: &mut Taylor<Twofold>, _, _, _: &_| true;
    let found =
        swing(&mut stepper, &field, (point, 0), (Twofold::from(PATIENCE), true), limits, watch);
    *cost += Cost { steps: found.steps, ..stepper.cost() };
    match found.end {
        Ok(end) => Ok(found.crossed.then_some((end.x, found.duration))),
        Err(Reason::Escapes) => Ok(None),
        Err(reason) => Err(reason),
    }
}

#[cfg(test)]
mod tests;
