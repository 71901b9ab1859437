//! The two ends of the search for cycles: clearances below and above which there is no cycle.

use super::ball::StartBox;
use super::field::FieldBox;
use super::funnel::Funnel;
use super::map::{MapDirection, ProvedMap};
use super::swing::swing_below;
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
    let second = map.half(1, MapDirection::Backward, Interval::point(0.0));
    if second.lower() == f64::INFINITY {
        return SearchEnd::Empty;
    }
    let first = map.half(0, MapDirection::Backward, Interval::point(second.lower()));
    if first.lower() == f64::INFINITY {
        return SearchEnd::Empty;
    }
    if first.lower() > 0.0 {
        return SearchEnd::At(first.lower(), Sign::Below);
    }
    let gap = map.gap;
    if map.field(0, MapDirection::Forward).a.upper() <= -2.0 {
        let least = [0, 1].map(|index| {
            let funnel = map.funnel(index, MapDirection::Forward);
            let end = least_end(&map.field(index, MapDirection::Forward), funnel.as_ref());
            (Interval::point(end) - gap).lower()
        });
        let passed = map.half(1, MapDirection::Forward, Interval::point(least[0])).lower();
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
        if map.image(MapDirection::Forward, Interval::point(clearance)).upper() == f64::NEG_INFINITY
        {
            return SearchEnd::At(clearance, Sign::Below);
        }
        clearance *= 0.5;
    }
    SearchEnd::Open
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
    if !(at.lower() > 0.0 && v.lower() > 0.0) {
        return 0.0;
    }
    let start = StartBox { x: at, v: Interval::point(v.lower()) };
    let ceiling = funnel.map_or(f64::INFINITY, |it| it.ceiling);
    let field = field.strongest();
    let passage = swing_below(&field, &start, ceiling);
    Funnel::least_after(funnel, &field, &passage).max(0.0)
}

/// The outer end of the search; `inner` is the clearance at the inner one.
pub fn outer_end(map: &mut ProvedMap, inner: f64) -> SearchEnd {
    let [first, second] = [0, 1].map(|index| {
        let greatest = map.greatest(index, MapDirection::Forward);
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
        map.half(1, MapDirection::Forward, Interval::point(first)).upper()
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
    let back = map.greatest(1, MapDirection::Backward);
    let whole = map.greatest(0, MapDirection::Backward);
    let through = map.half(0, MapDirection::Backward, Interval::point(back)).upper();
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
        if map.image(MapDirection::Forward, Interval::point(clearance)).lower() == f64::INFINITY {
            return SearchEnd::At(clearance, Sign::Above);
        }
    }
    SearchEnd::Open
}

/// The side of the diagonal on which the map certainly lies at a clearance.
pub fn sign_at(map: &mut ProvedMap, clearance: f64) -> Option<Sign> {
    let image = map.image(MapDirection::Forward, Interval::point(clearance));
    if image.lower() > clearance {
        Some(Sign::Above)
    } else if image.upper() < clearance {
        Some(Sign::Below)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::swing::swing;

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
                let end = swing(&node, &start, false).arrived().unwrap().end;
                assert!(end.upper() >= least, "{coefficients:?} {z}: {end} {least}");
            }
        }
    }
}
