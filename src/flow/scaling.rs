//! Powers of two as units, so that motions of any size are computed near 1 and scale to the last bit.
//!
//! A motion in units of `2^k` has `D2` and `D3` multiplied by `2^k` and `2^(2 k)` (the scaling symmetry
//! of equation 4). Multiplying by a power of two is exact, so nothing is lost on the way.

use crate::oscillator::HalfPlane;
pub use crate::oscillator::scaling::{exponent, times_power};

/// A field as seen by motions measured in units of `2^k`.
#[must_use]
pub fn field_in_units(field: &HalfPlane, k: i32) -> HalfPlane {
    HalfPlane {
        d: field.d,
        d2: times_power(field.d2, k),
        d3: times_power(times_power(field.d3, k), k),
    }
}

/// `log2(value)` to about two digits, from the bits alone: step sizes need no more, and this way they
/// do not depend on any mathematical library.
#[must_use]
pub fn rough_log2(value: f64) -> f64 {
    let k = exponent(value);
    let fraction = times_power(value, -k) - 1.0;
    // Parabola through log2 at both ends and at the middle of the binade.
    f64::from(k) + fraction * (1.346_607 - 0.346_607 * fraction)
}

/// `2^power` to about three digits, from the bits alone.
#[must_use]
pub fn rough_exp2(power: f64) -> f64 {
    let whole = power.floor().clamp(-1100.0, 1100.0);
    let fraction = power - whole;
    #[expect(clippy::cast_possible_truncation, reason = "clamped two lines above")]
    let k = whole as i32;
    times_power(1.0 + fraction * (0.656_854 + 0.343_146 * fraction), k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_of_normal_and_subnormal_numbers() {
        assert_eq!([1.0, 1.5, 2.0, 0.75, -8.0].map(exponent), [0, 0, 1, -1, 3]);
        assert_eq!(exponent(f64::MIN_POSITIVE), -1022);
        assert_eq!(exponent(5e-324), -1074);
        assert_eq!(exponent(f64::MAX), 1023);
    }

    #[test]
    fn rough_logarithms_are_good_to_two_digits() {
        for value in [1e-300, 1e-16, 0.3, 1.0, 1.7, 1e5, 1e300] {
            assert!((rough_log2(value) - f64::log2(value)).abs() < 0.01, "{value}");
            assert!((rough_exp2(f64::log2(value)) / value - 1.0).abs() < 0.01, "{value}");
        }
    }
}
