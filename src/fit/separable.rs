//! Damping numbers that the data cannot separate: only a combination of them is known.
//!
//! The damping of a motion at amplitude A is `D + 2 r/(pi A) + (3/8) D3 A^2`, and over a small range of
//! amplitudes the terms cannot be separated. If the errors of terms are of the order of the damping itself, the
//! combination of these terms that the data determine is reported instead.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::{D, D3, Estimate, NAMES, NameSpec, R, averaged, parameters};

/// A combination of numbers that are not known separately.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// The numbers and their weights; the first weight is 1.
    pub terms: Vec<(&'static NameSpec, f64)>,
    /// Value of the weighted sum.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The error of a term beyond which it is not known separately, as a fraction of the largest damping in the
/// record.
const UNKNOWN: f64 = 0.5;

/// The combinations to report; none if every number is known separately.
pub fn combinations(estimate: &Estimate) -> Vec<Combination> {
    let (low, high) = estimate.amplitudes();
    if !(low > 0.0 && high >= low) {
        return Vec::new();
    }
    let middle = (low * high).sqrt();
    // The damping due to one unit of each number.
    let scale = |place: usize| match place {
        D => Some(1.0),
        R => Some(2.0 / (PI * middle)),
        D3 => Some(0.375 * middle * middle),
        _ => None,
    };
    let p = &estimate.p;
    let damping = |a: f64| averaged(&parameters(p), a).abs();
    let largest = [low, middle, high].map(damping).into_iter().fold(0.0, f64::max);
    let unknown: Vec<(&NameSpec, f64)> = NAMES
        .iter()
        .filter(|row| estimate.free[row.place])
        .filter_map(|row| Some((row, scale(row.place)?)))
        .filter(|(row, scale)| estimate.covariance.error(row.place) * scale > UNKNOWN * largest)
        .collect();
    if unknown.len() < 2 {
        return Vec::new();
    }
    best_known(estimate, &unknown).into_iter().collect()
}

/// The combination with the smallest error: the principal direction of the information that remains when all other
/// unknowns are estimated as well.
fn best_known(estimate: &Estimate, unknown: &[(&'static NameSpec, f64)]) -> Option<Combination> {
    let size = unknown.len();
    let covariance = DMatrix::from_fn(size, size, |i, j| {
        let ((one, by), (other, and)) = (unknown[i], unknown[j]);
        estimate.covariance.of(one.place, other.place) * by * and
    });
    let information = covariance.try_inverse()?;
    let eigen = information.symmetric_eigen();
    let strongest = eigen.eigenvalues.imax();
    let direction: DVector<f64> = eigen.eigenvectors.column(strongest).into_owned();
    let weights: Vec<f64> =
        direction.iter().zip(unknown).map(|(weight, (_, scale))| weight * scale).collect();
    let terms: Vec<_> = unknown
        .iter()
        .zip(&weights)
        .map(|((row, _), weight)| (*row, weight / weights[0]))
        .collect();
    let value = terms.iter().map(|(row, weight)| weight * estimate.p[row.place]).sum();
    let weighted: Vec<_> = terms.iter().map(|(row, weight)| (row.place, *weight)).collect();
    Some(Combination { value, standard_error: estimate.covariance.error_of(&weighted), terms })
}
