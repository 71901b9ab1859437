//! Intervals with outward rounding, in safe stable Rust.
//!
//! Rust rounds every `+ - * /` and `sqrt` to the nearest double (IEEE 754), so the exact result lies strictly
//! within one unit in the last place of the computed one, and the next doubles below and above enclose it. This
//! also holds where the result is subnormal or overflows (the double below infinity is the largest finite one,
//! which an overflowing exact result exceeds). A bound that is NaN carries no information and becomes infinite.
//! Thus the result of every operation here contains all exact results for all members of its operands. The
//! functions at the end bound the remainder of a series in the same arithmetic.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;
use serde::Serialize;

/// All numbers between two doubles, both included; a bound may be infinite. It is written as `[lower, upper]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(into = "[f64; 2]")]
pub struct Interval {
    lower: f64,
    upper: f64,
}

/// The number pi; the nearest double is below it.
pub const PI: Interval = Interval { lower: std::f64::consts::PI, upper: 3.141_592_653_589_793_6 };

/// Upper 32 bits of `ln 2`; products with integers below `2^20` are exact.
const LN_2_HIGH: f64 = f64::from_bits(0x3fe6_2e42_fee0_0000);

/// `ln 2 - LN_2_HIGH = 1.908_214_929_270_587_816..e-10`.
const LN_2_LOW: Interval =
    Interval { lower: 1.908_214_929_270_587e-10, upper: 1.908_214_929_270_588e-10 };

