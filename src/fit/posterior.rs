//! Draws of the parameters from their distribution given a record.
//!
//! If the loss is quadratic, the draws are normal. Otherwise the record is given other errors, as large as its own,
//! and the motion is sought whose residuals have these along the gradients of the estimate: where the loss is
//! quadratic this is a normal draw, and where it is not, the draw follows its valley. What remains between the
//! density of these draws and the likelihood is a weight near one (Bardsley, Solonen, Haario and Laine,
//! *Randomize-then-optimize*, 2014). With negative friction ruled out, this gives the posterior for a uniform prior.

use rayon::prelude::*;

use super::{
    D, D2, D3, Estimate, Misfit, R, Runs, Task, Unknowns, UnknownsMatrix, chi_squared, normal_at,
};
use crate::flow::{Limits, Reason, Result};
use crate::numerics::{amount, exp, ln, pow, real};

/// Unknowns drawn, all of equal weight.
pub struct Draws {
    /// The unknowns of each.
    pub sample: Vec<Unknowns>,
    /// The number of independent draws that would carry as much information.
    pub effective: f64,
    /// Number of motions computed for the weights.
    pub motions: u64,
}

/// Fewest effective draws on which a quantile of 2.5 % may rest: ten of them lie beyond it.
pub const FEWEST: f64 = 400.0;

/// Draws from the distribution of an estimate. Fails with [`Reason::Interrupted`].
pub fn drawn(estimate: &Estimate, draws: usize, limits: &Limits) -> Result<Draws> {
    /// Draws of each round, the maximum number of rounds, and that of residuals computed, after which the effective
    /// number is left as it is.
    const ROUND: usize = 150;
    const ROUNDS: usize = 40;
    const MOST: f64 = 1e7;
    let is_bent = |place: usize| estimate.free[place] && !estimate.intervals[place].quadratic;
    let quadratic = ![D, D2, D3, R].into_iter().any(is_bent);
    let frame = PosteriorFrame::of(estimate, &Runs::new(limits.interrupted));
    let frame = frame.ok_or(Reason::Interrupted)?;
    if quadratic || estimate.whiteness.systematic {
        // Negative friction is physically impossible and counts as zero.
        let draw = |index: usize| {
            let mut p = frame.straight(&(-frame.errors(index)));
            p[R] = p[R].max(0.0);
            p
        };
        let effective = real(draws);
        return Ok(Draws { sample: (0..draws).map(draw).collect(), effective, motions: 0 });
    }
    let mut points: Vec<(Unknowns, f64)> = Vec::new();
    let mut motions = 0;
    for round in 0..ROUNDS {
        let found: Vec<(Vec<(Unknowns, f64)>, u64)> = (round * ROUND..(round + 1) * ROUND)
            .into_par_iter()
            .map(|index| frame.draws(&frame.errors(index), limits))
            .collect();
        limits.go_on()?;
        for (found, computed) in found {
            points.extend(found);
            motions += computed;
        }
        let spent = amount(motions) * real(frame.along.len());
        if effective(&weights(&points)) >= FEWEST.max(real(draws)) || spent > MOST {
            break;
        }
    }
    let weights = weights(&points);
    let draws = resampled(&points, &weights, draws);
    Ok(Draws { sample: draws, effective: effective(&weights), motions })
}

/// Weights from their logarithms.
fn weights(points: &[(Unknowns, f64)]) -> Vec<f64> {
    let largest = points.iter().map(|it| it.1).fold(f64::NEG_INFINITY, f64::max);
    points.iter().map(|it| exp(it.1 - largest)).collect()
}

/// The number of equal weights that would carry as much information.
fn effective(weights: &[f64]) -> f64 {
    let sum: f64 = weights.iter().sum();
    let squares: f64 = weights.iter().map(|it| it * it).sum();
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

/// Resamples points by weight, at even steps through the sum of the weights.
fn resampled(points: &[(Unknowns, f64)], weights: &[f64], draws: usize) -> Vec<Unknowns> {
    let sum: f64 = weights.iter().sum();
    let step = sum / real(draws);
    let mut found = Vec::with_capacity(draws);
    let (mut passed, mut next) = (0.0, 0.5 * step);
    for ((point, _), weight) in points.iter().zip(weights) {
        passed += weight;
        while next < passed && found.len() < draws {
            found.push(*point);
            next += step;
        }
    }
    found
}

/// The residuals of all motions as seen along the gradients of the estimate.
struct PosteriorFrame<'a> {
    estimate: &'a Estimate,
    /// The places of the free unknowns.
    places: Vec<usize>,
    /// Orthonormal directions, a row for each residual that counts.
    along: Vec<Unknowns>,
    /// The triangular factor of the gradients of the estimate.
    upper: UnknownsMatrix,
    /// The root of the covariance of errors along the directions.
    root: UnknownsMatrix,
    /// The residuals of the estimate along the directions; zero unless a bound holds it.
    center: Unknowns,
    /// Loss per unit of chi-squared.
    unit: f64,
}

