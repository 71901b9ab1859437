//! Values of a parameter at which the number of limit cycles changes, enclosed: a fold, and the escape of a cycle
//! to infinity.
//!
//! On one side of a fold the displacement `G(z) - z` has two zeros near its clearance, on the other none.
//! Suppose both are proved at two values of a parameter, and the displacement keeps one sign at the ends of an
//! interval of clearances for all values between. Then two cycles merge and vanish between the two values
//! (lemma 19). No derivative by the parameter is needed. Where that derivative has one sign (for D, D3 and r),
//! there is only one such value.
//!
//! For `D3 = 0`, `D2 != 0` one half map has a last clearance `z_c`, beyond which no motion returns, and the
//! other maps even infinity to a finite clearance B. Where `B > z_c` the return map is above the diagonal just
//! below `z_c` and below it near the sticking set, so there is a cycle between. It reaches infinity where
//! `B = z_c` (lemma 20).

use std::cmp::Ordering;

use super::field::ParameterBox;
use super::range::bracket;
use super::{Count, HalfMaps, ProvedMap, Sign, SignedGap, sign_at};
use crate::model::Knob;
use crate::numerics::{Interval, powi};

/// A fold of limit cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedFold {
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
) -> Option<ProvedFold> {
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
        let value = change(near, |at| {
            let map = ProvedMap::new(&place(Interval::point(at)));
            let found = (steps < MOST_STEPS).then(|| inside(&map, gap, clearance, halvings))?;
            steps += map.effort.steps.get();
            found
        })?;
        let around = place(value);
        sides(&ProvedMap::new(&around), gap)?;
        Some(ProvedFold { value, clearance: touching(&around, gap) })
    })
}

/// The sign at both ends of a gap, if it is the same.
fn sides(map: &ProvedMap, gap: Interval) -> Option<Sign> {
    let low = sign_at(map, gap.lower())?;
    (sign_at(map, gap.upper())? == low).then_some(low)
}

/// Whether a gap contains two cycles, one on either side of `near`, or none; `None` if neither is certain.
fn inside(map: &ProvedMap, gap: Interval, near: f64, halvings: u32) -> Option<bool> {
    if !(map.parameters.r.lower() >= 0.0) {
        return None;
    }
    let sign = sides(map, gap)?;
    if sign_at(map, near).is_some_and(|middle| middle != sign) {
        return Some(true);
    }
    let mut count = Count::default();
    count.decide(map, SignedGap { over: gap, low: sign, high: sign }, halvings);
    (count.open.is_empty() && count.cycles.is_empty()).then_some(false)
}

/// All clearances in a gap at which the derivative of the return map may be 1, as it is where two cycles merge.
fn touching(parameters: &ParameterBox, gap: Interval) -> Interval {
    /// Fractions of the interval to cut off at each end; a smaller one is tried where a larger one is not certain.
    const PARTS: [f64; 4] = [0.3, 0.1, 0.03, 0.01];
    let map = ProvedMap::new(parameters);
    let regular = |lower: f64, upper: f64| {
        let slope = map.forward.slope(Interval::new(lower, upper));
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

/// Encloses the value of the parameter `symbol` (D, D2 or r) near `near` at which a cycle escapes to infinity,
/// for `D3 = 0`. The other parameters are those of `parameters`, which may be intervals. `None` where nothing
/// could be proved.
pub fn enclose_escape(parameters: &ParameterBox, symbol: Knob, near: f64) -> Option<Interval> {
    change(near, |at| returns_from_infinity(&parameters.with(symbol, Interval::point(at))))
}

/// Whether the half swing after one from infinity returns; `None` where that is not certain.
fn returns_from_infinity(parameters: &ParameterBox) -> Option<bool> {
    let ParameterBox { d2, d3, r, .. } = *parameters;
    // The half swing on which D2 brakes.
    let strong = match (d2 < 0.0, d2 > 0.0) {
        (true, _) => 0,
        (_, true) => 1,
        _ => return None,
    };
    if d3 != 0.0 || !(r.lower() >= 0.0) {
        return None;
    }
    let ProvedMap { gap, forward: HalfMaps(forward), .. } = ProvedMap::new(parameters);
    let arrivals = forward[strong].funnel()?.arrivals();
    if !arrivals.is_finite() {
        return None;
    }
    let next = forward[1 - strong].image(arrivals - gap);
    next.partial_cmp(&f64::INFINITY).map(Ordering::is_lt)
}

/// An interval near a guess in which a verdict changes: at its ends the verdict is certain and different.
///
/// Inside it may be uncertain (`None`); the ends are moved inward as far as practicable.
fn change(near: f64, mut verdict: impl FnMut(f64) -> Option<bool>) -> Option<Interval> {
    /// First distance from the guess relative to it, its growth factor, and the number of distances tried.
    const FIRST: f64 = 1e-15;
    const GROWTH: f64 = 8.0;
    const TIMES: i32 = 15;
    /// Attempts to move each end further in once an uncertain value was found.
    const CLOSER: usize = 4;
    let distances = (0..TIMES).map(|step| FIRST * powi(GROWTH, step));
    let found = bracket(near, distances, &mut verdict)?;
    let (mut low, mut high) = (found.lower(), found.upper());
    let middle = |low: f64, high: f64| low + 0.5 * (high - low);
    let at = found.middle();
    if at > low && at < high {
        let (mut from, mut to) = (at, at);
        for _ in 0..CLOSER {
            let (left, right) = (middle(low, from), middle(to, high));
            *(if verdict(left).is_some() { &mut low } else { &mut from }) = left;
            *(if verdict(right).is_some() { &mut high } else { &mut to }) = right;
        }
    }
    Some(Interval::new(low, high))
}
