//! Bounds of steps, fences and arrivals in cases where they are sharp or nearly so.

use super::*;
use crate::numerics::elementary::{atan, exp, hypot, sin_cos};

fn field(coefficients: [f64; 3]) -> Field {
    Field::new(coefficients.map(point), 0.0)
}

fn disc(x: f64, v: f64, radius: f64) -> Disc {
    Disc { centre: [x, v], radius, time: point(0.0), damping: point(0.0) }
}

fn stepped(field: &Field, disc: &Disc, h: f64) -> Option<Disc> {
    disc.step(field, &field.series(disc.centre.map(point)), h)
}

/// A velocity displacement of a linear swing after the time h.
fn displaced(a: f64, h: f64) -> f64 {
    let half = a / 2.0;
    let root = (half * half - 1.0).sqrt();
    let [fast, slow] = [root - half, -root - half];
    let (one, other) = (exp(fast * h), exp(slow * h));
    hypot(one - other, fast * one - slow * other) / (fast - slow)
}

/// Motions of a rotation keep their distance; where a fast direction repels they separate at the maximum rate.
#[test]
fn a_disc_grows_as_its_motions_part() {
    let rotation = field([0.0; 3]);
    for radius in [1e-9, 1e-3, 0.1] {
        let after = stepped(&rotation, &disc(-1.0, 0.5, radius), 0.1).unwrap().radius;
        assert!(after >= radius && after < radius + 1e-14, "{radius} {after}");
    }
    for (a, h) in [(-10.0, 0.05), (-40.0, 0.012)] {
        let after = stepped(&field([a, 0.0, 0.0]), &disc(-1.0, 1.0, 1e-3), h).unwrap().radius;
        let parted = 1e-3 * displaced(a, h);
        assert!(after >= parted && after < 1.001 * parted, "{a}: {after} {parted}");
    }
}

/// Motions under different damping separate; the disc contains both, and its radius is their difference in velocity.
#[test]
fn a_disc_holds_the_motions_of_all_coefficients() {
    let wide = Field::new([Interval::new(0.9, 1.1), point(0.0), point(0.0)], 0.0);
    let h = 0.01;
    let after = stepped(&wide, &disc(0.0, 1.0, 0.0), h).unwrap();
    let velocity = |a: f64| {
        let root = (1.0 - a * a / 4.0).sqrt();
        let (sine, cosine) = sin_cos(root * h);
        exp(-a * h / 2.0) * (cosine - a / (2.0 * root) * sine)
    };
    let apart = velocity(0.9) - velocity(1.1);
    assert!(2.0 * after.radius >= apart && 2.0 * after.radius < 1.05 * apart, "{}", after.radius);
    assert!([0.9, 1.1].iter().all(|&a| after.square()[1].contains(velocity(a))));
}

/// With `v' = B v^2 - 1` the integral of `f' = -2 B v` is `2 ln(cosh t - sqrt(B) v sinh t)` at the time
/// `t/sqrt(B)`, except for the motion of x, a relative `1e-18`. Over this step the error of the polynomial
/// alone is `4e-15`, four times its rounding error.
#[test]
fn a_step_holds_what_its_polynomial_leaves_out() {
    /// For `t = 0.0245`, `sqrt(B) v = 10`: the double nearest to -0.5613450494823475487, computed with 40 digits.
    const EXACT: f64 = -0.561_345_049_482_347_5;
    let root = 1e9;
    let fast = field([0.0, -root * root, 0.0]);
    let after = stepped(&fast, &disc(1.0, 1e-8, 0.0), 0.0245 / root).unwrap();
    assert!(after.damping.contains(EXACT), "{}", after.damping);
}

/// Of the motions around the centre, some turn one way and some the other within any time.
#[test]
fn motions_that_may_turn_both_ways_are_not_carried() {
    let rotation = field([0.0; 3]);
    assert!(stepped(&rotation, &disc(0.0, 0.05, 0.1), 0.1).is_none());
    assert!(stepped(&rotation, &disc(0.0, 0.5, 0.1), 0.1).is_some());
    assert!(stepped(&rotation, &disc(0.5, 0.05, 0.1), 0.1).is_some());
}

