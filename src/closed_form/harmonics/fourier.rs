//! Finite Fourier series of one angle, with products that lose nothing, and every sign change over a turn.
//!
//! A series is kept by the coefficients `c_0 .. c_N` of `f(t) = sum over abs(k) <= N of c_k e^(i k t)`,
//! where `c_-k` is the conjugate of `c_k` because f is real: `a_k cos(k t) + b_k sin(k t)` has
//! `c_k = (a_k - i b_k)/2`. The product of two series is a convolution of their coefficients, so that
//! squares and cubes need no sample points and nothing is aliased.
//!
//! The turn is cut in two again and again until, on each piece, Taylor's formula with a bound on its
//! remainder proves that the function has no root there, or that it is monotone, or that it is nothing
//! but rounding. Then the signs at the ends of the piece decide, so that no root can hide between sample
//! points.

use std::f64::consts::TAU;

use nalgebra::{Complex, ComplexField};

use crate::numerics::{Bracket, PlaceTolerance, newton, powi, real, sin_cos};

/// A real trigonometric polynomial.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fourier {
    /// `c_0, c_1, .., c_N`; the first is real.
    pub coefficients: Vec<Complex<f64>>,
}

impl Fourier {
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

    /// The derivative with respect to the angle.
    pub fn derivative(&self) -> Self {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let turned = terms.map(|(k, c)| Complex::new(-c.im, c.re) * real(k));
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

    /// The value and the derivatives at an angle, as many as there is room for.
    ///
    /// Rounding of the value: at most about `f64::EPSILON * (abs(mean) + bound(1))`.
    pub fn at<const ORDER: usize>(&self, angle: f64) -> [f64; ORDER] {
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
                term = Complex::new(-term.im, term.re) * real(k);
            }
        }
        derivatives[0] += self.mean();
        derivatives
    }

    /// A bound of derivative number `derivative` that holds at every angle (of `f - c_0`, for number 0).
    pub fn bound(&self, derivative: usize) -> f64 {
        let terms = self.coefficients.iter().enumerate().skip(1);
        let power = i32::try_from(derivative).unwrap_or(i32::MAX);
        terms.map(|(k, c)| 2.0 * powi(real(k), power) * c.modulus()).sum()
    }
}

/// A root at which the function changes its sign.
#[derive(Clone, Copy, Debug)]
pub struct SignChange {
    /// Where, from 0 to a full turn.
    pub angle: f64,
    /// `+1` where the function goes from negative to positive, `-1` where it falls.
    pub direction: f64,
    /// Its derivative there.
    pub slope: f64,
}

/// An end of a piece of a turn, and whether the function is positive there.
#[derive(Clone, Copy)]
struct PieceEnd {
    angle: f64,
    positive: bool,
}

/// Every sign change over a turn, in the order of the angle; there is an even number of them.
///
/// Guarantee: these are all the sign changes of a function that differs from this one by rounding, that
/// is by `f64::EPSILON` times the sum of `k abs(c_k)`. A function that is constant, or whose coefficients
/// leave the range of floating point, has none. Cost: some evaluations for each harmonic; flat places
/// cost more, at most a few hundred for each harmonic.
pub fn sign_changes(function: &Fourier) -> Vec<SignChange> {
    /// Pieces of the first cut, for each harmonic: this many leave little to be cut again.
    const PIECES: usize = 2;
    let rest = function.bound(ORDER);
    if !(rest.is_normal() && function.mean().is_finite()) {
        return Vec::new();
    }
    let noise = f64::EPSILON * (function.bound(1) + function.mean().abs());
    let pieces = PIECES * function.degree();
    // Zero counts as positive wherever a sign is asked for.
    let end = |angle: f64| PieceEnd { angle, positive: function.at::<1>(angle)[0] >= 0.0 };
    let mut left = end(0.0);
    // The end of the turn is its beginning, and rounding must not make its sign another.
    let mut ahead = vec![PieceEnd { angle: TAU, ..left }];
    ahead.extend((1..pieces).rev().map(|piece| end(TAU * (real(piece) / real(pieces)))));
    let mut found = Vec::new();
    while let Some(&right) = ahead.last() {
        let angle = 0.5 * (left.angle + right.angle);
        let half = 0.5 * (right.angle - left.angle);
        let derivatives = function.at(angle);
        // The middle of two neighbouring numbers is one of them.
        let atom = angle <= left.angle || angle >= right.angle;
        if !(atom || ends_decide(&derivatives, rest, half, noise)) {
            ahead.push(PieceEnd { angle, positive: derivatives[0] >= 0.0 });
            continue;
        }
        if left.positive != right.positive {
            let bracket = Bracket { low: left.angle, high: right.angle, rising: right.positive };
            found.push(sign_change(function, bracket));
        }
        left = right;
        ahead.pop();
    }
    found
}

