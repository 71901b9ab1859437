//! All zeros of the growth of a map that never decreases: `f(u) = F(u) - u`. Each value, with its derivative,
//! costs an integration.
//!
//! If the map carries one end of an interval beyond the other, it has no fixed point between them. An interval is
//! halved until a cubic through both ends predicts the middle. A zero then shows as a change of sign, and a pair of
//! zeros as an extremum beyond zero: a function that a cubic predicts to a few percent of its distance from zero
//! cannot hide a pair.

use crate::flow::Reason;
use crate::numerics::polynomial::Hermite;
use crate::numerics::root::{Bracket, PlaceTolerance, try_newton};
use crate::portrait::closing::search::{Node, beyond_zero};

/// Maximum number of times that an interval is halved.
const DEPTH: u32 = 12;

/// Error with which the cubic must predict the middle, as a fraction of the distance from zero.
const PREDICTED: f64 = 0.05;

/// Values below this count as zero.
pub const NOTHING: f64 = 1e-12;

/// Relative width to which an extremum is sought.
const WIDTH: f64 = 1e-9;

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
    ends: (Node, Node),
    evaluate: &mut impl FnMut(f64) -> Result<Node, Reason>,
) -> Result<Zeros, Reason> {
    /// Initial number of intervals.
    const FIRST: i32 = 8;
    let mut found = Zeros::default();
    let mut left = ends.0;
    for part in 1..=FIRST {
        let at = ends.0.at + (ends.1.at - ends.0.at) * f64::from(part) / f64::from(FIRST);
        let right = if part == FIRST { ends.1 } else { evaluate(at)? };
        within(left, right, DEPTH, evaluate, &mut found)?;
        left = right;
    }
    Ok(found)
}

fn within(
    left: Node,
    right: Node,
    depth: u32,
    evaluate: &mut impl FnMut(f64) -> Result<Node, Reason>,
    found: &mut Zeros,
) -> Result<(), Reason> {
    let h = right.at - left.at;
    if left.difference > h || right.difference < -h {
        return Ok(());
    }
    let middle = evaluate(0.5 * (left.at + right.at))?;
    let slopes = (h * left.slope, h * right.slope);
    let foretold = Hermite { values: (left.difference, right.difference), slopes }.at(0.5);
    let least = left.difference.abs().min(right.difference.abs()).min(middle.difference.abs());
    let error = (foretold - middle.difference).abs();
    // If all values have one sign and all slopes another, there is no room for zeros, however rough the function.
    let monotone = left.slope * middle.slope > 0.0 && middle.slope * right.slope > 0.0;
    let settled = error <= PREDICTED * least || error <= NOTHING || (monotone && error < 0.5 * h);
    if depth > 0 && !settled {
        within(left, middle, depth - 1, evaluate, found)?;
        return within(middle, right, depth - 1, evaluate, found);
    }
    if !settled {
        found.unresolved.push((left.at, right.at));
    }
    leaf(left, middle, evaluate, &mut found.found)?;
    leaf(middle, right, evaluate, &mut found.found)
}

/// The zeros where the function is nearly a cubic.
fn leaf(
    left: Node,
    right: Node,
    evaluate: &mut impl FnMut(f64) -> Result<Node, Reason>,
    found: &mut Vec<f64>,
) -> Result<(), Reason> {
    // If all motions are periodic to rounding, zeros cannot be distinguished.
    if left.difference.abs() < ROUNDING || right.difference.abs() < ROUNDING {
        return Ok(());
    }
    if (left.difference > 0.0) != (right.difference > 0.0) {
        found.push(zero(left, right, evaluate)?);
        return Ok(());
    }
    if let Some(beyond) = beyond_zero(left, right, WIDTH, &mut |u, _| evaluate(u))? {
        found.push(zero(left, beyond, evaluate)?);
        found.push(zero(beyond, right, evaluate)?);
    }
    Ok(())
}

/// The zero between two samples of different sign: Newton's method inside a bracket. Fails with the [`Reason`]
/// of an evaluation.
pub fn zero(
    left: Node,
    right: Node,
    evaluate: &mut impl FnMut(f64) -> Result<Node, Reason>,
) -> Result<f64, Reason> {
    let best = if left.difference.abs() < right.difference.abs() { left } else { right };
    if best.difference == 0.0 {
        return Ok(best.at);
    }
    let rising = (right.difference > 0.0) == (left.at < right.at);
    let bracket = Bracket { low: left.at.min(right.at), high: left.at.max(right.at), rising };
    let settled = PlaceTolerance::Absolute(2.0 * f64::EPSILON * (1.0 + best.at.abs()).min(2.0));
    let start = bracket.inside(best.at - best.difference / best.slope);
    let root = try_newton(bracket, start, settled, |u| {
        evaluate(u).map(|sample| (sample.difference, sample.slope))
    })?;
    Ok(root.at)
}
