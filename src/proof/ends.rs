//! The two ends of the search for cycles: clearances below and above which there is no cycle.

use super::barrier::least_end;
use super::map::{Direction, ProvedMap};
use crate::numerics::Interval;

/// The side of the diagonal on which the return map lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// The next clearance is larger, or the motion never turns again.
    Above,
    /// The next clearance is smaller, or the motion comes to rest.
    Below,
}

/// The result at one end of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SearchEnd {
    /// No cycle has its clearance beyond this one, at which the map has this sign.
    At(f64, Sign),
    /// There is no cycle at all.
    Empty,
    /// Nothing could be proved.
    Open,
}

/// The inner end of the search.
pub fn inner_end(map: &mut ProvedMap) -> SearchEnd {
    /// Halvings of the trial clearance where the inverse is not known.
    const HALVINGS: i32 = 40;
    // The largest clearances from which the second swing, and both swings, end in the sticking set.
    let second = map.half(1, Direction::Backward, Interval::point(0.0));
    if second.lower() == f64::INFINITY {
        return SearchEnd::Empty;
    }
    let first = map.half(0, Direction::Backward, Interval::point(second.lower()));
    if first.lower() == f64::INFINITY {
        return SearchEnd::Empty;
    }
    if first.lower() > 0.0 {
        return SearchEnd::At(first.lower(), Sign::Below);
    }
    let (gap, fields) = (map.gap, map.halves.map(|half| *half.field(Direction::Forward)));
    if fields[0].a.upper() <= -2.0 {
        let funnels = [0, 1].map(|index| map.funnel(index, Direction::Forward));
        let least = [0, 1].map(|index| {
            let end = least_end(&fields[index], funnels[index].as_ref());
            (Interval::point(end) - gap).lower()
        });
        let passed = map.half(1, Direction::Forward, Interval::point(least[0])).lower();
        let bound = passed.max(least[1]);
        if bound > 0.0 && bound < f64::INFINITY {
            // No image is smaller, provided that every motion returns.
            let returns = map.parameters.d3.lower() > 0.0 && least[0] > 0.0;
            let sign = if returns { Some(Sign::Above) } else { sign_at(map, bound) };
            return sign.map_or(SearchEnd::Open, |sign| SearchEnd::At(bound, sign));
        }
        if bound == f64::INFINITY {
            return SearchEnd::Empty;
        }
    }
    let mut clearance = gap.lower();
    for _ in 0..HALVINGS {
        if map.image(Direction::Forward, Interval::point(clearance)).upper() == f64::NEG_INFINITY {
            return SearchEnd::At(clearance, Sign::Below);
        }
        clearance *= 0.5;
    }
    SearchEnd::Open
}

/// The outer end of the search; `inner` is the clearance at the inner one.
pub fn outer_end(map: &mut ProvedMap, inner: f64) -> SearchEnd {
    let [first, second] = [0, 1].map(|index| {
        let greatest = map.greatest(index, Direction::Forward);
        if greatest < f64::INFINITY {
            (Interval::point(greatest) - map.gap).upper()
        } else {
            greatest
        }
    });
    if first <= 0.0 || second <= 0.0 {
        return SearchEnd::Empty;
    }
    let through = if first < f64::INFINITY {
        map.half(1, Direction::Forward, Interval::point(first)).upper()
    } else {
        f64::INFINITY
    };
    let bound = second.min(through);
    if bound < inner {
        return SearchEnd::Empty;
    }
    if bound < f64::INFINITY {
        // No image is larger: the map is not above the diagonal there, unless the motion never turns again.
        let sign =
            if map.parameters.d3.lower() > 0.0 { Some(Sign::Below) } else { sign_at(map, bound) };
        return sign.map_or(SearchEnd::Open, |sign| SearchEnd::At(bound, sign));
    }
    // The same for the inverse, all of whose images are below its greatest one.
    let back = map.greatest(1, Direction::Backward);
    let whole = map.greatest(0, Direction::Backward);
    let through = map.half(0, Direction::Backward, Interval::point(back)).upper();
    let bound = through.min(whole);
    if bound < f64::INFINITY && bound > inner {
        return SearchEnd::At(bound, Sign::Above);
    }
    escape(map, inner)
}

/// A clearance from which no motion turns twice.
fn escape(map: &mut ProvedMap, inner: f64) -> SearchEnd {
    let mut clearance = inner.max(map.gap.upper());
    for _ in 0..200 {
        clearance *= 4.0;
        if !clearance.is_finite() {
            break;
        }
        if map.image(Direction::Forward, Interval::point(clearance)).lower() == f64::INFINITY {
            return SearchEnd::At(clearance, Sign::Above);
        }
    }
    SearchEnd::Open
}

/// The side of the diagonal on which the map certainly lies at a clearance.
pub fn sign_at(map: &mut ProvedMap, clearance: f64) -> Option<Sign> {
    let image = map.image(Direction::Forward, Interval::point(clearance));
    if image.lower() > clearance {
        Some(Sign::Above)
    } else if image.upper() < clearance {
        Some(Sign::Below)
    } else {
        None
    }
}
