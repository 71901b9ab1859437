//! What the data cannot separate: damping numbers that are known only together.
//!
//! The damping that a motion feels at amplitude A is `D + 2 r/(pi A) + (3/8) D3 A^2`, and over a small range of
//! amplitudes the terms cannot be told apart. Where the error of a term is as large as the damping itself, the
//! combination of such terms that the data do know is reported instead.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::decrements::averaged;
use super::estimate::Estimate;
use super::names::{NAMES, NameSpec};
use super::observation::{D, D3, R};

/// Numbers that are known only together.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// The numbers and their weights; the first weighs 1.
    pub terms: Vec<(&'static NameSpec, f64)>,
    /// Value of the weighted sum.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The error of a term beyond which it is not known by itself, as a fraction of the largest damping seen.
const UNKNOWN: f64 = 0.5;

/// The combinations to report; none where every number is known by itself.
pub fn combinations(estimate: &Estimate) -> Vec<Combination> {
    let (low, high) = estimate.amplitudes();
    if !(low > 0.0 && high >= low) {
        return Vec::new();
    }
    let middle = (low * high).sqrt();
    // How much of the damping a unit of each number is.
    let scale = |place: usize| match place {
        D => Some(1.0),
        R => Some(2.0 / (PI * middle)),
        D3 => Some(0.375 * middle * middle),
        _ => None,
    };
    let p = &estimate.p;
    let damping = |a: f64| averaged(p[D], p[D3], p[R], a).abs();
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

/// The combination with the smallest error: the strongest direction of the information that is left when all
/// other unknowns are estimated too.
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
    let variance: f64 = terms
        .iter()
        .flat_map(|one| terms.iter().map(move |other| (one, other)))
        .map(|(one, other)| one.1 * other.1 * estimate.covariance.of(one.0.place, other.0.place))
        .sum();
    Some(Combination { terms, value, standard_error: variance.max(0.0).sqrt() })
}
