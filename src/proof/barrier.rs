//! Barriers: curves that motions cross one way only. They bound swings that cannot be computed because they
//! start next to a node or arbitrarily far out.

use super::field::Field;
use super::funnel::Funnel;
use super::swing::{StartBox, swing_below};
use crate::numerics::Interval;

/// Lower bound of the ends of swings that start next to the centre, for `a <= -2`. The centre is then a
/// repelling node, and every swing, however small, leaves its neighbourhood along the steep direction (lemma 10).
///
/// With `k = 2 abs(b) + 1` motions cross the parabola `v = x - k x^2` upwards as long as
/// `x (2 k^2 + abs(c)) <= k - abs(b)`, and those from next to the centre start above it.
pub fn least_end(field: &Field, funnel: Option<&Funnel>) -> f64 {
    /// Fraction of the largest admissible point at which the motion is started, so that its exact start does
    /// not matter.
    const NEAR: f64 = 1e-3;
    let [b, c] = [field.b, field.c].map(|it| Interval::point(it.magnitude()));
    let two = Interval::point(2.0);
    let k = Interval::point(2.0 * b.upper() + 1.0);
    let bound = (k - b) / (two * k.square() + c);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::swing::swing;

    /// However near to the centre a swing starts, it ends beyond the common bound.
    #[test]
    fn swings_from_next_to_a_node_end_beyond_their_bound() {
        for coefficients in [[-2.0, 0.5, 1.0], [-2.2, -0.5, 1.0], [-2.5, 0.0, 3.0]] {
            let [a, b, c] = coefficients.map(Interval::point);
            let node = Field { a, b, c };
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
