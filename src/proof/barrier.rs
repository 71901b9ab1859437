//! Barriers: curves that motions cross one way only, and what they say about swings that cannot be computed,
//! because they start next to a node or arbitrarily far out.

use super::field::Field;
use super::swing::{Start, swing};
use crate::numerics::Interval;

/// Lower bound of where swings that start next to the centre end, for `a <= -2`: there the centre is a
/// node that repels, and every swing, however small, leaves its neighbourhood along the steep direction (lemma 10).
///
/// With `k = 2 abs(b) + 1` motions cross the parabola `v = x - k x^2` upwards as long as
/// `x (2 k^2 + abs(c)) <= k - abs(b)`, and those from next to the centre begin above it.
#[must_use]
pub fn least_end(field: &Field) -> f64 {
    /// A part of the largest point, so that the motion forgets where it was begun.
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
    let start = Start { x: at, v: Interval::point(v.lower()) };
    swing(&field.strongest(), &start, false).arrived().map_or(0.0, |swing| swing.end.lower())
}

/// Upper bound of where all swings end, however far out they start; infinite where there is none.
pub fn greatest_end(field: &Field, swings: &mut u32) -> f64 {
    /// Where the barriers are left, in units of the length that goes with the damping.
    const LEAVES: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
    let field = field.weakest();
    let [a, b, c] = [field.a, field.b, field.c].map(Interval::lower);
    if c < 0.0 || (c == 0.0 && b <= 0.0) {
        return f64::INFINITY;
    }
    let mut best = f64::INFINITY;
    for leave in LEAVES {
        let starts = [cubic_barrier([a, b, c], leave), square_barrier([a, b], leave)];
        for start in starts.into_iter().flatten() {
            *swings += 1;
            let swing = swing(&field, &start, false).arrived();
            best = best.min(swing.map_or(f64::INFINITY, |swing| swing.end.upper()));
        }
        if best < f64::INFINITY && leave >= 2.0 {
            break;
        }
    }
    best
}

/// A point above every motion, by the barrier `U(x) = S + 2/(c (x + 2 R))` over `-2 R < x <= -R` (lemma 11).
///
/// Motions cross it downwards if `c S^3 + b S^2 + a S >= 2 R`, `3 c S^2 + 2 b S + a >= 0` and
/// `(5/2) c S + b >= 0`.
fn cubic_barrier([a, b, c]: [f64; 3], leave: f64) -> Option<Start> {
    let r = leave / c.sqrt();
    if !(c > 0.0 && r.is_finite() && r > 0.0) {
        return None;
    }
    let [pa, pb, pc, pr] = [a, b, c, r].map(Interval::point);
    let two = Interval::point(2.0);
    let mut s = (2.0 * r / c).cbrt();
    for _ in 0..400 {
        let at = Interval::point(s);
        let value = at * (pa + at * (pb + at * pc)) - two * pr;
        let slope = pa + at * (two * pb + at * pc * Interval::point(3.0));
        let bend = at * pc * Interval::point(2.5) + pb;
        if [value, slope, bend].iter().all(|it| it.lower() >= 0.0) {
            let v = at + two / (pc * pr);
            return Some(Start { x: -pr, v: Interval::point(v.upper()) });
        }
        s *= 1.05;
    }
    None
}

/// The same for `b > 0`, `c >= 0` by the barrier `U(x)^2 = -2 x/b + (a^2 + 2)/b^2` (lemma 12).
fn square_barrier([a, b]: [f64; 2], leave: f64) -> Option<Start> {
    let r = leave / b;
    if !(b > 0.0 && r.is_finite() && r > 0.0) {
        return None;
    }
    let [pa, pb, pr] = [a, b, r].map(Interval::point);
    let two = Interval::point(2.0);
    let v = (two * pr / pb + (pa.square() + two) / pb.square()).sqrt();
    v.is_finite().then(|| Start { x: -pr, v: Interval::point(v.upper()) })
}
