//! The fold of limit cycles, enclosed in a parameter, by signs alone.
//!
//! On one side of a fold the displacement `G(z) - z` has two zeros near its clearance, on the other none.
//! Suppose both are proved at two values of a parameter, and the displacement keeps one sign at the ends of an
//! interval of clearances for all values between. Then two cycles merge and vanish between the two values
//! (lemma 19). No derivative by the parameter is needed. Where that derivative has one sign (for D, D3 and r),
//! there is only one such value.

use super::bracket::bracket;
use super::count::Count;
use super::ends::{Sign, sign_at};
use super::field::ParameterBox;
use super::map::{Direction, ProvedMap};
use crate::model::Knob;
use crate::numerics::Interval;

/// A fold of limit cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// The parameter value at which two cycles merge.
    pub value: Interval,
    /// Their common clearance `q_max - r`.
    pub clearance: Interval,
}

/// Encloses the fold near the value `near` of the parameter `symbol` and near a clearance. The other parameters
/// are those of `parameters`, which may be intervals. `None` where nothing could be proved.
///
/// The bounds of the value are about as close as rounding allows: a few units of 1e-15.
pub fn enclose_fold(
    parameters: &ParameterBox,
    symbol: Knob,
    near: f64,
    clearance: f64,
) -> Option<Fold> {
    /// Half the width of the interval of clearances, relative to the clearance.
    const WIDTHS: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
    /// Halvings for the first width, and how many more for each further one: closer to the fold than 1e-8
    /// rounding dominates.
    const HALVINGS: u32 = 6;
    const MORE: usize = 3;
    /// Integration steps after which nothing more is asked: some tenths of a second.
    const MOST_STEPS: u32 = 250_000;
    let place = |at: Interval| parameters.with(symbol, at);
    let mut steps = 0;
    WIDTHS.into_iter().zip((HALVINGS..).step_by(MORE)).find_map(|(width, halvings)| {
        let gap = Interval::new(clearance * (1.0 - width), clearance * (1.0 + width));
        let value = bracket(near, |at| {
            let mut map = ProvedMap::new(&place(Interval::point(at)));
            let found = (steps < MOST_STEPS).then(|| inside(&mut map, gap, clearance, halvings))?;
            steps += map.steps;
            found
        })?;
        let around = place(value);
        sides(&mut ProvedMap::new(&around), gap)?;
        Some(Fold { value, clearance: touching(&around, gap) })
    })
}

/// The sign at both ends of a gap, if it is the same.
fn sides(map: &mut ProvedMap, gap: Interval) -> Option<Sign> {
    let low = sign_at(map, gap.lower())?;
    (sign_at(map, gap.upper())? == low).then_some(low)
}

/// Whether a gap contains two cycles, one on either side of `near`, or none; `None` if neither is certain.
fn inside(map: &mut ProvedMap, gap: Interval, near: f64, halvings: u32) -> Option<bool> {
    if !(map.parameters.r.lower() >= 0.0) {
        return None;
    }
    let sign = sides(map, gap)?;
    if sign_at(map, near).is_some_and(|middle| middle != sign) {
        return Some(true);
    }
    let mut count = Count::default();
    count.decide(map, (gap.lower(), sign), (gap.upper(), sign), halvings);
    (count.open.is_empty() && count.unique.is_empty()).then_some(false)
}

/// All clearances in a gap at which the derivative of the return map may be 1, as it is where two cycles merge.
fn touching(parameters: &ParameterBox, gap: Interval) -> Interval {
    /// Fractions of the interval to cut off at each end; a smaller one is tried where a larger one is not certain.
    const PARTS: [f64; 4] = [0.3, 0.1, 0.03, 0.01];
    let mut map = ProvedMap::new(parameters);
    let mut regular = |lower: f64, upper: f64| {
        let slope = map.slope(Direction::Forward, Interval::new(lower, upper));
        upper > lower && slope.is_some_and(|slope| !slope.contains(1.0))
    };
    let (mut low, mut high) = (gap.lower(), gap.upper());
    let mut tried = 0;
    while tried < PARTS.len() {
        let part = PARTS[tried] * (high - low);
        let (from, to) = (low + part, high - part);
        let (left, right) = (regular(low, from), regular(to, high));
        (low, high) = (if left { from } else { low }, if right { to } else { high });
        tried += usize::from(!(left || right));
    }
    Interval::new(low, high)
}
