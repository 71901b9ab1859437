//! Finite Fourier series of one angle, with products that lose nothing.
//!
//! A series is kept by the coefficients `c_0 .. c_N` of `f(t) = sum over abs(k) <= N of c_k e^(i k t)`,
//! where `c_-k` is the conjugate of `c_k` because f is real: `a_k cos(k t) + b_k sin(k t)` has
//! `c_k = (a_k - i b_k)/2`. The product of two series is a convolution of their coefficients, so that
//! squares and cubes need no sample points and nothing is aliased.

use nalgebra::Complex;

use crate::numerics::count::real;
use crate::numerics::elementary::{powi, sin_cos};

/// A real trigonometric polynomial.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fourier {
    /// `c_0, c_1, .., c_N`; the first is real.
    pub coefficients: Vec<Complex<f64>>,
}

/// A function and its first two derivatives at one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// `f`.
    pub value: f64,
    /// `f'`.
    pub slope: f64,
    /// `f''`.
    pub curvature: f64,
}

/// The number of a harmonic as a factor.
pub fn factor(k: usize) -> f64 {
    real(k)
}

impl Fourier {
    /// The zero function, with room for harmonics up to `degree`.
    pub fn zero(degree: usize) -> Self {
        Fourier { coefficients: vec![Complex::default(); degree + 1] }
    }

    /// Number of the highest harmonic that the series has room for.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    /// `c_k` for every whole `k`; 0 beyond the degree.
    pub fn coefficient(&self, k: isize) -> Complex<f64> {
        let known = self.coefficients.get(k.unsigned_abs()).copied().unwrap_or_default();
        if k < 0 { known.conj() } else { known }
    }

    /// Mean over a turn.
    pub fn mean(&self) -> f64 {
        self.coefficient(0).re
    }

    /// Factor `a_k` of `cos(k t)`, `k > 0`.
    pub fn cosine(&self, k: usize) -> f64 {
        2.0 * self.coefficient(k.cast_signed()).re
    }

    /// Factor `b_k` of `sin(k t)`, `k > 0`.
    pub fn sine(&self, k: usize) -> f64 {
        -2.0 * self.coefficient(k.cast_signed()).im
    }

    /// The derivative with respect to the angle.
    pub fn derivative(&self) -> Self {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let turned = terms.map(|(k, c)| Complex::new(-c.im, c.re) * factor(k));
        Fourier { coefficients: std::iter::once(Complex::default()).chain(turned).collect() }
    }

    /// The product with another series, cut off beyond harmonic `degree`; what is kept is not aliased.
    pub fn product(&self, other: &Self, degree: usize) -> Self {
        let (own, theirs) = (self.degree().cast_signed(), other.degree().cast_signed());
        let coefficient = |m: usize| {
            let m = m.cast_signed();
            let range = (m - theirs).max(-own)..=(m + theirs).min(own);
            range.map(|j| self.coefficient(j) * other.coefficient(m - j)).sum()
        };
        Fourier { coefficients: (0..=degree).map(coefficient).collect() }
    }

    /// The function with every coefficient passed through `change`.
    pub fn map(&self, change: impl Fn(f64) -> f64) -> Self {
        let both = |c: &Complex<f64>| Complex::new(change(c.re), change(c.im));
        Fourier { coefficients: self.coefficients.iter().map(both).collect() }
    }

    /// Value and derivatives at an angle.
    pub fn at(&self, angle: f64) -> Jet {
        let [value, slope, curvature] = self.derivatives(angle);
        Jet { value, slope, curvature }
    }

    /// Derivatives number 0, 1, .., `ORDER - 1` at an angle.
    ///
    /// Rounding of the value: at most about `f64::EPSILON * (abs(mean) + bound(1))`.
    pub fn derivatives<const ORDER: usize>(&self, angle: f64) -> [f64; ORDER] {
        let (sin, cos) = sin_cos(angle);
        let unit = Complex::new(cos, sin);
        // A term and its conjugate together are twice its real part.
        let mut power = Complex::new(2.0, 0.0);
        let mut derivatives = [0.0; ORDER];
        for (k, c) in self.coefficients.iter().enumerate().skip(1) {
            power *= unit;
            let mut term = c * power;
            for derivative in &mut derivatives {
                *derivative += term.re;
                term = Complex::new(-term.im, term.re) * factor(k);
            }
        }
        if let Some(value) = derivatives.first_mut() {
            *value += self.mean();
        }
        derivatives
    }

    /// A bound of derivative number `derivative` that holds at every angle (of `f - c_0`, for number 0).
    pub fn bound(&self, derivative: usize) -> f64 {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let power = i32::try_from(derivative).unwrap_or(i32::MAX);
        terms.map(|(k, c)| 2.0 * powi(factor(k), power) * c.norm()).sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::{cos, sin};

    fn series() -> impl Strategy<Value = Fourier> {
        let coefficient = (-1.0..1.0, -1.0..1.0).prop_map(|(re, im)| Complex::new(re, im));
        prop::collection::vec(coefficient, 2..8).prop_map(|mut coefficients| {
            coefficients[0].im = 0.0;
            Fourier { coefficients }
        })
    }

    #[test]
    fn coefficients_are_those_of_cosines_and_sines() {
        let f = Fourier {
            coefficients: vec![0.5.into(), Complex::new(1.0, 0.0), Complex::new(0.0, -1.5)],
        };
        assert_eq!((f.mean(), f.cosine(1), f.sine(1)), (0.5, 2.0, 0.0));
        assert_eq!((f.cosine(2), f.sine(2), f.sine(3)), (0.0, 3.0, 0.0));
        let t: f64 = 0.7;
        let jet = f.at(t);
        assert!((jet.value - (0.5 + 2.0 * cos(t) + 3.0 * sin(2.0 * t))).abs() < 1e-15);
        assert!((jet.slope - (-2.0 * sin(t) + 6.0 * cos(2.0 * t))).abs() < 1e-14);
        assert!((jet.curvature - (-2.0 * cos(t) - 12.0 * sin(2.0 * t))).abs() < 1e-14);
    }

    proptest! {
        #[test]
        fn products_multiply_and_derivatives_differentiate(f in series(), g in series(), t in 0.0..7.0) {
            let product = f.product(&g, f.degree() + g.degree());
            prop_assert!((product.at(t).value - f.at(t).value * g.at(t).value).abs() < 1e-12);
            let derivative = f.derivative();
            prop_assert!((derivative.at(t).value - f.at(t).slope).abs() < 1e-12);
            prop_assert!((derivative.at(t).slope - f.at(t).curvature).abs() < 1e-11);
        }

        #[test]
        fn a_product_that_is_cut_off_keeps_its_coefficients(f in series(), g in series()) {
            let whole = f.product(&g, f.degree() + g.degree());
            let part = f.product(&g, 1);
            prop_assert_eq!(&whole.coefficients[..2], &part.coefficients[..]);
        }

        #[test]
        fn bounds_bound(f in series(), t in 0.0..7.0) {
            let jet = f.at(t);
            prop_assert!((jet.value - f.mean()).abs() <= f.bound(0));
            prop_assert!(jet.slope.abs() <= f.bound(1) && jet.curvature.abs() <= f.bound(2));
        }
    }
}
