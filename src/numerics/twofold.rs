//! Numbers of twice the working precision, for the few places where a difference is critical.
//!
//! A [`Twofold`] is the unevaluated sum of two doubles. It represents a frequency `sqrt(1 - D^2)` near
//! `abs(D) = 1`, an exponent of several thousand, or a discriminant near zero without loss, so that what is
//! derived from them is accurate to the last digits of a double (T. J. Dekker, *A floating-point technique for
//! extending the available precision*, Numerische Mathematik 18, 1971).

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{exp, exp_m1, sin_cos};

/// The sum `high + low`, where `low` is at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Twofold {
    /// The sum rounded to a double.
    pub high: f64,
    /// The rounding error of `high`.
    pub low: f64,
}

/// The number pi.
pub const PI: Twofold = Twofold { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

/// Relative error of one operation of [`Twofold`], rounded up generously.
#[cfg(test)]
pub const UNIT: f64 = 1e-31;

impl Twofold {
    /// `a + b` without error.
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_part = high - a;
        Twofold { high, low: (a - (high - b_part)) + (b - b_part) }
    }

    /// `a * b` without error, barring overflow and underflow.
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Twofold { high, low: a.mul_add(b, -high) }
    }

    /// `abs(1 - d^2)`, accurate to all digits however near `abs(d)` is to 1.
    pub fn from_one_minus_square(d: f64) -> Self {
        let exact = Self::product(d, d).one_minus();
        if exact.high < 0.0 { -exact } else { exact }
    }

    /// `1 - self`.
    pub fn one_minus(self) -> Self {
        let difference = Self::sum(1.0, -self.high);
        Self::sum(difference.high, difference.low - self.low)
    }

    /// The product with a double.
    pub fn times(self, factor: f64) -> Self {
        let product = Self::product(self.high, factor);
        Self::sum(product.high, self.low.mul_add(factor, product.low))
    }

    /// The square root; the number must not be negative.
    pub fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::default();
        }
        let rest = root.mul_add(-root, self.high) + self.low;
        Self::sum(root, rest / (2.0 * root))
    }

    /// The exponential as a double, accurate to its last digits even for large exponents.
    pub fn exp(self) -> f64 {
        let value = exp(self.high);
        if value.is_finite() {
            value.mul_add(self.low, value)
        } else {
            value
        }
    }

    /// `exp(self) - 1` as a double.
    pub fn exp_m1(self) -> f64 {
        let value = exp_m1(self.high);
        if value.is_finite() {
            (value + 1.0).mul_add(self.low, value)
        } else {
            value
        }
    }

    /// `(sin, cos)` as doubles.
    pub fn sin_cos(self) -> (f64, f64) {
        let (sin, cos) = sin_cos(self.high);
        (cos.mul_add(self.low, sin), sin.mul_add(-self.low, cos))
    }

    /// The number rounded to a double.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

impl From<f64> for Twofold {
    fn from(value: f64) -> Self {
        Twofold { high: value, low: 0.0 }
    }
}

impl Add for Twofold {
    type Output = Self;

    /// The sum, accurate to its last digits even under cancellation.
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let middle = Self::sum(high.high, high.low + low.high);
        Self::sum(middle.high, middle.low + low.low)
    }
}

impl Sub for Twofold {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        Self::sum(product.high, product.low + cross)
    }
}

impl Div for Twofold {
    type Output = Self;

    /// The quotient; the divisor must not be zero.
    fn div(self, divisor: Self) -> Self {
        let first = self.high / divisor.high;
        let back = divisor.times(first);
        let rest = (self.high - back.high) + (self.low - back.low);
        Self::sum(first, rest / divisor.high)
    }
}

impl Neg for Twofold {
    type Output = Self;

    fn neg(self) -> Self {
        Twofold { high: -self.high, low: -self.low }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::exp;

    #[test]
    fn one_minus_a_square_keeps_all_digits_next_to_one() {
        for ulps in [1, 2, 3, 1000] {
            let step = f64::EPSILON / 2.0;
            let gap = step * f64::from(ulps);
            // 1 - (1 - g)^2 = 2 g - g^2, both terms exact here.
            let got = Twofold::from_one_minus_square(-(1.0 - gap));
            assert_eq!((got.high - 2.0 * gap) + (got.low + gap * gap), 0.0, "{ulps}");
        }
    }

    #[test]
    fn sine_of_pi_is_zero_to_thirty_digits() {
        assert!(PI.sin_cos().0.abs() < 1e-31);
        assert_eq!(PI.sin_cos().1, -1.0);
    }

    #[test]
    fn a_large_exponent_costs_no_digits() {
        // e^700 to twenty digits; rounding 700.1 to a double would alone cost three of them.
        let exponent = Twofold::product(700.1, 1.0);
        assert_eq!(exponent.exp(), exp(700.1));
        let split = Twofold::sum(700.0, 0.1);
        let expected = exp(700.0) * exp(0.1);
        assert!((split.exp() / expected - 1.0).abs() < 3.0 * f64::EPSILON);
    }

    proptest! {
        #[test]
        fn quotients_and_roots_give_back_what_they_came_from(a in 1e-3..1e3, b in 1e-3..1e3) {
            let (a, b): (f64, f64) = (a, b);
            let back = (Twofold::from(a) / Twofold::from(b)).times(b);
            prop_assert!(((back.high - a) + back.low).abs() <= 4.0 * UNIT * a);
            let root = Twofold::from(a).sqrt();
            let square = root * root;
            prop_assert!(((square.high - a) + square.low).abs() <= 8.0 * UNIT * a);
        }
    }
}