impl Interval {
    /// All numbers: the result of an operation that has no meaningful one.
    pub const ALL: Interval = Interval { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// The numbers from `lower` to `upper`; all numbers if the bounds are out of order or NaN.
    pub const fn new(lower: f64, upper: f64) -> Self {
        if lower <= upper {
            Interval { lower, upper }
        } else {
            Interval::ALL
        }
    }

    /// One double.
    pub const fn point(value: f64) -> Self {
        Interval::new(value, value)
    }

    /// The numbers within `radius` of `middle`.
    pub fn around(middle: f64, radius: f64) -> Self {
        if radius == 0.0 {
            return Interval::point(middle);
        }
        let (lower, upper) = (middle - radius, middle + radius);
        let Interval { lower: below, upper: above } = Interval::outward(lower, upper);
        // A sum that is 0 is exact.
        let or_zero = |sum: f64, beyond: f64| if sum == 0.0 { 0.0 } else { beyond };
        Interval::new(or_zero(lower, below), or_zero(upper, above))
    }

    /// The interval one double beyond each of two rounded bounds.
    #[inline]
    fn outward(lower: f64, upper: f64) -> Self {
        let lower = if lower.is_nan() {
            f64::NEG_INFINITY
        } else {
            lower.next_down()
        };
        let upper = if upper.is_nan() {
            f64::INFINITY
        } else {
            upper.next_up()
        };
        Interval::new(lower, upper)
    }

    /// Lower bound.
    pub const fn lower(self) -> f64 {
        self.lower
    }

    /// Upper bound.
    pub const fn upper(self) -> f64 {
        self.upper
    }

    /// A member near the middle; 0 if both bounds are infinite.
    pub fn middle(self) -> f64 {
        let middle = 0.5 * self.lower + 0.5 * self.upper;
        if middle.is_nan() {
            0.0
        } else {
            middle.clamp(self.lower, self.upper)
        }
    }

    /// Upper bound of the distance of any member from [`Interval::middle`].
    pub fn radius(self) -> f64 {
        let middle = self.middle();
        let most = (middle - self.lower).max(self.upper - middle);
        if self.is_point() { 0.0 } else { most.next_up() }
    }

    /// Width, rounded up.
    pub fn width(self) -> f64 {
        if self.is_point() {
            0.0
        } else {
            (self.upper - self.lower).next_up()
        }
    }

    /// All numbers at most `off` from a member.
    pub fn widened(self, off: f64) -> Self {
        Interval::outward(self.lower - off, self.upper + off)
    }

    /// Whether a number is a member.
    pub fn contains(self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }

    /// Whether every member of `self` is a member of `other`.
    pub fn is_within(self, other: Self) -> bool {
        other.lower <= self.lower && self.upper <= other.upper
    }

    /// Whether both bounds are finite.
    pub fn is_finite(self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }

    /// Whether the interval is a single double.
    pub fn is_point(self) -> bool {
        self.lower == self.upper
    }

    /// The common members; `None` if there are none.
    pub fn intersection(self, other: Self) -> Option<Self> {
        let (lower, upper) = (self.lower.max(other.lower), self.upper.min(other.upper));
        (lower <= upper).then_some(Interval { lower, upper })
    }

    /// The smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Interval { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    /// The largest magnitude of a member.
    pub fn magnitude(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    /// All squares of members.
    pub fn square(self) -> Self {
        let (one, other) = (self.lower * self.lower, self.upper * self.upper);
        let smallest = if self.contains(0.0) {
            0.0
        } else {
            one.min(other).next_down()
        };
        Interval::new(smallest.max(0.0), one.max(other).next_up())
    }

    /// Square roots of all members, none of which may be negative.
    pub fn sqrt(self) -> Self {
        Interval::outward(self.lower.sqrt(), self.upper.sqrt())
    }

    /// Twice the interval; exact unless it overflows, beyond the largest double.
    pub fn twice(self) -> Self {
        Interval::new((2.0 * self.lower).min(f64::MAX), (2.0 * self.upper).max(f64::MIN))
    }

    /// An increasing function of all members.
    fn monotone(self, of: impl Fn(f64) -> Interval) -> Self {
        Interval::new(of(self.lower).lower, of(self.upper).upper)
    }

    /// `exp` of all members.
    pub fn exp(self) -> Self {
        self.monotone(exp)
    }

    /// `ln` of all members, which must be positive.
    pub fn ln(self) -> Self {
        self.monotone(ln)
    }

    /// `exp(x) - 1` of all members.
    pub fn exp_m1(self) -> Self {
        self.monotone(exp_m1)
    }

    /// `atan` of all members.
    pub fn atan(self) -> Self {
        self.monotone(atan)
    }

    /// The polynomial with these coefficients, lowest power first, by Horner's rule.
    pub fn polynomial(self, coefficients: &[Interval]) -> Self {
        coefficients.iter().rev().fold(Interval::point(0.0), |sum, &next| sum * self + next)
    }
}

/// `exp(value)`.
///
/// With `n` the integer nearest to `value/ln 2`, `y = value - n ln 2` is at most 0.3466 in magnitude up to
/// rounding of n, and `exp(value) = 2^n exp(y)`. The terms of `exp(y)` of degree 18 and higher sum to less than
/// `0.36^18/18! e^0.36 < 1e-23` for `abs(y) < 0.36`.
fn exp(value: f64) -> Interval {
    const TERMS: u32 = 17;
    const REMAINDER: f64 = 1e-23;
    let turns = (value / std::f64::consts::LN_2).round();
    if value.is_nan() {
        return Interval::ALL;
    }
    if turns > 1020.0 {
        return Interval::new(f64::MAX.sqrt(), f64::INFINITY);
    }
    if turns < -1022.0 {
        return Interval::new(0.0, f64::MIN_POSITIVE);
    }
    let high = Interval::point(turns * LN_2_HIGH);
    let y = Interval::point(value) - high - LN_2_LOW * turns;
    if !(y.magnitude() < 0.36) {
        return Interval::ALL;
    }
    let sum = nested(y, 1, TERMS).widened(REMAINDER);
    #[expect(clippy::cast_possible_truncation, reason = "a whole number in -1022 ..= 1020")]
    let biased = (turns as i64 + 1023).unsigned_abs();
    sum * f64::from_bits(biased << 52)
}

/// `ln(value)`. With y near it, `r = value exp(-y)` is near 1, and `ln(value) - y = ln(r)` is between `1 - 1/r`
/// and `r - 1`.
fn ln(value: f64) -> Interval {
    if !(value > f64::MIN_POSITIVE && value < f64::INFINITY) {
        return Interval::ALL;
    }
    let y = elementary::ln(value);
    let one = Interval::point(1.0);
    let ratio = exp(-y) * value;
    let off = Interval::new((one - one / ratio).lower, (ratio - one).upper);
    off + y
}

/// `exp(value) - 1`. Up to 1/2 by its own series; its terms of degree 19 and higher sum to less than
/// `0.5^18/19! e^0.5 < 1e-22` of the first term.
fn exp_m1(value: f64) -> Interval {
    const REMAINDER: f64 = 1e-22;
    if !(value.abs() <= 0.5) {
        return exp(value) - 1.0;
    }
    let y = Interval::point(value);
    y * nested(y, 2, 18).widened(REMAINDER)
}

/// `1 + y/first (1 + y/(first + 1) (1 + ... (1 + y/last)))`, parts of the series of the exponential.
fn nested(y: Interval, first: u32, last: u32) -> Interval {
    let one = Interval::point(1.0);
    (first..=last).rev().fold(one, |sum, k| one + y * sum / f64::from(k))
}

/// `atan(value)`. Halving three times by `atan(x) = 2 atan(x/(1 + sqrt(1 + x^2)))` brings the argument within
/// `tan(pi/16) < 0.199`. The error of the alternating series is then less than its first omitted term, which is
/// below `0.199^30/31 < 1e-22` of the argument.
fn atan(value: f64) -> Interval {
    const REMAINDER: f64 = 1e-22;
    if value.is_nan() {
        return Interval::ALL;
    }
    if value.abs() > 1e150 {
        // pi/2 - atan(1/x), with 0 < atan(1/x) < 1e-150.
        let right = Interval::outward(PI.lower / 2.0, PI.upper / 2.0);
        return if value > 0.0 { right } else { -right };
    }
    let one = Interval::point(1.0);
    let mut y = Interval::point(value);
    for _ in 0..3 {
        y = y / (one + (one + y.square()).sqrt());
    }
    let (square, mut sum, mut odd) = (y.square(), Interval::point(0.0), 29.0);
    for _ in 0..15 {
        sum = one / odd - square * sum;
        odd -= 2.0;
    }
    y * sum.widened(REMAINDER) * 8.0
}

impl Neg for Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval { lower: -self.upper, upper: -self.lower }
    }
}

