//! The count of limit cycles: every clearance between the inner and the outer end is excluded, or lies in an
//! interval that contains exactly one cycle, or is reported as open.
//!
//! Where the return map G is above the diagonal at A, no cycle has its clearance in `[A, G(A))`: G is
//! increasing, so `G(z) >= G(A) > z` there. The other three cases follow with the inverse and with the opposite
//! sign. A gap is thus narrowed from both sides by iteration. What remains is decided by the derivative, if it
//! differs from 1 throughout (one cycle if the signs differ, none otherwise), or by the distance from the
//! diagonal in the middle. Otherwise the gap is halved.

use super::ends::{Sign, sign_at};
use super::map::{Bound, MapDirection, ProvedMap};
use crate::numerics::Interval;
use crate::numerics::elementary::pow;

/// Relative width below which a gap is not halved any more.
const NARROWEST: f64 = 1e-13;

/// An end of a gap, and the side of the diagonal on which the map lies there.
pub type GapEnd = (f64, Sign);

/// The outcome for all gaps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Count {
    /// Intervals of clearances that contain exactly one cycle each, and whether it attracts.
    pub unique: Vec<(Interval, bool)>,
    /// Undecided intervals.
    pub open: Vec<Interval>,
}

impl Count {
    /// Decides the gap between two edges.
    pub fn decide(
        &mut self,
        map: &mut ProvedMap,
        mut low: GapEnd,
        mut high: GapEnd,
        halvings: u32,
    ) {
        /// The iteration continues while each pass closes this fraction of the gap.
        const WORTH: f64 = 0.25;
        /// Relative width below which a gap with different signs at its ends goes straight to the derivative.
        const NEAR: f64 = 0.15;
        loop {
            let before = high.0 - low.0;
            if low.1 != high.1 || low.1 == Sign::Above {
                low.0 = from_below(map, low);
            }
            if low.0 <= high.0 && (low.1 != high.1 || low.1 == Sign::Below) {
                high.0 = from_above(map, high);
            }
            if low.0 > high.0 {
                return;
            }
            let left = high.0 - low.0;
            if left > (1.0 - WORTH) * before || (left < NEAR * low.0 && low.1 != high.1) {
                break;
            }
        }
        let gap = Interval::new(low.0, high.0);
        if high.0 < 1.6 * low.0 && self.settle(map, gap, low.1, high.1) {
            return;
        }
        if gap.width() <= NARROWEST * high.0 || halvings == 0 {
            return self.leave(low, high);
        }
        let Some(middle) = clear_middle(map, gap) else { return self.leave(low, high) };
        self.decide(map, low, middle, halvings - 1);
        self.decide(map, middle, high, halvings - 1);
    }

    /// Leaves a gap open, merging it with an open one that it touches.
    fn leave(&mut self, low: GapEnd, high: GapEnd) {
        let gap = Interval::new(low.0, high.0);
        match self.open.last_mut() {
            Some(last) if last.upper() >= gap.lower() => *last = last.hull(gap),
            _ => self.open.push(gap),
        }
    }

    /// Decides a gap by the derivative of the map or of its inverse; returns whether that succeeded.
    fn settle(&mut self, map: &mut ProvedMap, gap: Interval, low: Sign, high: Sign) -> bool {
        // Near a repelling cycle the inverse contracts, and is known where the map itself is not.
        let repels = low == Sign::Below && high == Sign::Above;
        let directions = [MapDirection::Forward, MapDirection::Backward];
        let order = if repels { [directions[1], directions[0]] } else { directions };
        order.into_iter().any(|direction| self.settle_along(map, direction, gap, low, high))
    }

    fn settle_along(
        &mut self,
        map: &mut ProvedMap,
        direction: MapDirection,
        gap: Interval,
        low: Sign,
        high: Sign,
    ) -> bool {
        let Some(slope) = map.slope(direction, gap) else { return false };
        if slope.lower() > 1.0 || slope.upper() < 1.0 {
            if low != high {
                self.unique.push((gap, low == Sign::Above));
            }
            return true;
        }
        if low != high {
            return false;
        }
        // Whether the distance from the diagonal in the middle exceeds any approach towards an end.
        let middle = Interval::point(gap.middle());
        let away = map.image(direction, middle) - middle;
        let sway = (slope - Interval::point(1.0)) * (gap - middle);
        let sum = away + sway;
        sum.lower() > 0.0 || sum.upper() < 0.0
    }
}

/// The new lower edge of a gap.
fn from_below(map: &mut ProvedMap, (at, sign): GapEnd) -> f64 {
    let direction = match sign {
        Sign::Above => MapDirection::Forward,
        Sign::Below => MapDirection::Backward,
    };
    map.image_bound(direction, at, Bound::Lower).max(at)
}

/// The new upper edge of a gap.
fn from_above(map: &mut ProvedMap, (at, sign): GapEnd) -> f64 {
    let direction = match sign {
        Sign::Above => MapDirection::Backward,
        Sign::Below => MapDirection::Forward,
    };
    map.image_bound(direction, at, Bound::Upper).min(at)
}

/// A point inside a gap where the sign is certain.
fn clear_middle(map: &mut ProvedMap, gap: Interval) -> Option<GapEnd> {
    /// Fractions of the gap to try.
    const PARTS: [f64; 6] = [0.5, 0.57, 0.43, 0.64, 0.36, 0.79];
    let (low, high) = (gap.lower(), gap.upper());
    let wide = low > 0.0 && high > 4.0 * low;
    PARTS.iter().find_map(|&part| {
        let at = if wide { low * pow(high / low, part) } else { low + part * (high - low) };
        let sign = (at > low && at < high).then(|| sign_at(map, at))??;
        Some((at, sign))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::ParameterBox;

    /// Next to a fold the derivative of G differs little from 1, and there are two cycles, at 0.415062 and 0.416022.
    #[test]
    fn cycles_next_to_a_fold_are_told_apart() {
        let [d, d2, d3, r] = [-0.172_784_28, 0.2, 0.5, 0.1].map(Interval::point);
        let mut map = ProvedMap::new(&ParameterBox { d, d2, d3, r });
        let mut count = Count::default();
        count.decide(&mut map, (0.414, Sign::Below), (0.417, Sign::Below), 40);
        let cycles = [(0.415_062_415_659, false), (0.416_021_602_729, true)];
        assert!(count.open.is_empty() && count.unique.len() == 2, "{count:?}");
        // Between them the derivative passes through 1. At both it differs from 1 by only 0.0022, so it decides
        // nothing.
        let both = Interval::new(0.415_06, 0.416_03);
        for direction in [MapDirection::Forward, MapDirection::Backward] {
            let mut settled = Count::default();
            assert!(!settled.settle_along(&mut map, direction, both, Sign::Below, Sign::Below));
        }
        for ((within, attracts), (clearance, stable)) in count.unique.iter().zip(cycles) {
            assert!(within.contains(clearance) && *attracts == stable, "{count:?}");
        }
    }
}
