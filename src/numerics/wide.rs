//! Numbers with the precision of a double and a far wider range.
//!
//! Amplitudes of the harmonic approximation are products and roots of parameters, whose intermediate values
//! overflow long before the result does (`r^2 D3` at `r = 1e-300`). With a separate exponent, only the result
//! can overflow. A factor that is a power of two changes only the exponent, so the scaling symmetry of the
//! oscillator holds to the last bit.

use crate::numerics::elementary::cbrt;
use crate::numerics::scaling::{exponent, times_power};

/// The number `mantissa * 2^exponent`, positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide {
    /// In `[1, 2)`.
    pub mantissa: f64,
    /// Power of two.
    pub exponent: i32,
}

impl Wide {
    /// A positive double, which may be subnormal.
    pub fn of(value: f64) -> Self {
        let exponent = exponent(value);
        Wide { mantissa: times_power(value, -exponent), exponent }
    }

    fn normal(mantissa: f64, exponent: i32) -> Self {
        let Wide { mantissa, exponent: drift } = Wide::of(mantissa);
        Wide { mantissa, exponent: exponent + drift }
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        Self::normal(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }

    /// The quotient.
    pub fn over(self, other: Self) -> Self {
        Self::normal(self.mantissa / other.mantissa, self.exponent - other.exponent)
    }

    /// The square root.
    pub fn sqrt(self) -> Self {
        let odd = self.exponent.rem_euclid(2);
        Self::normal(times_power(self.mantissa, odd).sqrt(), self.exponent.div_euclid(2))
    }

    /// The cube root.
    pub fn cbrt(self) -> Self {
        let rest = self.exponent.rem_euclid(3);
        Self::normal(cbrt(times_power(self.mantissa, rest)), self.exponent.div_euclid(3))
    }

    /// The nearest double; 0 or infinity beyond the range of doubles.
    pub fn rounded(self) -> f64 {
        times_power(self.mantissa, self.exponent)
    }

    /// The nearest double, unless it is 0 or infinite.
    pub fn value(self) -> Option<f64> {
        let value = self.rounded();
        (value > 0.0 && value.is_finite()).then_some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intermediate_values_may_leave_the_range() {
        let (tiny, huge) = (Wide::of(5e-324), Wide::of(f64::MAX));
        assert_eq!(tiny.times(tiny).value(), None);
        assert_eq!(tiny.times(tiny).sqrt().value(), Some(5e-324));
        assert_eq!(huge.times(huge).times(huge).cbrt().value(), Some(f64::MAX));
        assert_eq!(huge.over(tiny).rounded(), f64::INFINITY);
        assert_eq!(tiny.over(huge).times(huge).value(), Some(5e-324));
    }

    #[test]
    fn roots_do_not_notice_powers_of_two() {
        for value in [1.0, 0.3, 7.5] {
            let (square, cube) = (Wide::of(value).sqrt(), Wide::of(value).cbrt());
            for k in [-500, -7, 3, 400] {
                let far = Wide { mantissa: 1.0, exponent: k };
                let (four, eight) = (far.times(far), far.times(far).times(far));
                assert_eq!(Wide::of(value).times(four).sqrt(), square.times(far));
                assert_eq!(Wide::of(value).times(eight).cbrt(), cube.times(far));
            }
        }
    }
}
