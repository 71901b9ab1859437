//! Interval arithmetic against exact and fifty-digit results.

use proptest::prelude::*;

use super::*;
use crate::numerics::elementary::{atan, exp, powi};

/// A number in twice the precision of a double, as a sum of two doubles.
type Long = (f64, f64);

/// Whether the interval contains the number.
fn holds(interval: Interval, (high, low): Long) -> bool {
    (interval.lower < high || (interval.lower == high && low >= 0.0))
        && (interval.upper > high || (interval.upper == high && low <= 0.0))
}

#[test]
fn squares_and_negatives_stay_members() {
    // Both exact squares lie next to their nearest doubles, one above and one below.
    for x in [0.1, 0.3, 1.1, 1.3] {
        let high = x * x;
        let exact = (high, f64::mul_add(x, x, -high));
        for over in [Interval::point(x), Interval::point(-x)] {
            assert!(exact.1 != 0.0 && holds(over.square(), exact), "{x}");
        }
        assert!(Interval::new(-x, x).square().contains(0.0));
        assert!(holds(Interval::new(-0.05, x).square(), exact));
    }
    assert_eq!(-Interval::new(1.0, 2.0), Interval::new(-2.0, -1.0));
}

/// `x`, `exp(x)` and `exp(x) - 1`, each as a sum of two doubles.
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, clippy::approx_constant, reason = "computed to 60 digits")]
const EXPONENTIALS: [(f64, Long, Long); 15] = [
    (0.0, (1.0, 0.0), (0.0, 0.0)),
    (1.0, (2.718281828459045, 1.4456468917292502e-16), (1.7182818284590453, -7.747991575210629e-17)),
    (-1.0, (0.36787944117144233, -1.2428753672788363e-17), (-0.6321205588285577, -1.2428753672788363e-17)),
    (0.1, (1.1051709180756477, -8.149523913327619e-17), (0.10517091807564763, 1.77148771361055e-18)),
    (-0.3, (0.7408182206817179, -1.805530505953e-18), (-0.2591817793182821, -1.805530505953e-18)),
    (1e-12, (1.000000000001, -8.890058184103173e-17), (1.0000000000005e-12, -2.421793960301238e-29)),
    (-1e-300, (1.0, 0.0), (-1e-300, 0.0)),
    (0.5, (1.6487212707001282, -4.731568479435833e-17), (0.6487212707001282, -4.731568479435833e-17)),
    (0.35, (1.4190675485932571, 9.472477310898604e-17), (0.41906754859325723, -1.6297529353529618e-17)),
    (7.3, (1480.299927584545, -4.301777951764024e-14), (1479.299927584545, -4.301777951764024e-14)),
    (-20.25, (1.6052280551856116e-09, -3.657643988865463e-26), (-0.9999999983947719, -6.399639389523864e-18)),
    (300.7, (3.911566412479153e+130, -2.2210200263893878e+114), (3.911566412479153e+130, -2.2210200263893878e+114)),
    (-300.7, (2.556520571425501e-131, -1.9960551202291778e-147), (-1.0, 0.0)),
    (700.0, (1.0142320547350045e+304, 1.6666571920734673e+287), (1.0142320547350045e+304, 1.6666571920734673e+287)),
    (-600.0, (2.6503965530043108e-261, 6.377342817491395e-278), (-1.0, 0.0)),
];

/// `x` and `atan(x)`.
#[rustfmt::skip]
#[expect(clippy::unreadable_literal, clippy::approx_constant, reason = "computed to 60 digits")]
const ARCTANGENTS: [(f64, Long); 10] = [
    (1e-200, (1e-200, 0.0)),
    (0.1, (0.09966865249116204, -5.190520336352787e-18)),
    (0.5, (0.4636476090008061, 2.2698777452961687e-17)),
    (1.0, (0.7853981633974483, 3.061616997868383e-17)),
    (2.0, (1.1071487177940904, 9.40447137356638e-17)),
    (-3.7, (-1.3068326031691921, 7.307937580384312e-17)),
    (1000.0, (1.5697963271282298, -5.443715996974827e-17)),
    (1e+16, (1.5707963267948966, -3.8767660042632344e-17)),
    (1e+200, (1.5707963267948966, 6.123233995736766e-17)),
    (-1e+149, (-1.5707963267948966, -6.123233995736766e-17)),
];

#[test]
fn functions_hold_their_values_and_are_narrow() {
    for (x, exponential, less_one) in EXPONENTIALS {
        let (exp, exp_m1) = (Interval::point(x).exp(), Interval::point(x).exp_m1());
        assert!(holds(exp, exponential) && holds(exp_m1, less_one), "{x}: {exp} {exp_m1}");
        assert!(exp.width() <= 1e-14 * exponential.0, "{x}: {exp}");
        assert!(exp_m1.width() <= 1e-14 * less_one.0.abs() + 2e-323, "{x}: {exp_m1}");
    }
    for (x, value) in ARCTANGENTS {
        let atan = Interval::point(x).atan();
        assert!(holds(atan, value), "{x}: {atan}");
        assert!(atan.width() <= 1e-14 * value.0.abs(), "{x}: {atan}");
    }
    assert!(holds(PI, (std::f64::consts::PI, 1.224_646_799_147_353_2e-16)));
}

