//! Draws of the parameters from their distribution given a record.
//!
//! If the loss is quadratic, the draws are normal. Otherwise all unknowns are drawn from the normal
//! distribution, weighted by the ratio of the likelihood `exp(-delta chi^2/2)` to the density of the draw, and
//! resampled by these weights. With negative friction ruled out, this gives the posterior for a uniform prior.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::estimate::Estimate;
use super::levenberg_marquardt::Runs;
use super::observation::{D, D2, D3, R, UNKNOWNS, Unknowns, parameters};
use super::refit::Refit;
use crate::flow::{Limits, Reason};
use crate::numerics::count::real;
use crate::numerics::elementary::{exp, ln, pow, powi};
use crate::oscillator::Parameters;

/// Parameters drawn, all of equal weight.
pub struct Drawn {
    /// The parameters.
    pub draws: Vec<Parameters>,
    /// If they were weighted: the number of independent draws that would carry as much information.
    pub effective: Option<f64>,
    /// Number of motions computed for the weights.
    pub motions: u64,
}

/// Number of weighted draws for each one that is kept.
const SPARE: usize = 4;

/// With fewer effective draws than this fraction of those wanted, the normal distribution is too far from the
/// likelihood for weighting, and unweighted normal draws are used.
const FEWEST: f64 = 0.1;

/// Draws from the distribution of an estimate. Fails with [`Reason::Interrupted`].
pub fn drawn(estimate: &Estimate, draws: usize, limits: &Limits) -> Result<Drawn, Reason> {
    let places: Vec<usize> =
        [D, D2, D3, R].into_iter().filter(|&place| estimate.free[place]).collect();
    let mut motions = 0;
    if !places.iter().all(|&place| estimate.intervals[place].quadratic) {
        let normal = Normal::of(estimate, estimate.covariance.columns.clone());
        let points: Vec<Unknowns> = (0..SPARE * draws).map(|index| normal.point(index)).collect();
        let weights = weights(estimate, &normal, &points, limits)?;
        motions = weights.len() as u64;
        let (sum, squares) = weights
            .iter()
            .fold((0.0, 0.0), |(sum, squares), weight| (sum + weight, squares + weight * weight));
        let effective = sum * sum / squares;
        if effective >= FEWEST * real(draws) {
            let draws = resampled(&points, &weights, draws);
            return Ok(Drawn { draws, effective: Some(effective), motions });
        }
    }
    let normal = Normal::of(estimate, places);
    // Negative friction is physically impossible and counts as zero.
    let draw = |index: usize| {
        let mut p = normal.point(index);
        p[R] = p[R].max(0.0);
        parameters(&p)
    };
    Ok(Drawn { draws: (0..draws).map(draw).collect(), effective: None, motions })
}

/// The ratio of the likelihood to the density at each point, up to a common factor.
fn weights(
    estimate: &Estimate,
    normal: &Normal,
    points: &[Unknowns],
    limits: &Limits,
) -> Result<Vec<f64>, Reason> {
    let refit = Refit::without(estimate, &[]);
    let runs = || Runs::new(limits.interrupted);
    let least = refit.cost(&estimate.p, &mut runs());
    let (Ok(least), Ok(unit)) = (least, refit.unit(&mut runs())) else {
        return Err(Reason::Interrupted);
    };
    let weight = |p: &Unknowns| {
        // A motion that escapes cannot be the recorded one.
        let cost = refit.cost(p, &mut runs()).unwrap_or(f64::INFINITY);
        let likelihood = exp(-0.5 * (cost - least) / unit);
        let weight = if p[R] >= 0.0 { likelihood / normal.density(p) } else { 0.0 };
        if weight.is_finite() { weight } else { 0.0 }
    };
    let weights: Vec<f64> = points.par_iter().map(weight).collect();
    if (limits.interrupted)() { Err(Reason::Interrupted) } else { Ok(weights) }
}

/// Resamples points by weight, at even steps through the sum of the weights.
fn resampled(points: &[Unknowns], weights: &[f64], draws: usize) -> Vec<Parameters> {
    let sum: f64 = weights.iter().sum();
    let step = sum / real(draws);
    let mut found = Vec::with_capacity(draws);
    let (mut passed, mut next) = (0.0, 0.5 * step);
    for (point, weight) in points.iter().zip(weights) {
        passed += weight;
        while next < passed && found.len() < draws {
            found.push(parameters(point));
            next += step;
        }
    }
    found
}

/// The normal distribution of the unknowns; a mixture if there are several minima.
struct Normal {
    columns: Vec<usize>,
    scale: Vec<f64>,
    /// Principal directions in scaled unknowns, and the standard deviation along each.
    directions: DMatrix<f64>,
    deviations: Vec<f64>,
    /// Minima with their weights, which add up to one.
    centers: Vec<(f64, Unknowns)>,
}