/// Number of terms of Taylor's formula: with eight, a stretch that is flat to rounding is seen as such
/// when a piece is a hundredth of the shortest wave long.
const ORDER: usize = 8;

/// Whether the signs at the ends of a piece tell how often the function changes its sign there: it has no root, is
/// monotone, or is nothing but `noise`. Given are its value and its derivatives in the middle, a bound of the next
/// derivative, and half of the length.
fn ends_decide(derivatives: &[f64; ORDER], rest: f64, half: f64, noise: f64) -> bool {
    let [value, slope, ..] = *derivatives;
    // By how much the value and the slope can differ on this piece from those in its middle.
    let (mut value_range, mut slope_range, mut weight) = (0.0, 0.0, 1.0);
    for (number, derivative) in (1..).zip(derivatives[1..].iter().chain([&rest])) {
        if number > 1 {
            slope_range += weight * derivative.abs();
        }
        weight *= half / real(number);
        value_range += weight * derivative.abs();
    }
    let rootless = value.abs() > value_range;
    let monotone = slope.abs() > slope_range;
    rootless || monotone || value.abs() + value_range <= noise
}

/// The sign change in a bracket.
fn sign_change(function: &Fourier, bracket: Bracket) -> SignChange {
    let settled = PlaceTolerance::Relative(f64::EPSILON);
    let at = |angle: f64| function.at(angle).into();
    let angle = newton(bracket, bracket.middle(), settled, at);
    let [_, slope] = function.at(angle);
    SignChange { angle, direction: if bracket.rising { 1.0 } else { -1.0 }, slope }
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
        assert_eq!((f.mean(), f.cosine(1), f.cosine(2)), (0.5, 2.0, 0.0));
        let t: f64 = 0.7;
        let [value, slope, curvature] = f.at(t);
        assert!((value - (0.5 + 2.0 * cos(t) + 3.0 * sin(2.0 * t))).abs() < 1e-15);
        assert!((slope - (-2.0 * sin(t) + 6.0 * cos(2.0 * t))).abs() < 1e-14);
        assert!((curvature - (-2.0 * cos(t) - 12.0 * sin(2.0 * t))).abs() < 1e-14);
    }

    proptest! {
        #[test]
        fn products_multiply_and_derivatives_differentiate(f in series(), g in series(), t in 0.0..7.0) {
            let product = f.product(&g, f.degree() + g.degree());
            let ([of_f, slope, curvature], [of_g], [both]) = (f.at(t), g.at(t), product.at(t));
            prop_assert!((both - of_f * of_g).abs() < 1e-12);
            prop_assert_eq!(&product.coefficients[..2], &f.product(&g, 1).coefficients[..]);
            let derivative: [f64; 2] = f.derivative().at(t);
            prop_assert!((derivative[0] - slope).abs() < 1e-12);
            prop_assert!((derivative[1] - curvature).abs() < 1e-11);
            prop_assert!((of_f - f.mean()).abs() <= f.bound(0));
            prop_assert!(slope.abs() <= f.bound(1) && curvature.abs() <= f.bound(2));
        }
    }

    /// `sin(t - root)`-like factors: a product over pairs that vanishes exactly at these angles.
    fn with_roots(roots: &[(f64, f64)]) -> Fourier {
        let one = Fourier { coefficients: vec![Complex::from(1.0)] };
        roots.iter().fold(one, |product, (a, b)| {
            // sin((t - a)/2) sin((t - b)/2) = (cos((a - b)/2) - cos(t - (a + b)/2))/2.
            let (sine, cosine) = sin_cos(0.5 * (a + b));
            let mean = Complex::from(0.5 * cos(0.5 * (a - b)));
            let pair = Fourier { coefficients: vec![mean, Complex::new(cosine, -sine) * -0.25] };
            product.product(&pair, product.degree() + 1)
        })
    }

    #[test]
    fn functions_without_sign_changes_have_none() {
        assert!(sign_changes(&Fourier { coefficients: vec![Complex::default(); 4] }).is_empty());
        let lifted = Fourier { coefficients: vec![Complex::from(2.0), Complex::from(0.5)] };
        assert!(sign_changes(&lifted).is_empty());
        let broken =
            Fourier { coefficients: vec![Complex::from(f64::NAN), Complex::from(f64::NAN)] };
        assert!(sign_changes(&broken).is_empty());
        // 1 + cos t touches zero and does not cross it.
        let touching = Fourier { coefficients: vec![Complex::from(1.0), Complex::from(0.5)] };
        assert!(sign_changes(&touching).len() <= 2, "{:?}", sign_changes(&touching));
    }

    #[test]
    fn a_root_at_the_seam_of_the_turn_is_counted_once() {
        let sine = Fourier { coefficients: vec![Complex::default(), Complex::new(0.0, -0.5)] };
        let found = sign_changes(&sine);
        assert_eq!(found.len(), 2, "{found:?}");
    }

    #[test]
    fn pairs_of_roots_are_found_however_close() {
        for gap in [1e-1, 1e-3, 1e-5, 1e-6] {
            let function = with_roots(&[(1.0, 1.0 + gap), (3.0, 5.5)]);
            let found = sign_changes(&function);
            assert_eq!(found.len(), 4, "gap {gap}");
            // The value between the pair is gap^2/16: its rounding moves each root by eps/gap.
            let tolerance = 1e-15 + 1e-15 / gap;
            assert!((found[0].angle - 1.0).abs() < tolerance, "{gap} {found:?}");
            assert!((found[1].angle - 1.0 - gap).abs() < tolerance, "{gap} {found:?}");
        }
    }

    proptest! {
        #[test]
        fn every_root_is_found(gaps in prop::collection::vec(0.2..1.0, 25)) {
            let turn = gaps.iter().sum::<f64>() / TAU;
            let sums = gaps.iter().scan(0.0, |sum, gap| { *sum += gap / turn; Some(*sum) });
            let angles: Vec<f64> = sums.take(24).collect();
            let pairs: Vec<_> = angles.chunks(2).map(|pair| (pair[0], pair[1])).collect();
            let function = with_roots(&pairs);
            // Where roots crowd, what lies between them drowns in the rounding of the coefficients.
            let scale: f64 = function.coefficients.iter().map(|part| part.modulus()).sum();
            let between = |pair: &[f64]| function.at::<1>(0.5 * (pair[0] + pair[1]))[0].abs();
            prop_assume!(angles.windows(2).all(|pair| between(pair) > 1e-9 * scale));
            let found = sign_changes(&function);
            prop_assert_eq!(found.len(), angles.len());
            for (found, expected) in found.iter().zip(&angles) {
                prop_assert!((found.angle - expected).abs() < 1e-6, "{} {}", found.angle, expected);
            }
        }

        #[test]
        fn signs_alternate(parts in prop::collection::vec((-1.0..1.0, -1.0..1.0), 2..40)) {
            let mut function = Fourier {
                coefficients: parts.iter().map(|(re, im)| Complex::new(*re, *im)).collect(),
            };
            function.coefficients[0].im = 0.0;
            let found = sign_changes(&function);
            prop_assert!(found.len().is_multiple_of(2) && found.len() <= 2 * function.degree());
            for pair in found.windows(2) {
                prop_assert!(pair[0].angle < pair[1].angle && pair[0].direction == -pair[1].direction);
                let [between] = function.at(0.5 * (pair[0].angle + pair[1].angle));
                prop_assert_eq!(between > 0.0, pair[0].direction > 0.0);
            }
        }
    }
}
