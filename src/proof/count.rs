//! The count of limit cycles: every clearance between two ends, below and above which there is no cycle, is
//! excluded, or lies in an interval that contains exactly one cycle, or is reported as open.
//!
//! Where the return map G is above the diagonal at A, no cycle has its clearance in `[A, G(A))`: G is
//! increasing, so `G(z) >= G(A) > z` there. The other three cases follow with the inverse and with the opposite
//! sign. A gap is thus narrowed from both sides by iteration. What remains is decided by the derivative, if it
//! differs from 1 throughout (one cycle if the signs differ, none otherwise), or by the distance from the
//! diagonal in the middle. Otherwise the gap is halved.

use std::cmp::Ordering;

use super::{
    Bound, Enclosure, FieldBox, Funnel, HalfMaps, ProvedHalf, ProvedMap, StartBox, swing_below,
};
use crate::numerics::{Interval, pow, times_power};

/// Relative width below which a gap is not halved any more.
const NARROWEST: f64 = 1e-13;

/// An end of a gap, and the side of the diagonal on which the map lies there.
pub type GapEnd = (f64, Sign);

/// An interval of clearances, and the side of the diagonal on which the map lies at either end.
#[derive(Clone, Copy, Debug)]
pub struct SignedGap {
    /// The clearances.
    pub over: Interval,
    /// At the lower end.
    pub low: Sign,
    /// At the upper end.
    pub high: Sign,
}

impl SignedGap {
    fn between((from, low): GapEnd, (to, high): GapEnd) -> Self {
        SignedGap { over: Interval::new(from, to), low, high }
    }
}

/// A limit cycle that exists and is unique in an interval of clearances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvedCycle {
    /// Contains its clearance `q_max - r` and that of no other cycle.
    pub within: Interval,
    /// Whether it attracts.
    pub stable: bool,
    /// Bounds of its characteristics, where they could be computed.
    pub enclosure: Option<Enclosure>,
}

/// The outcome for all gaps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Count {
    /// The cycles that there are.
    pub cycles: Vec<ProvedCycle>,
    /// Undecided intervals.
    pub open: Vec<Interval>,
}

impl Count {
    /// Counts the cycles by the return map, as far as it can be bounded.
    pub fn of(map: &ProvedMap) -> Self {
        /// Halvings of the whole range before a gap is left open.
        const HALVINGS: u32 = 60;
        match inner_end(map).and_then(|low| Ok((low, outer_end(map, low.0)?))) {
            Ok((low, high)) => {
                let mut count = Count::default();
                count.decide(map, SignedGap::between(low, high), HALVINGS);
                count
            }
            Err(f64::INFINITY) => Count::default(),
            Err(from) => {
                Count { cycles: Vec::new(), open: vec![Interval::new(from, f64::INFINITY)] }
            }
        }
    }

    /// Decides a gap.
    pub fn decide(&mut self, map: &ProvedMap, gap: SignedGap, halvings: u32) {
        /// The iteration continues while each pass closes this fraction of the gap.
        const WORTH: f64 = 0.25;
        /// Relative width below which a gap with different signs at its ends goes straight to the derivative.
        const NEAR: f64 = 0.15;
        let SignedGap { over, low, high } = gap;
        let (mut from, mut to) = (over.lower(), over.upper());
        loop {
            let before = to - from;
            if low != high || low == Sign::Above {
                from = narrowed(map, (from, low), Bound::Lower);
            }
            if from <= to && (low != high || low == Sign::Below) {
                to = narrowed(map, (to, high), Bound::Upper);
            }
            if from > to {
                return;
            }
            let left = to - from;
            if left > (1.0 - WORTH) * before || (left < NEAR * from && low != high) {
                break;
            }
        }
        let gap = SignedGap { over: Interval::new(from, to), ..gap };
        if to < 1.6 * from && self.settle(map, gap) {
            return;
        }
        if gap.over.width() <= NARROWEST * to || halvings == 0 {
            return self.leave(gap.over);
        }
        let Some(middle) = clear_middle(map, gap.over) else { return self.leave(gap.over) };
        self.decide(map, SignedGap::between((from, low), middle), halvings - 1);
        self.decide(map, SignedGap::between(middle, (to, high)), halvings - 1);
    }

    /// Leaves a gap open, merging it with an open one that it touches.
    fn leave(&mut self, gap: Interval) {
        match self.open.last_mut() {
            Some(last) if last.upper() >= gap.lower() => *last = last.hull(gap),
            _ => self.open.push(gap),
        }
    }

    /// Decides a gap by the derivative of the map or of its inverse; returns whether that succeeded.
    fn settle(&mut self, map: &ProvedMap, gap: SignedGap) -> bool {
        let mut order = [&map.forward, &map.backward];
        // Near a repelling cycle the inverse contracts, and is known where the map itself is not.
        if gap.low == Sign::Below && gap.high == Sign::Above {
            order.reverse();
        }
        order.into_iter().any(|way| self.settle_along(way, gap))
    }

