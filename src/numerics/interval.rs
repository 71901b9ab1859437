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

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;
use serde::ser::{Serialize, SerializeTuple, Serializer};

/// All numbers between two doubles, both included; a bound may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
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
        if lower <= upper { Interval { lower, upper } } else { Interval::ALL }
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
    fn outward(lower: f64, upper: f64) -> Self {
        let lower = if lower.is_nan() { f64::NEG_INFINITY } else { lower.next_down() };
        let upper = if upper.is_nan() { f64::INFINITY } else { upper.next_up() };
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
        if middle.is_nan() { 0.0 } else { middle.clamp(self.lower, self.upper) }
    }

    /// Upper bound of the distance of any member from [`Interval::middle`].
    pub fn radius(self) -> f64 {
        let middle = self.middle();
        if self.lower == self.upper {
            return 0.0;
        }
        (middle - self.lower).max(self.upper - middle).next_up()
    }

    /// Width, rounded up.
    pub fn width(self) -> f64 {
        if self.lower == self.upper { 0.0 } else { (self.upper - self.lower).next_up() }
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
        let smallest = if self.contains(0.0) { 0.0 } else { one.min(other).next_down() };
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

    /// `exp` of all members.
    pub fn exp(self) -> Self {
        Interval::new(exp(self.lower).lower, exp(self.upper).upper)
    }

    /// `ln` of all members, which must be positive.
    pub fn ln(self) -> Self {
        Interval::new(ln(self.lower).lower, ln(self.upper).upper)
    }

    /// `exp(x) - 1` of all members.
    pub fn exp_m1(self) -> Self {
        Interval::new(exp_m1(self.lower).lower, exp_m1(self.upper).upper)
    }

    /// `atan` of all members.
    pub fn atan(self) -> Self {
        Interval::new(atan(self.lower).lower, atan(self.upper).upper)
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
    const TERMS: usize = 18;
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
    let y = Interval::point(value) - high - Interval::point(turns) * LN_2_LOW;
    if !(y.magnitude() < 0.36) {
        return Interval::ALL;
    }
    let (mut sum, mut k) = (Interval::point(1.0), 17.0);
    for _ in 1..TERMS {
        sum = Interval::point(1.0) + y * sum / Interval::point(k);
        k -= 1.0;
    }
    sum = sum + Interval::new(-REMAINDER, REMAINDER);
    #[expect(clippy::cast_possible_truncation, reason = "a whole number in -1022 ..= 1020")]
    let biased = (turns as i64 + 1023).unsigned_abs();
    sum * Interval::point(f64::from_bits(biased << 52))
}

/// `ln(value)`. With y near it, `r = value exp(-y)` is near 1, and `ln(value) - y = ln(r)` is between `1 - 1/r`
/// and `r - 1`.
fn ln(value: f64) -> Interval {
    if !(value > f64::MIN_POSITIVE && value < f64::INFINITY) {
        return Interval::ALL;
    }
    let y = elementary::ln(value);
    let one = Interval::point(1.0);
    let ratio = Interval::point(value) * exp(-y);
    let off = Interval::new((one - one / ratio).lower, (ratio - one).upper);
    Interval::point(y) + off
}

/// `exp(value) - 1`. Up to 1/2 by its own series; its terms of degree 19 and higher sum to less than
/// `0.5^18/19! e^0.5 < 1e-22` of the first term.
fn exp_m1(value: f64) -> Interval {
    const REMAINDER: f64 = 1e-22;
    if !(value.abs() <= 0.5) {
        return exp(value) - Interval::point(1.0);
    }
    let (y, mut sum, mut k) = (Interval::point(value), Interval::point(1.0), 18.0);
    for _ in 0..17 {
        sum = Interval::point(1.0) + y * sum / Interval::point(k);
        k -= 1.0;
    }
    y * (sum + Interval::new(-REMAINDER, REMAINDER))
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
        sum = one / Interval::point(odd) - square * sum;
        odd -= 2.0;
    }
    y * (sum + Interval::new(-REMAINDER, REMAINDER)) * Interval::point(8.0)
}

impl Neg for Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval { lower: -self.upper, upper: -self.lower }
    }
}

impl Add for Interval {
    type Output = Interval;

    fn add(self, other: Interval) -> Interval {
        Interval::outward(self.lower + other.lower, self.upper + other.upper)
    }
}

impl Sub for Interval {
    type Output = Interval;

    fn sub(self, other: Interval) -> Interval {
        Interval::outward(self.lower - other.upper, self.upper - other.lower)
    }
}

impl Mul for Interval {
    type Output = Interval;

    fn mul(self, other: Interval) -> Interval {
        extremes([
            self.lower * other.lower,
            self.lower * other.upper,
            self.upper * other.lower,
            self.upper * other.upper,
        ])
    }
}

impl Div for Interval {
    type Output = Interval;

    fn div(self, other: Interval) -> Interval {
        if other.contains(0.0) {
            return Interval::ALL;
        }
        extremes([
            self.lower / other.lower,
            self.lower / other.upper,
            self.upper / other.lower,
            self.upper / other.upper,
        ])
    }
}

/// Operations with a double as the other operand, exact as given.
macro_rules! with_a_double {
    ($($operation:ident $method:ident),*) => {$(
        impl $operation<f64> for Interval {
            type Output = Interval;

            fn $method(self, other: f64) -> Interval {
                $operation::$method(self, Interval::point(other))
            }
        }
    )*};
}

with_a_double!(Add add, Sub sub, Mul mul, Div div);

/// The outward hull of four rounded results. Since `min` and `max` ignore NaN, it is tested for first.
fn extremes(results: [f64; 4]) -> Interval {
    if results.iter().any(|result| result.is_nan()) {
        return Interval::ALL;
    }
    let [a, b, c, d] = results;
    Interval::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
}

impl fmt::Display for Interval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "[{:?}, {:?}]", self.lower, self.upper)
    }
}

impl Serialize for Interval {
    /// As `[lower, upper]`.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut pair = serializer.serialize_tuple(2)?;
        pair.serialize_element(&self.lower)?;
        pair.serialize_element(&self.upper)?;
        pair.end()
    }
}

#[cfg(test)]
mod tests;
