//! Powers of two as units: multiplication by one of them is exact.

use std::num::FpCategory;

/// `value * 2^k` for every `k`, rounded at most once.
#[inline]
pub fn times_power(value: f64, k: i32) -> f64 {
    // A power that is itself a normal number needs no call.
    if (-1022..=1023).contains(&k) {
        value * f64::from_bits(u64::from((k + 1023).unsigned_abs()) << 52)
    } else {
        libm::scalbn(value, k)
    }
}

/// The exponent `k` with `2^k <= abs(value) < 2^(k + 1)`; 0 for zero, 1024 for what is not finite.
pub fn exponent(value: f64) -> i32 {
    match value.classify() {
        FpCategory::Zero => 0,
        FpCategory::Nan | FpCategory::Infinite => 1024,
        FpCategory::Subnormal | FpCategory::Normal => libm::ilogb(value),
    }
}

/// `log2(value)` to about two digits, from the bits alone. Step sizes need no more, and this way they do not
/// depend on any mathematical library.
pub fn rough_log2(value: f64) -> f64 {
    let k = exponent(value);
    let fraction = times_power(value, -k) - 1.0;
    // Parabola through log2 at both ends and at the middle of the binade.
    f64::from(k) + fraction * (1.346_607 - 0.346_607 * fraction)
}

/// `2^power` to about three digits, from the bits alone.
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
    use crate::numerics::elementary::log2;

    #[test]
    fn powers_of_two_go_and_come_back() {
        for value in [1.0, -0.3, 1e-300, 1e300, 5e-324, f64::MAX] {
            let k = exponent(value);
            let near_one = times_power(value, -k);
            assert!((1.0..2.0).contains(&near_one.abs()), "{value} -> {near_one}");
            assert_eq!(times_power(near_one, k), value);
        }
        assert_eq!(times_power(1.0, -1074), 5e-324);
        assert_eq!(times_power(1.0, -1100), 0.0);
        assert_eq!(times_power(f64::MAX, -2381), 0.0);
        assert_eq!(times_power(1.0, 1024), f64::INFINITY);
        assert_eq!(times_power(5e-324, 2097), f64::MAX / (2.0 - f64::EPSILON));
    }
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
            assert!((rough_log2(value) - log2(value)).abs() < 0.01, "{value}");
            assert!((rough_exp2(log2(value)) / value - 1.0).abs() < 0.01, "{value}");
        }
    }
}
