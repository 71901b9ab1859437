//! Every sign change of a finite Fourier series over one turn.
//!
//! The turn is cut in two again and again until, on each piece, Taylor's formula with a bound on its
//! remainder proves that the function has no root there, or that it is monotone, or that it is nothing
//! but rounding. Then the signs at the ends of the piece decide, so that no root can hide between sample
//! points.

use std::f64::consts::TAU;

use super::fourier::{Fourier, factor};
use crate::numerics::root::{Bracket, PlaceTolerance, newton};

/// A root at which the function changes its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignChange {
    /// Where, from 0 to a full turn.
    pub angle: f64,
    /// Whether the function goes from negative to positive there.
    pub rising: bool,
    /// Its derivative there.
    pub slope: f64,
}

impl SignChange {
    /// `+1` where the function rises, `-1` where it falls.
    pub fn direction(&self) -> f64 {
        if self.rising { 1.0 } else { -1.0 }
    }
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
    let mut search = Search { function, rest, noise, found: Vec::new() };
    let first = PieceEnd::of(function, 0.0);
    let mut left = first;
    for piece in 1..=pieces {
        let right = if piece < pieces {
            PieceEnd::of(function, TAU * (factor(piece) / factor(pieces)))
        } else {
            // The end of the turn is its beginning, and rounding must not make its sign another.
            PieceEnd { angle: TAU, ..first }
        };
        search.piece(left, right);
        left = right;
    }
    search.found
}

/// Number of terms of Taylor's formula: with eight, a stretch that is flat to rounding is seen as such
/// when a piece is a hundredth of the shortest wave long.
const ORDER: usize = 8;

#[derive(Clone, Copy)]
struct PieceEnd {
    angle: f64,
    /// Zero counts as positive wherever a sign is asked for.
    positive: bool,
}

impl PieceEnd {
    fn of(function: &Fourier, angle: f64) -> Self {
        PieceEnd { angle, positive: function.at(angle).value >= 0.0 }
    }
}

struct Search<'a> {
    function: &'a Fourier,
    /// Bound of the derivative number [`ORDER`].
    rest: f64,
    /// What rounding makes of a value.
    noise: f64,
    found: Vec<SignChange>,
}

impl Search<'_> {
    /// Finds the sign changes of a piece.
    fn piece(&mut self, left: PieceEnd, right: PieceEnd) {
        let angle = 0.5 * (left.angle + right.angle);
        let half = 0.5 * (right.angle - left.angle);
        let derivatives: [f64; ORDER] = self.function.derivatives(angle);
        let [value, slope, ..] = derivatives;
        // By how much the value and the slope can differ on this piece from those in its middle.
        let (mut value_range, mut slope_range, mut weight) = (0.0, 0.0, 1.0);
        for (number, derivative) in (1..).zip(derivatives[1..].iter().chain([&self.rest])) {
            if number > 1 {
                slope_range += weight * derivative.abs();
            }
            weight *= half / factor(number);
            value_range += weight * derivative.abs();
        }
        let rootless = value.abs() > value_range;
        let monotone = slope.abs() > slope_range;
        let flat = value.abs() + value_range <= self.noise;
        // The middle of two neighbouring numbers is one of them.
        let atom = angle <= left.angle || angle >= right.angle;
        if rootless || monotone || flat || atom {
            if left.positive != right.positive {
                self.polish(left, right);
            }
        } else {
            let middle = PieceEnd { angle, positive: value >= 0.0 };
            self.piece(left, middle);
            self.piece(middle, right);
        }
    }

    /// Adds the sign change between two ends of different sign.
    fn polish(&mut self, left: PieceEnd, right: PieceEnd) {
        let bracket = Bracket { low: left.angle, high: right.angle, rising: right.positive };
        let settled = PlaceTolerance::Relative(f64::EPSILON);
        let angle = newton(bracket, bracket.middle(), settled, |angle| {
            let jet = self.function.at(angle);
            (jet.value, jet.slope)
        });
        let slope = self.function.at(angle.at).slope;
        self.found.push(SignChange { angle: angle.at, rising: right.positive, slope });
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use nalgebra::Complex;
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::{cos, sin_cos};

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
    fn a_cosine_changes_its_sign_twice() {
        let cosine = Fourier { coefficients: vec![Complex::default(), Complex::from(0.5)] };
        let [fall, rise] = sign_changes(&cosine)[..] else { panic!("two sign changes") };
        assert!((fall.angle - 0.5 * PI).abs() < 1e-15 && !fall.rising && fall.direction() == -1.0);
        assert!((rise.angle - 1.5 * PI).abs() < 2e-15 && rise.rising && rise.direction() == 1.0);
        assert!((fall.slope + 1.0).abs() < 1e-15 && (rise.slope - 1.0).abs() < 1e-15);
    }

    #[test]
    fn functions_without_sign_changes_have_none() {
        assert!(sign_changes(&Fourier::zero(3)).is_empty());
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
            let scale: f64 = function.coefficients.iter().map(|part| part.norm()).sum();
            let between = |pair: &[f64]| function.at(0.5 * (pair[0] + pair[1])).value.abs();
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
                prop_assert!(pair[0].angle < pair[1].angle && pair[0].rising != pair[1].rising);
                let between = function.at(0.5 * (pair[0].angle + pair[1].angle)).value;
                prop_assert_eq!(between > 0.0, pair[0].rising);
            }
        }
    }
}