    fn settle_along(&mut self, way: &HalfMaps, gap: SignedGap) -> bool {
        let SignedGap { over, low, high } = gap;
        let Some(slope) = way.slope(over) else { return false };
        if !slope.contains(1.0) {
            if low != high {
                let stable = low == Sign::Above;
                self.cycles.push(ProvedCycle { within: over, stable, enclosure: None });
            }
            return true;
        }
        if low != high {
            return false;
        }
        // Whether the distance from the diagonal in the middle exceeds any approach towards an end.
        let middle = Interval::point(over.middle());
        let away = way.image(middle) - middle;
        let sway = (slope - 1.0) * (over - middle);
        !(away + sway).contains(0.0)
    }
}

/// A new edge of a gap, the lower or the upper one, in place of this one.
fn narrowed(map: &ProvedMap, (at, sign): GapEnd, which: Bound) -> f64 {
    let inwards = (which == Bound::Lower) == (sign == Sign::Above);
    let way = if inwards { &map.forward } else { &map.backward };
    let image = way.image_bound(at, which);
    if which == Bound::Lower {
        image.max(at)
    } else {
        image.min(at)
    }
}

/// A point inside a gap where the sign is certain.
fn clear_middle(map: &ProvedMap, gap: Interval) -> Option<GapEnd> {
    /// Fractions of the gap to try.
    const PARTS: [f64; 6] = [0.5, 0.57, 0.43, 0.64, 0.36, 0.79];
    let (low, high) = (gap.lower(), gap.upper());
    let wide = low > 0.0 && high > 4.0 * low;
    PARTS.iter().find_map(|&part| {
        let at = if wide {
            low * pow(high / low, part)
        } else {
            low + part * (high - low)
        };
        let sign = (at > low && at < high).then(|| sign_at(map, at))??;
        Some((at, sign))
    })
}

/// The side of the diagonal on which the return map lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The next clearance is larger, or the motion never turns again.
    Above,
    /// The next clearance is smaller, or the motion comes to rest.
    Below,
}

/// An end of the search, beyond which no cycle has its clearance; or the clearance from which on nothing could be proved,
/// infinite where there is no cycle at all.
type SearchEnd = Result<GapEnd, f64>;

/// The inner end of the search.
fn inner_end(map: &ProvedMap) -> SearchEnd {
    /// Halvings of the trial clearance where the inverse is not known.
    const HALVINGS: i32 = 40;
    // The largest clearances from which the second swing, and both swings, end in the sticking set.
    let mut largest = 0.0;
    for half in &map.backward.0 {
        largest = half.image(Interval::point(largest)).lower();
        if largest == f64::INFINITY {
            return Err(f64::INFINITY);
        }
    }
    if largest > 0.0 {
        return Ok((largest, Sign::Below));
    }
    let gap = map.gap;
    if map.forward.0[0].field.a.upper() <= -2.0 {
        let least = map.forward.0.each_ref().map(|half| {
            let end = least_end(&half.field, half.funnel());
            (Interval::point(end) - gap).lower()
        });
        let passed = map.forward.0[1].image(Interval::point(least[0])).lower();
        let bound = passed.max(least[1]);
        if bound > 0.0 && bound < f64::INFINITY {
            // No image is smaller, provided that every motion returns.
            let returns = map.parameters.d3 > 0.0 && least[0] > 0.0;
            let sign = if returns {
                Some(Sign::Above)
            } else {
                sign_at(map, bound)
            };
            return sign.map(|sign| (bound, sign)).ok_or(0.0);
        }
        if bound == f64::INFINITY {
            return Err(f64::INFINITY);
        }
    }
    let mut trials = (0..HALVINGS).map(|halvings| times_power(gap.lower(), -halvings));
    let rests = trials.find(|&at| map.forward.image(Interval::point(at)) == f64::NEG_INFINITY);
    rests.map(|at| (at, Sign::Below)).ok_or(0.0)
}

/// Lower bound of the ends of swings that start next to the centre, for `a <= -2`. The centre is then a
/// repelling node, and every swing, however small, leaves its neighbourhood along the steep direction (lemma 10).
///
/// With `k = 2 abs(b) + 1` motions cross the parabola `v = x - k x^2` upwards as long as
/// `x (2 k^2 + abs(c)) <= k - abs(b)`, and those from next to the centre start above it.
fn least_end(field: &FieldBox, funnel: Option<&Funnel>) -> f64 {
    /// Fraction of the largest admissible point at which the motion is started, so that its exact start does
    /// not matter.
    const NEAR: f64 = 1e-3;
    let [b, c] = [field.b, field.c].map(|it| Interval::point(it.magnitude()));
    let k = Interval::point(2.0 * b.upper() + 1.0);
    let bound = (k - b) / (k.square() * 2.0 + c);
    let at = Interval::point(NEAR * bound.lower());
    let v = at - k * at.square();
    if !(at > 0.0 && v > 0.0) {
        return 0.0;
    }
    let start = StartBox { x: at, v: Interval::point(v.lower()) };
    let ceiling = funnel.map_or(f64::INFINITY, |it| it.ceiling);
    let field = field.strongest();
    let passage = swing_below(&field, &start, ceiling, false);
    Funnel::least_after(funnel, &field, &passage).max(0.0)
}

