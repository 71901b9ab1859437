//! All zeros of the growth of a map that never decreases: `f(u) = F(u) - u`. Each value, with its derivative,
//! costs an integration.
//!
//! If the map carries one end of an interval beyond the other, it has no fixed point between them. An interval is
//! halved until a cubic through both ends predicts the middle. A zero then shows as a change of sign, and a pair of
//! zeros as an extremum beyond zero: a function that a cubic predicts to a few percent of its distance from zero
//! cannot hide a pair.

use crate::flow::Reason;
use crate::numerics::polynomial::Hermite;
use crate::numerics::root::{Bracket, PlaceTolerance, illinois, try_newton};

/// A value of the function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthSample {
    /// Argument.
    pub u: f64,
    /// The value.
    pub f: f64,
    /// The derivative.
    pub slope: f64,
}

/// Maximum number of times that an interval is halved.
const DEPTH: u32 = 12;

/// Error with which the cubic must predict the middle, as a fraction of the distance from zero.
const PREDICTED: f64 = 0.05;

/// Values below this count as zero.
pub const NOTHING: f64 = 1e-12;

/// Rounding error of one evaluation.
const ROUNDING: f64 = 1e-14;

/// The result of a search.
#[derive(Clone, Debug, Default)]
pub struct Zeros {
    /// The zeros in increasing order.
    pub found: Vec<f64>,
    /// Intervals in which no cubic predicted the function even after all halvings: zeros may be missing there.
    pub unresolved: Vec<(f64, f64)>,
}

/// The zeros of a function between two samples. Fails with the [`Reason`] of an evaluation.
pub fn zeros(
    ends: (GrowthSample, GrowthSample),
    evaluate: &mut impl FnMut(f64) -> Result<GrowthSample, Reason>,
) -> Result<Zeros, Reason> {
    /// Initial number of intervals.
    const FIRST: i32 = 8;
    let mut found = Zeros::default();
    let mut left = ends.0;
    for part in 1..=FIRST {
        let at = ends.0.u + (ends.1.u - ends.0.u) * f64::from(part) / f64::from(FIRST);
        let right = if part == FIRST { ends.1 } else { evaluate(at)? };
        within(left, right, DEPTH, evaluate, &mut found)?;
        left = right;
    }
    Ok(found)
}

fn within(
    left: GrowthSample,
    right: GrowthSample,
    depth: u32,
    evaluate: &mut impl FnMut(f64) -> Result<GrowthSample, Reason>,
    found: &mut Zeros,
) -> Result<(), Reason> {
    let h = right.u - left.u;
    if left.f > h || right.f < -h {
        return Ok(());
    }
    let middle = evaluate(0.5 * (left.u + right.u))?;
    let slopes = (h * left.slope, h * right.slope);
    let foretold = Hermite { values: (left.f, right.f), slopes }.at(0.5);
    let least = left.f.abs().min(right.f.abs()).min(middle.f.abs());
    let error = (foretold - middle.f).abs();
    // If all values have one sign and all slopes another, there is no room for zeros, however rough the function.
    let monotone = left.slope * middle.slope > 0.0 && middle.slope * right.slope > 0.0;
    let settled = error <= PREDICTED * least || error <= NOTHING || (monotone && error < 0.5 * h);
    if depth > 0 && !settled {
        within(left, middle, depth - 1, evaluate, found)?;
        return within(middle, right, depth - 1, evaluate, found);
    }
    if !settled {
        found.unresolved.push((left.u, right.u));
    }
    leaf(left, middle, evaluate, &mut found.found)?;
    leaf(middle, right, evaluate, &mut found.found)
}

/// The zeros where the function is nearly a cubic.
fn leaf(
    left: GrowthSample,
    right: GrowthSample,
    evaluate: &mut impl FnMut(f64) -> Result<GrowthSample, Reason>,
    found: &mut Vec<f64>,
) -> Result<(), Reason> {
    // If all motions are periodic to rounding, zeros cannot be distinguished.
    if left.f.abs() < ROUNDING || right.f.abs() < ROUNDING {
        return Ok(());
    }
    if (left.f > 0.0) != (right.f > 0.0) {
        found.push(zero(left, right, evaluate)?);
        return Ok(());
    }
    let sign = if left.f > 0.0 { 1.0 } else { -1.0 };
    if sign * left.slope < 0.0 && sign * right.slope > 0.0 {
        let lowest = extremum(left, right, evaluate)?;
        if sign * lowest.f <= 0.0 {
            found.push(zero(left, lowest, evaluate)?);
            found.push(zero(lowest, right, evaluate)?);
        }
    }
    Ok(())
}

/// The zero between two samples of different sign: Newton's method inside a bracket. Fails with the [`Reason`]
/// of an evaluation.
pub fn zero(
    left: GrowthSample,
    right: GrowthSample,
    evaluate: &mut impl FnMut(f64) -> Result<GrowthSample, Reason>,
) -> Result<f64, Reason> {
    let best = if left.f.abs() < right.f.abs() { left } else { right };
    if best.f == 0.0 {
        return Ok(best.u);
    }
    let rising = (right.f > 0.0) == (left.u < right.u);
    let bracket = Bracket { low: left.u.min(right.u), high: left.u.max(right.u), rising };
    let settled = PlaceTolerance::Absolute(2.0 * f64::EPSILON * (1.0 + best.u.abs()).min(2.0));
    let start = bracket.inside(best.u - best.f / best.slope);
    let root = try_newton(bracket, start, settled, |u| {
        evaluate(u).map(|sample| (sample.f, sample.slope))
    })?;
    Ok(root.at)
}

/// Where the slope vanishes between two samples with slopes of different sign, or a place on the way there at which
/// the function has another sign than at both. Fails with the [`Reason`] of an evaluation.
fn extremum(
    left: GrowthSample,
    right: GrowthSample,
    evaluate: &mut impl FnMut(f64) -> Result<GrowthSample, Reason>,
) -> Result<GrowthSample, Reason> {
    const WIDTH: PlaceTolerance = PlaceTolerance::Absolute(1e-9);
    let mut best = if left.f.abs() < right.f.abs() { left } else { right };
    // The result of an early end is passed on in place of an error.
    let slope = |u| {
        let here = evaluate(u).map_err(Err)?;
        if here.f.abs() < best.f.abs() {
            best = here;
        }
        let crossed = (here.f > 0.0) != (left.f > 0.0);
        if crossed { Err(Ok(here)) } else { Ok(here.slope) }
    };
    match illinois([(left.u, left.slope), (right.u, right.slope)], 0.0, WIDTH, slope) {
        Err(found) => found,
        Ok(_) => Ok(best),
    }
}
