//! Elementary functions with the same results on every machine.
//!
//! The last digit of the methods of `f64` (`exp`, `sin`, `powf`, ...) depends on the machine's C library, and
//! that of `powi` on the compiler. The functions here execute the same instructions everywhere, so that a scan
//! shared by machines of several kinds agrees to the last byte. `clippy.toml` forbids the methods. `sqrt` and
//! `mul_add` are exact on every machine and need no replacement.
//!
//! Errors stay below one unit in the last place (those of the `libm` crate, a translation of FreeBSD's and
//! musl's functions). Nothing that is called proved depends on them: see [`crate::numerics::Interval`].

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, cbrt, cos, cosh, erfc, exp, exp2, expm1 as exp_m1,
    hypot, log as ln, log1p as ln_1p, log2, log10, pow, sin, sincos as sin_cos, sinh, tan, tanh,
};

/// `base` to an integer power, by repeated squaring.
pub fn powi(base: f64, power: i32) -> f64 {
    let (mut left, mut square, mut product) = (power.unsigned_abs(), base, 1.0);
    while left > 0 {
        if left % 2 == 1 {
            product *= square;
        }
        left /= 2;
        square *= square;
    }
    if power < 0 { 1.0 / product } else { product }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last digits of the first terms must be the same on any machine. This test also runs in builds for
    /// other C libraries and processors.
    #[test]
    fn the_last_digits_are_the_same_on_every_machine() {
        let digest = (1..4000).fold(0_u64, |digest, k| {
            let x = f64::from(k) * 0.012_345;
            let (sine, cosine) = sin_cos(x);
            let values = [
                exp(-x),
                ln(x),
                sine,
                cosine,
                pow(x, 1.3),
                cbrt(x),
                tanh(x),
                hypot(x, 1.7),
                atan2(1.3, x),
                exp_m1(-x),
                ln_1p(x),
                log10(x),
                exp2(x),
                log2(x),
                atan(x),
                tan(x),
                sinh(x),
                cosh(x),
                asinh(x),
                powi(x, -7),
            ];
            values.iter().fold(digest, |digest, value| digest.rotate_left(5) ^ value.to_bits())
        });
        assert_eq!(digest, 0xd251_5bf1_9a70_22d9, "{digest:#x}");
    }

    #[test]
    fn whole_powers_are_products() {
        assert_eq!(powi(3.0, 5).to_bits(), 243_f64.to_bits());
        assert_eq!(powi(-2.0, 3).to_bits(), (-8_f64).to_bits());
        assert_eq!(powi(10.0, -3).to_bits(), 1e-3_f64.to_bits());
        assert_eq!(powi(0.0, 0).to_bits(), 1_f64.to_bits());
        assert_eq!(powi(2.0, -1074).to_bits(), 0_f64.to_bits(), "2^1074 is beyond all doubles");
        assert!(powi(f64::NAN, 2).is_nan() && powi(f64::INFINITY, -1) == 0.0);
    }
}
