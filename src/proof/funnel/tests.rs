//! Time and area of stiff swings: compared with a first integral, with swings enclosed by steps, in other
//! units, and for intervals of coefficients and starts.

use super::super::swing::swing_past_peak;
use super::*;
use crate::numerics::elementary::exp;

/// The swing from rest, followed to its fall and then continued between the fences.
fn between_fences(field: &Field, start: Interval) -> Swing {
    let funnel = Funnel::new(field, &mut 0).unwrap();
    let fallen = swing_past_peak(field, &StartBox::at_rest(start), funnel.speed());
    let Passage::Exceeds(fallen) = fallen else { panic!("{field:?}: {fallen:?}") };
    funnel.swing_after(field, start, &fallen).unwrap()
}

fn field(coefficients: [f64; 3]) -> Field {
    let [a, b, c] = coefficients.map(Interval::point);
    Field { a, b, c }
}

fn area(swing: &Swing) -> Interval {
    swing.square_in(0)
}

/// With `v^2` alone, and the distance `y` from the start, `v^2 = (l - y - l exp(-2 b y))/b`, `l = z + 1/(2 b)`,
/// once `exp(-2 b l)` is below rounding; the swing ends at `1/(2 b)`. Time and area are integrals of `1/v` and
/// `v` over y.
#[test]
fn a_swing_with_a_first_integral_is_held() {
    const PIECES: u32 = 20_000;
    for (b, z) in [(1.0, 100.0), (3.0, 1000.0), (0.25, 2000.0)] {
        let way: f64 = z + 0.5 / b;
        let (mut time, mut below) = (0.0, 0.0);
        for piece in 0..PIECES {
            // `y = l u^2 (3 - 2 u)` removes the square roots at both ends.
            let u = (f64::from(piece) + 0.5) / f64::from(PIECES);
            let y = way * u * u * (3.0 - 2.0 * u);
            let left = way * (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
            let v = ((left - way * exp(-2.0 * b * y)) / b).sqrt();
            let dy = 6.0 * way * u * (1.0 - u) / f64::from(PIECES);
            (time, below) = (time + dy / v, below + dy * v);
        }
        let found = between_fences(&field([0.0, b, 0.0]), Interval::point(z));
        assert!(found.end.contains(0.5 / b), "{}", found.end);
        assert!(found.end.width() < 1e-3 / b, "{}", found.end);
        for (held, value) in [(found.duration, time), (area(&found), below)] {
            assert!(held.contains(value), "{b} {z}: {held} {value}");
            assert!(held.width() < 0.05 * value, "{b} {z}: {held} {value}");
        }
    }
}

#[test]
fn steps_that_still_get_through_agree_with_the_fences() {
    for (coefficients, z) in [
        ([0.0, 1.0, 0.0], 100.0),
        ([-0.2, 0.3, 0.1], 300.0),
        ([0.5, 0.0, 1.0], 60.0),
        ([-1.0, -0.1, 0.5], 100.0),
    ] {
        let (field, start) = (field(coefficients), Interval::point(z));
        let steps = swing(&field, &StartBox::at_rest(start), false).arrived().unwrap();
        let fences = between_fences(&field, start);
        for (narrow, wide) in [
            (steps.end, fences.end),
            (steps.duration, fences.duration),
            (area(&steps), area(&fences)),
            (steps.divergence, fences.divergence),
        ] {
            assert!(wide.contains(narrow.middle()), "{field:?} {z}: {wide} {narrow}");
        }
    }
}

/// `(v, b, c) -> (v 2^k, b 2^-k, c 2^-2k)` leaves time unchanged to the last bit.
#[test]
fn other_units_change_nothing_but_lengths() {
    let (one, start) = (field([-0.2, 0.3, 0.1]), Interval::point(300.0));
    let here = between_fences(&one, start);
    for k in [-60, 14, 200] {
        let there = between_fences(&one.in_units_of(k), scaled(start, -k));
        assert_eq!(there.duration, here.duration);
        assert_eq!(there.end, scaled(here.end, -k));
        assert_eq!(there.square_in(-k), area(&here));
    }
}

/// Each corner of the box is followed by steps, and its end known to thirteen digits.
#[test]
fn an_interval_of_swings_holds_each_of_them() {
    let around = |value: f64| Interval::around(value, 1e-7 * value.abs());
    let (middle, z) = ([-0.2, 0.3, 0.1], 300.0);
    let [a, b, c] = middle.map(around);
    let all = between_fences(&Field { a, b, c }, around(z));
    let ends = |it: Interval| [it.lower(), it.upper()];
    for a in ends(a) {
        for b in ends(b) {
            for c in ends(c) {
                for z in ends(around(z)) {
                    let start = StartBox::at_rest(Interval::point(z));
                    let one = swing(&field([a, b, c]), &start, false).arrived().unwrap();
                    for (one, all) in
                        [(one.end, all.end), (one.duration, all.duration), (area(&one), area(&all))]
                    {
                        assert!(all.contains(one.middle()), "{a} {b} {c} {z}: {one} {all}");
                    }
                }
            }
        }
    }
}
