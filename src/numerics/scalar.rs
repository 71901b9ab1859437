//! The numbers in which a motion is computed: doubles, or pairs of them with twice the digits.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Twofold, real, reciprocals, times_power};

/// Counts by which one divides without a division.
const COUNTS: usize = 64;

/// `1/k`.
const INVERSE: [f64; COUNTS] = reciprocals();

/// A number in which a motion is computed.
pub trait Scalar:
    Copy
    + Debug
    + Default
    + PartialOrd
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The part of a length whose own error may be a millionth and still matters to no digit of the length.
    const NEGLIGIBLE: f64;

    /// Steps of Newton's method that make a root known to the digits of a double one to all digits.
    const POLISHING: usize;

    /// Rounded to a double.
    fn value(self) -> f64;

    /// `self * 2^power`.
    fn times_power(self, power: i32) -> Self;

    /// The quotient by a count below 64 that is not 0.
    fn over_count(self, count: usize) -> Self;
}

impl Scalar for f64 {
    const NEGLIGIBLE: f64 = 1e-12;
    const POLISHING: usize = 0;

    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn times_power(self, power: i32) -> Self {
        times_power(self, power)
    }

    #[inline]
    fn over_count(self, count: usize) -> Self {
        self * INVERSE[count]
    }
}

impl Scalar for Twofold {
    const NEGLIGIBLE: f64 = 1e-27;
    const POLISHING: usize = 2;

    fn value(self) -> f64 {
        Twofold::value(self)
    }

    fn times_power(self, power: i32) -> Self {
        Twofold { high: times_power(self.high, power), low: times_power(self.low, power) }
    }

    fn over_count(self, count: usize) -> Self {
        self / Twofold::from(real(count))
    }
}