#[test]
fn functions_beyond_the_range_of_doubles_are_bounded() {
    assert_eq!(Interval::point(800.0).exp().upper(), f64::INFINITY);
    assert!(Interval::point(800.0).exp().lower() > 1e150);
    let small = Interval::point(-800.0).exp();
    assert!(small.lower() == 0.0 && small.upper() > 0.0 && small.upper() < 1e-300);
    // Near the smallest normal doubles, on both sides of the point where the result is rescaled.
    for x in [-708.0, -708.4, -709.0] {
        let bound = Interval::point(x).exp();
        let above = Interval::point(x + 1.0).exp() * Interval::point(-1.0).exp();
        assert!(bound.lower() <= above.upper() && above.lower() <= bound.upper(), "{x}");
    }
}

#[test]
fn what_is_not_a_number_says_nothing() {
    assert_eq!(Interval::point(f64::INFINITY) * Interval::new(0.0, 1.0), Interval::ALL);
    let nan = Interval::new(f64::NAN, 1.0);
    assert_eq!(nan, Interval::ALL);
    let (zero, all) = (Interval::point(0.0), Interval::ALL);
    assert_eq!(zero * all, all);
    assert_eq!(Interval::point(1.0) / Interval::new(-1.0, 1.0), all);
    assert_eq!(Interval::point(f64::INFINITY) - Interval::point(f64::INFINITY), all);
    assert_eq!(Interval::new(-1.0, 1.0).sqrt().upper(), 1.0_f64.next_up());
    assert_eq!(Interval::new(2.0, 1.0), all);
    assert!(!all.contains(f64::NAN));
}

#[test]
fn overflow_and_underflow_stay_outside() {
    let huge = Interval::point(f64::MAX);
    assert_eq!((huge * huge).upper(), f64::INFINITY);
    assert_eq!((huge * huge).lower(), f64::MAX);
    assert_eq!([huge.twice(), -((-huge).twice())], [Interval::new(f64::MAX, f64::INFINITY); 2]);
    let tiny = Interval::point(f64::MIN_POSITIVE);
    assert!((tiny * tiny).lower() <= 0.0 && (tiny * tiny).upper() > 0.0);
    assert_eq!(tiny.square().lower(), 0.0);
}

/// The exact error of a rounded operation: Dekker's method for a sum, a fused operation for a product.
fn errors(a: f64, b: f64) -> [(Interval, (f64, f64)); 3] {
    let (x, y) = (Interval::point(a), Interval::point(b));
    let exact_sum = |a: f64, b: f64| {
        let sum = a + b;
        let part = sum - a;
        (sum, (a - (sum - part)) + (b - part))
    };
    let product = a * b;
    [
        (x + y, exact_sum(a, b)),
        (x - y, exact_sum(a, -b)),
        (x * y, (product, a.mul_add(b, -product))),
    ]
}

proptest! {
    #[test]
    fn operations_hold_their_exact_results(a in -1e100_f64..1e100, b in -1e100_f64..1e100, k in -300..300_i32) {
        let b = b * powi(2.0, k);
        for (interval, exact) in errors(a, b) {
            prop_assert!(holds(interval, exact), "{a:?} {b:?}: {interval} {exact:?}");
        }
        // A quotient is contained if the products with its bounds lie on both sides of the dividend.
        let quotient = Interval::point(a) / Interval::point(b);
        let back = quotient * Interval::point(b);
        prop_assert!(b == 0.0 || back.contains(a));
        let lower = quotient.lower().mul_add(b, -a) * b.signum();
        let upper = quotient.upper().mul_add(b, -a) * b.signum();
        prop_assert!(b == 0.0 || (lower <= 0.0 && upper >= 0.0));
        let root = Interval::point(a.abs()).sqrt();
        prop_assert!(root.lower().mul_add(root.lower(), -a.abs()) <= 0.0);
        prop_assert!(root.upper().mul_add(root.upper(), -a.abs()) >= 0.0);
    }

    #[test]
    fn members_stay_members(a in -10.0_f64..10.0, b in -10.0_f64..10.0, w in 0.0_f64..3.0, s in 0.0_f64..1.0, t in 0.0_f64..1.0) {
        let (x, y) = (Interval::new(a, a + w), Interval::new(b, b + 0.5 * w));
        let (p, q) = ((a + s * w).min(x.upper()), (b + t * 0.5 * w).min(y.upper()));
        prop_assert!((x + y).contains(p + q) && (x - y).contains(p - q) && (x * y).contains(p * q));
        prop_assert!((x / y).contains(p / q) && x.square().contains(p * p));
        prop_assert!(x.exp().contains(exp(p)) && x.atan().contains(atan(p)));
        let cubic = [1.0, -2.0, 0.5, 0.25].map(Interval::point);
        prop_assert!(x.polynomial(&cubic).contains(1.0 + p * (-2.0 + p * (0.5 + p * 0.25))));
        prop_assert!(x.contains(x.middle()) && x.radius() >= x.upper() - x.middle());
    }
}