/// The outer end of the search; `inner` is the clearance at the inner one.
fn outer_end(map: &ProvedMap, inner: f64) -> SearchEnd {
    /// How often a clearance is quadrupled in search of an escape.
    const QUADRUPLINGS: i32 = 200;
    let greatest = |half: &ProvedHalf| Interval::point(half.greatest(f64::INFINITY)) - map.gap;
    let [first, second] = map.forward.0.each_ref().map(|half| greatest(half).upper());
    if first <= 0.0 || second <= 0.0 {
        return Err(f64::INFINITY);
    }
    let through = if first < f64::INFINITY {
        map.forward.0[1].image(Interval::point(first)).upper()
    } else {
        f64::INFINITY
    };
    let bound = second.min(through);
    if bound < inner {
        return Err(f64::INFINITY);
    }
    if bound < f64::INFINITY {
        // No image is larger: the map is not above the diagonal there, unless the motion never turns again.
        let returns = map.parameters.d3 > 0.0;
        let sign = if returns {
            Some(Sign::Below)
        } else {
            sign_at(map, bound)
        };
        return sign.map(|sign| (bound, sign)).ok_or(inner);
    }
    // The same for the inverse, all of whose images are below its greatest one.
    let [back, whole] = map.backward.0.each_ref().map(|half| half.greatest(f64::INFINITY));
    let through = map.backward.0[1].image(Interval::point(back)).upper();
    let bound = through.min(whole);
    if bound < f64::INFINITY && bound > inner {
        return Ok((bound, Sign::Above));
    }
    // Or a clearance from which no motion turns twice.
    let size = inner.max(map.gap.upper());
    let trials = (1..=QUADRUPLINGS).map(|times| times_power(size, 2 * times));
    let escapes = trials
        .take_while(|at| at.is_finite())
        .find(|&at| map.forward.image(Interval::point(at)) == f64::INFINITY);
    escapes.map(|at| (at, Sign::Above)).ok_or(inner)
}

/// The side of the diagonal on which the map certainly lies at a clearance.
pub fn sign_at(map: &ProvedMap, clearance: f64) -> Option<Sign> {
    match map.forward.image(Interval::point(clearance)).partial_cmp(&clearance)? {
        Ordering::Greater => Some(Sign::Above),
        Ordering::Less => Some(Sign::Below),
        Ordering::Equal => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::ParameterBox;
    use crate::proof::swing::swing;

    /// Next to a fold the derivative of G differs little from 1, and there are two cycles, at 0.415062 and 0.416022.
    #[test]
    fn cycles_next_to_a_fold_are_told_apart() {
        let [d, d2, d3, r] = [-0.172_784_28, 0.2, 0.5, 0.1].map(Interval::point);
        let map = ProvedMap::new(&ParameterBox { d, d2, d3, r });
        let mut count = Count::default();
        let over = Interval::new(0.414, 0.417);
        let gap = SignedGap { over, low: Sign::Below, high: Sign::Below };
        count.decide(&map, gap, 40);
        let cycles = [(0.415_062_415_659, false), (0.416_021_602_729, true)];
        assert!(count.open.is_empty() && count.cycles.len() == 2, "{count:?}");
        // Between them the derivative passes through 1. At both it differs from 1 by only 0.0022, so it decides
        // nothing.
        let both = Interval::new(0.415_06, 0.416_03);
        for way in [&map.forward, &map.backward] {
            let mut settled = Count::default();
            let gap = SignedGap { over: both, ..gap };
            assert!(!settled.settle_along(way, gap));
        }
        for (found, (clearance, stable)) in count.cycles.iter().zip(cycles) {
            assert!(found.within.contains(clearance) && found.stable == stable, "{count:?}");
        }
    }

    /// However near to the centre a swing starts, it ends beyond the common bound.
    #[test]
    fn swings_from_next_to_a_node_end_beyond_their_bound() {
        for coefficients in [[-2.0, 0.5, 1.0], [-2.2, -0.5, 1.0], [-2.5, 0.0, 3.0]] {
            let [a, b, c] = coefficients.map(Interval::point);
            let node = FieldBox { a, b, c };
            let least = least_end(&node, None);
            assert!(least > 0.0, "{coefficients:?}");
            for z in [1e-9, 1e-5, 1e-3, 0.1] {
                let start = StartBox::at_rest(Interval::point(z));
                let end = swing(&node, &start).arrived().unwrap().end;
                assert!(end.upper() >= least, "{coefficients:?} {z}: {end} {least}");
            }
        }
    }
}