/// Motions not yet at rest, or at rest before, arrive further out and at another time; the closed form is a spiral.
#[test]
fn an_arrival_holds_what_is_left_of_the_way() {
    for a in [-0.4, 0.0, 0.6] {
        for v in [1e-3, -1e-3] {
            let found = disc(1.0, v, 0.0).end(&field([a, 0.0, 0.0])).unwrap();
            let root = (1.0 - a * a / 4.0).sqrt();
            let time = atan(root * v / (1.0 + a * v / 2.0)) / root;
            let end = exp(-a * time / 2.0) * hypot(root, v + a / 2.0);
            for (what, found, exact, slack) in [
                ("end", found.end, end, 2.5 * 0.5e-6),
                ("time", found.time, time, 1.2e-3),
                ("damping", found.damping, a * time, 1.2e-3 * a.abs()),
            ] {
                assert!(found.contains(exact), "{a} {v} {what}: {found} {exact}");
                assert!(found.radius() <= slack + 1e-15, "{a} {v} {what}: {found}");
            }
        }
    }
}

/// All motions of a linear node from far out follow its slow line, on which `x = -v/lambda`,
/// `lambda^2 - a lambda + 1 = 0`. For `a = 2` this line passes the right end of the piece.
#[test]
fn the_piece_of_a_fence_reaches_to_the_slow_line() {
    let (a, e) = (2.001, 0.3);
    let fence = |a: f64| Field::new([a, 1e-9, 0.0].map(point), e).fence;
    let [_, piece] = fence(a).unwrap();
    let slow = (a - f64::sqrt(a * a - 4.0)) / 2.0;
    let at = -e / slow;
    assert!(piece.contains(at) && piece.upper() - at < 0.07 * piece.width(), "{piece} {at}");
    assert!(piece.contains(-a * e));
    // For smaller damping there is no fence.
    assert!(fence(1.999).is_none());
}

/// From `v = 0` at `-m` on, `P` is `(v - 1)^2 + m - 1` for `a = 0`, `b = -1`. Where it is negative somewhere,
/// nothing is claimed.
#[test]
fn what_never_returns_is_told_from_what_may() {
    for (coefficients, place, never) in [
        ([0.0, -1.0, 0.0], [-1.001, 0.0], true),
        ([0.0, -1.0, 0.0], [-0.98, 0.0], false),
        ([0.0, -1.0, 0.0], [-0.501, 0.5], true),
        ([0.0, -1.0, 0.0], [-0.48, 0.5], false),
        // `m - 0.05 v + 0.001 v^2`, at least `m - 0.625`.
        ([-1.95, -0.001, 0.0], [-0.63, 0.0], true),
        ([-1.95, -0.001, 0.0], [-0.62, 0.0], false),
        // `P = m - 2.1756.. + (v - 1.475)^2`, `m = 1 - x`.
        ([0.95, -1.0, 0.0], [-1.18, 1.0], true),
        ([0.95, -1.0, 0.0], [-1.17, 1.0], false),
        ([0.95, -1.0, 0.0], [-1.1, 1.0], false),
        // The centre is at rest, and cubic damping brings every motion back.
        ([-3.0, -1.0, 0.0], [0.0, 0.0], false),
        ([-3.0, -1.0, 1e-9], [-1.0, 0.0], false),
    ] {
        let found = field(coefficients).never_returns(place.map(point));
        assert_eq!(found, never, "{coefficients:?} {place:?}");
    }
}

/// Next to a node every swing, however near to the centre it starts, ends beyond the common bound. A spiral has
/// no such bound.
#[test]
fn swings_from_next_to_a_node_end_beyond_their_bound() {
    for coefficients in [[-2.0, 0.5, 1.0], [-2.2, -0.5, 1.0], [-2.5, 0.0, 3.0]] {
        let node = field(coefficients);
        let least = node.least().lower();
        assert!(least > 0.0, "{coefficients:?}");
        for z in [1e-9, 1e-5, 1e-3, 0.1] {
            let end = node.swing(point(z), 0.0).end;
            assert!(end.is_finite() && end.upper() >= least, "{coefficients:?} {z}: {end} {least}");
        }
    }
    assert!(field([-1.95, 0.5, 1.0]).least() == Interval::ALL);
}