/// Makes an operation of two intervals, and that with a double as the other operand, exact as given.
macro_rules! operation {
    ($operation:ident $method:ident: $of:ident) => {
        impl $operation for Interval {
            type Output = Interval;

            #[inline]
            fn $method(self, other: Interval) -> Interval {
                $of(self, other)
            }
        }

        impl $operation<f64> for Interval {
            type Output = Interval;

            fn $method(self, other: f64) -> Interval {
                $of(self, Interval::point(other))
            }
        }
    };
}

operation!(Add add: sum);
operation!(Sub sub: difference);
operation!(Mul mul: product);
operation!(Div div: quotient);

fn sum(one: Interval, other: Interval) -> Interval {
    Interval::outward(one.lower + other.lower, one.upper + other.upper)
}

fn difference(one: Interval, other: Interval) -> Interval {
    Interval::outward(one.lower - other.upper, one.upper - other.lower)
}

fn product(one: Interval, other: Interval) -> Interval {
    extremes(one, other, |a, b| a * b)
}

fn quotient(one: Interval, other: Interval) -> Interval {
    if other.contains(0.0) {
        Interval::ALL
    } else {
        extremes(one, other, |a, b| a / b)
    }
}

/// The outward hull of the rounded results of an operation on the bounds. Since `min` and `max` ignore NaN, it is tested
/// for first.
#[inline]
fn extremes(one: Interval, other: Interval, of: impl Fn(f64, f64) -> f64) -> Interval {
    let (a, b) = (of(one.lower, other.lower), of(one.lower, other.upper));
    let (c, d) = (of(one.upper, other.lower), of(one.upper, other.upper));
    if a.is_nan() || b.is_nan() || c.is_nan() || d.is_nan() {
        return Interval::ALL;
    }
    Interval::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
}

impl PartialEq<f64> for Interval {
    fn eq(&self, other: &f64) -> bool {
        *self == Interval::point(*other)
    }
}

impl PartialOrd<f64> for Interval {
    /// What is certain of all members, where they are not equal: that they are less, or greater.
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        match (self.lower > *other, self.upper < *other) {
            (true, _) => Some(Ordering::Greater),
            (_, true) => Some(Ordering::Less),
            _ => (self == other).then_some(Ordering::Equal),
        }
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "[{:?}, {:?}]", self.lower, self.upper)
    }
}

impl From<Interval> for [f64; 2] {
    fn from(of: Interval) -> Self {
        [of.lower, of.upper]
    }
}

#[cfg(test)]
mod tests {
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
}