impl Normal {
    fn of(estimate: &Estimate, columns: Vec<usize>) -> Self {
        let scale: Vec<f64> =
            columns.iter().map(|&place| estimate.covariance.error(place)).collect();
        let scaled = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
            estimate.covariance.of(columns[i], columns[j]) / (scale[i] * scale[j])
        });
        // If every number is held, there is a single point.
        let (directions, values) = if columns.is_empty() {
            (scaled, Vec::new())
        } else {
            let eigen = scaled.symmetric_eigen();
            (eigen.eigenvectors, eigen.eigenvalues.iter().copied().collect())
        };
        let mut centers: Vec<(f64, Unknowns)> =
            estimate.contenders().map(|it| (exp(-0.5 * it.delta_chi2), it.p)).collect();
        let sum: f64 = centers.iter().map(|(weight, _)| weight).sum();
        for (weight, _) in &mut centers {
            *weight /= sum;
        }
        let deviations = values.into_iter().map(|value: f64| value.max(0.0).sqrt()).collect();
        Normal { columns, scale, directions, deviations, centers }
    }

    /// Draw number `index`.
    fn point(&self, index: usize) -> Unknowns {
        let width = self.columns.len();
        let even = evenly(index, width + 1);
        let along = |i: usize, _| self.deviations[i] * normal_at(even[i]);
        let step = &self.directions * DVector::from_fn(width, along);
        let mut left = even[width];
        let chosen = self.centers.iter().find(|(weight, _)| {
            left -= weight;
            left < 0.0
        });
        let mut p = chosen.or(self.centers.last()).map_or([0.0; UNKNOWNS], |(_, p)| *p);
        for (i, &place) in self.columns.iter().enumerate() {
            p[place] += self.scale[i] * step[i];
        }
        p
    }

    /// The density at a point, up to a common factor.
    fn density(&self, p: &Unknowns) -> f64 {
        let about = |center: &Unknowns| {
            let step = DVector::from_fn(self.columns.len(), |i, _| {
                (p[self.columns[i]] - center[self.columns[i]]) / self.scale[i]
            });
            let along = self.directions.tr_mul(&step);
            let squares = along.iter().zip(&self.deviations).map(|(it, one)| powi(it / one, 2));
            exp(-0.5 * squares.sum::<f64>())
        };
        self.centers.iter().map(|(weight, center)| weight * about(center)).sum()
    }
}

/// Point `index` of a low-discrepancy sequence: multiples of powers of the inverse of the root of
/// `x^(dimensions + 1) = x + 1`, modulo 1 (Roberts, 2018).
fn evenly(index: usize, dimensions: usize) -> Vec<f64> {
    /// Each iteration divides the error by more than the number of dimensions.
    const ITERATIONS: usize = 60;
    let (number, power) = (real(index) + 1.0, 1.0 / (real(dimensions) + 1.0));
    let root = (0..ITERATIONS).fold(1.0_f64, |root, _| pow(1.0 + root, power));
    std::iter::successors(Some(1.0 / root), |part| Some(part / root))
        .take(dimensions)
        .map(|part| (0.5 + number * part).fract())
        .collect()
}

/// The quantile of the standard normal distribution, to 4.5e-4 (Abramowitz and Stegun, 26.2.23).
fn normal_at(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability).max(f64::MIN_POSITIVE);
    let t = (-2.0 * ln(tail)).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let value = t - above / below;
    if probability < 0.5 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::powi;

    #[test]
    fn draws_are_normal_and_independent() {
        for (count, dimensions) in [(400_u32, 4), (1600, 8)] {
            let drawn: Vec<Vec<f64>> =
                (0..count as usize).map(|index| evenly(index, dimensions + 1)).collect();
            let mean = |value: &dyn Fn(&[f64]) -> f64| {
                drawn.iter().map(|it| value(it)).sum::<f64>() / f64::from(count)
            };
            // The standard errors that the means of x, x^2 and x y would have for as many independent draws.
            let one = 1.0 / f64::from(count).sqrt();
            for i in 0..dimensions {
                assert!(mean(&|it| normal_at(it[i])).abs() < one);
                assert!((mean(&|it| powi(normal_at(it[i]), 2)) - 1.0).abs() < 2.0_f64.sqrt() * one);
                for j in 0..i {
                    let both = mean(&|it| normal_at(it[i]) * normal_at(it[j]));
                    assert!(both.abs() < 1.5 * one, "{i} {j}: {both}");
                }
            }
        }
        for (probability, value) in [(0.5, 0.0), (0.975, 1.959_964), (0.05, -1.644_854)] {
            assert!((normal_at(probability) - value).abs() < 5e-4);
        }
    }
}