impl<'a> PosteriorFrame<'a> {
    fn of(estimate: &'a Estimate, runs: &Runs) -> Option<Self> {
        let task = estimate.task(&[], runs);
        let seen = task.evaluated(&estimate.p, true)?;
        let (upper, along) = (task.factor(&seen).upper, task.directions(&seen));
        // The covariance of the estimate is U^-1 C U^-T for errors with the covariance C along the directions.
        let errors = upper * estimate.covariance.matrix * upper.transpose() + task.held();
        let unit = estimate.unit(runs)?;
        let root = errors.cholesky().map(|it| it.l());
        let root = root.unwrap_or_else(|| unit.sqrt() * UnknownsMatrix::identity());
        let (center, _) = seen_along(&task, &along, &seen);
        let places = task.columns().collect();
        Some(PosteriorFrame { estimate, places, along, upper, root, center, unit })
    }

    /// Errors along the directions, the `index`th of evenly spread ones.
    fn errors(&self, index: usize) -> Unknowns {
        let width = self.places.len();
        let even = evenly(index, width + 1);
        let mut normal = Unknowns::zeros();
        for (place, even) in self.places.iter().zip(&even) {
            normal[*place] = normal_at(*even);
        }
        // The size of the noise is itself known only from its residuals.
        let freedom = self.estimate.covariance.independent(R);
        let wider = (freedom / chi_squared(freedom, normal_at(even[width]))).sqrt();
        self.root * normal * wider
    }

    /// The point to which the linear model leads from the estimate for a change of what is seen.
    fn straight(&self, change: &Unknowns) -> Unknowns {
        self.estimate.p + self.upper.solve_upper_triangular(change).unwrap_or_default()
    }

    /// The motions whose residuals have these errors, each with the logarithm of its weight, and the number of
    /// motions computed. There may be one near every minimum.
    fn draws(&self, errors: &Unknowns, limits: &Limits) -> (Vec<(Unknowns, f64)>, u64) {
        let runs = Runs::new(limits.interrupted);
        let estimate = self.estimate;
        let task = estimate.task(&[], &runs);
        let mut found: Vec<(Unknowns, f64)> = Vec::new();
        for rival in estimate.contenders() {
            let Some((p, weight)) = self.draw(&task, &rival.p, errors) else { continue };
            let near = |place: &usize, other: &Unknowns| {
                (p[*place] - other[*place]).abs() < 0.01 * estimate.covariance.error(*place)
            };
            if !found.iter().any(|(other, _)| self.places.iter().all(|it| near(it, other))) {
                found.push((p, weight));
            }
        }
        (found, runs.with_derivatives.get())
    }

    /// One of them, by Newton's method; `None` if it would have negative friction, or none is found.
    fn draw(&self, task: &Task, from: &Unknowns, errors: &Unknowns) -> Option<(Unknowns, f64)> {
        const ROUNDS: usize = 14;
        /// So many points with negative friction show that there is none without.
        const NEGATIVE: usize = 3;
        /// How far the residuals may be from the errors, squared, in units of the noise.
        const NEAR: f64 = 1e-4;
        let mut at = if *from == self.estimate.p {
            self.straight(&(self.center - errors))
        } else {
            *from
        };
        let mut before: Option<LastDraw> = None;
        let mut negative = 0;
        for _ in 0..ROUNDS {
            negative += usize::from(at[R] < 0.0);
            if negative == NEGATIVE {
                return None;
            }
            at[R] = at[R].max(0.0);
            let seen = task.evaluated(&at, true);
            let state = seen.map(|seen| {
                let (values, by) = seen_along(task, &self.along, &seen);
                ((values - errors).norm_squared() / self.unit, values, by, task.cost(&seen))
            });
            match (state, &before) {
                (Some((off, values, by, cost)), last)
                    if last.as_ref().is_none_or(|it| off < it.off) =>
                {
                    let lu = by.lu();
                    if off < NEAR {
                        let bent = (cost - values.norm_squared()) / self.unit;
                        let size = lu.u().diagonal().iter().map(|it| ln(it.abs())).sum::<f64>();
                        return Some((at, -0.5 * bent - size));
                    }
                    let step = lu.solve(&(values - errors))?;
                    before = Some(LastDraw { at, step, off });
                    at += step;
                }
                // Too far: half the step.
                (_, Some(_)) => {
                    let last = before.as_mut()?;
                    last.step *= 0.4;
                    at = last.at + last.step;
                }
                (_, None) => at = 0.5 * (at + from),
            }
        }
        None
    }
}

/// The last point of a search that came nearer, the step from it, and how far off it was.
struct LastDraw {
    at: Unknowns,
    step: Unknowns,
    off: f64,
}

/// The residuals along the directions, and the derivatives of the motion along them.
fn seen_along(task: &Task, along: &[Unknowns], seen: &Misfit) -> (Unknowns, UnknownsMatrix) {
    let (mut values, mut by) = (Unknowns::zeros(), task.held());
    for (along, residual) in along.iter().zip(task.used_residuals(seen)) {
        values.axpy(residual.value, along, 1.0);
        for place in task.columns() {
            by.column_mut(place).axpy(residual.by[place], along, 1.0);
        }
    }
    (values, by)
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
