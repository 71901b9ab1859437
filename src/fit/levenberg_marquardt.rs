//! Nonlinear least squares with exact gradients: the Levenberg-Marquardt method on a QR factor.
//!
//! Each set of gradients is factored once; every damping that is tried costs another factorization of at most
//! 17 rows. The damping is scaled by the largest column norms so far (More, *The Levenberg-Marquardt
//! algorithm*, 1978); its size follows the ratio of actual to predicted reduction (Nielsen, 1999). A trial
//! point whose motion escapes is a rejected step. If a step would make friction negative, it is recomputed with
//! friction set to zero.

use nalgebra::{DMatrix, DVector};

use super::loss::Loss;
use super::observation::{Observation, R, Residual, Seen, UNKNOWNS, Unknowns};
use super::triangle::triangle;
use crate::numerics::count::real;
use crate::numerics::elementary::powi;

/// Counters of the computation, and the check for an interruption.
pub struct Runs<'a> {
    /// Number of motions computed with derivatives.
    pub with_derivatives: u64,
    /// Number of motions computed without derivatives.
    pub plain: u64,
    /// Called before each motion; `true` ends the computation.
    pub interrupted: &'a dyn Fn() -> bool,
    /// The smallest root mean square of residuals that a descent has reached.
    pub closest: f64,
}

impl<'a> Runs<'a> {
    /// Counters at zero.
    pub fn new(interrupted: &'a dyn Fn() -> bool) -> Self {
        Runs { with_derivatives: 0, plain: 0, interrupted, closest: f64::INFINITY }
    }
}

/// Why there is no fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoFit {
    /// The motion of the first guess escapes.
    Lost,
    /// The computation was interrupted.
    Interrupted,
}

/// Turns an interruption into an error; passes on every other result.
///
/// # Errors
/// [`NoFit::Interrupted`].
pub fn interrupted<T>(result: Result<T, NoFit>) -> Result<Result<T, NoFit>, NoFit> {
    match result {
        Err(NoFit::Interrupted) => Err(NoFit::Interrupted),
        other => Ok(other),
    }
}

/// The point at which the iteration ended.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// The unknowns.
    pub p: Unknowns,
    /// The loss, in squared units of the residuals.
    pub cost: f64,
    /// The model compared with the record, with derivatives.
    pub seen: Seen,
}

/// What is estimated, and how residuals are weighted.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// Record and model.
    pub observation: &'a Observation,
    /// Which unknowns are free.
    pub free: [bool; UNKNOWNS],
    /// How residuals are weighted.
    pub loss: Loss,
    /// Which residuals count; all of them if empty.
    pub used: &'a [bool],
    /// Only this many residuals, from the first on, count.
    pub horizon: usize,
}

/// Maximum number of iterations.
const MOST: usize = 50;

/// Maximum number of iterations for a rough answer.
const FEW: usize = 12;

/// Relative reduction of the loss below which the iteration has converged.
const SETTLED: f64 = 1e-10;

impl Task<'_> {
    fn counts(&self, index: usize) -> bool {
        index < self.horizon && self.used.get(index).copied().unwrap_or(true)
    }

    /// The loss at a point.
    pub fn cost(&self, seen: &Seen) -> f64 {
        let used = seen.residuals.iter().enumerate().filter(|(index, _)| self.counts(*index));
        used.map(|(_, residual)| self.loss.of(residual.value)).sum()
    }

    /// The residuals that count.
    pub fn used_residuals<'a>(&self, seen: &'a Seen) -> Vec<&'a Residual> {
        let used = seen.residuals.iter().enumerate().filter(|(index, _)| self.counts(*index));
        used.map(|(_, residual)| residual).collect()
    }

    /// Variance of the noise: the sum of squared influences (weight times residual) over the degrees of freedom.
    pub fn variance(&self, seen: &Seen, freedom: f64) -> f64 {
        let used = self.used_residuals(seen).into_iter();
        let influence = |residual: &Residual| self.loss.weight(residual.value) * residual.value;
        used.map(|residual| powi(influence(residual), 2)).sum::<f64>() / freedom
    }

    /// Compares the model with the record, and counts the motion.
    ///
    /// # Errors
    /// [`NoFit`] if the motion of the model escapes, or when interrupted.
    pub fn look(&self, p: &Unknowns, derivatives: bool, runs: &mut Runs) -> Result<Seen, NoFit> {
        if (runs.interrupted)() {
            return Err(NoFit::Interrupted);
        }
        *(if derivatives { &mut runs.with_derivatives } else { &mut runs.plain }) += 1;
        self.observation.compare(p, derivatives).map_err(|_| NoFit::Lost)
    }

    /// The places of the free unknowns.
    pub fn columns(&self) -> Vec<usize> {
        (0..UNKNOWNS).filter(|&column| self.free[column]).collect()
    }

    /// The triangular factor of the weighted gradients of these unknowns, with the residuals as a last column.
    pub fn factor(&self, seen: &Seen, columns: &[usize]) -> DMatrix<f64> {
        let width = columns.len() + 1;
        triangle(width, seen.residuals.len(), |index, row| {
            let residual = &seen.residuals[index];
            let weight =
                if self.counts(index) { self.loss.weight(residual.value).sqrt() } else { 0.0 };
            for (cell, &column) in row.iter_mut().zip(columns) {
                *cell = weight * residual.by[column];
            }
            row[width - 1] = weight * residual.value;
        })
    }

    /// Iterates from a first guess.
    ///
    /// # Errors
    /// [`NoFit`] if even the guess cannot be compared with the record.
    pub fn solve(&self, guess: Unknowns, runs: &mut Runs) -> Result<Optimum, NoFit> {
        self.solve_within(SETTLED, MOST, guess, runs)
    }

    /// The same to a fraction of a standard error, which suffices for a start or for the profile of the loss.
    ///
    /// # Errors
    /// As [`Task::solve`].
    pub fn solve_roughly(&self, guess: Unknowns, runs: &mut Runs) -> Result<Optimum, NoFit> {
        let count = real(self.observation.data.residuals().max(1));
        self.solve_within(0.01 / count, FEW, guess, runs)
    }

    fn solve_within(
        &self,
        enough: f64,
        most: usize,
        guess: Unknowns,
        runs: &mut Runs,
    ) -> Result<Optimum, NoFit> {
        let mut p = guess;
        let mut seen = self.look(&p, true, runs)?;
        let mut cost = self.cost(&seen);
        let columns = self.columns();
        let mut norms = vec![0.0_f64; columns.len()];
        let (mut damping, mut grow) = (1e-4, 2.0);
        for _ in 0..if columns.is_empty() { 0 } else { most } {
            let factor = self.factor(&seen, &columns);
            for (column, norm) in norms.iter_mut().enumerate() {
                *norm = norm.max(factor.column(column).norm());
            }
            let taken = loop {
                let Some((step, predicted)) = damped_step(&factor, &norms, damping, &p, &columns)
                else {
                    break None;
                };
                if predicted <= enough * cost {
                    break None;
                }
                let trial: Unknowns = std::array::from_fn(|place| p[place] + step[place]);
                let found = match self.look(&trial, false, runs) {
                    Err(NoFit::Interrupted) => return Err(NoFit::Interrupted),
                    other => other.ok().map(|seen| self.cost(&seen)),
                };
                let gain = found.map_or(-1.0, |found| (cost - found) / predicted);
                if let Some(found) = found.filter(|found| *found < cost) {
                    let bend = 1.0 - powi(2.0 * gain - 1.0, 3);
                    damping = (damping * bend.clamp(0.1, 1.0)).max(1e-12);
                    grow = 2.0;
                    break Some((trial, found));
                }
                damping *= if found.is_none() { 8.0 } else { grow };
                grow *= 2.0;
                if damping > 1e16 {
                    break None;
                }
            };
            let Some((trial, found)) = taken else { break };
            let settled = (cost - found) <= enough * cost;
            (p, cost) = (trial, found);
            seen = self.look(&p, true, runs)?;
            if settled {
                break;
            }
        }
        Ok(Optimum { p, cost, seen })
    }
}

/// The damped step, and the reduction of the loss predicted by the linear model.
fn damped_step(
    factor: &DMatrix<f64>,
    norms: &[f64],
    damping: f64,
    p: &Unknowns,
    columns: &[usize],
) -> Option<(Unknowns, f64)> {
    let width = columns.len();
    let friction = columns.iter().position(|&column| column == R);
    let mut held: Option<f64> = None;
    loop {
        let mut system = DMatrix::zeros(2 * width + 1, width);
        let mut target = DVector::zeros(2 * width + 1);
        system.rows_mut(0, width + 1).copy_from(&factor.columns(0, width));
        target.rows_mut(0, width + 1).copy_from(&factor.column(width));
        for (column, norm) in norms.iter().enumerate() {
            let norm = if *norm > 0.0 { *norm } else { 1.0 };
            system[(width + 1 + column, column)] = damping.sqrt() * norm;
        }
        if let (Some(friction), Some(change)) = (friction, held) {
            let column = system.column(friction).into_owned();
            target -= column * change;
            system.column_mut(friction).fill(0.0);
            system[(width + 1 + friction, friction)] = 1.0;
            target[width + 1 + friction] = 0.0;
        }
        let qr = system.qr();
        let mut solution = qr.r().solve_upper_triangular(&(qr.q().transpose() * target))?;
        if let (Some(friction), Some(change)) = (friction, held) {
            solution[friction] = change;
        }
        if !solution.iter().all(|value| value.is_finite()) {
            return None;
        }
        if let Some(friction) = friction
            && held.is_none()
            && p[R] + solution[friction] < 0.0
        {
            held = Some(-p[R]);
            continue;
        }
        let left = factor.columns(0, width) * &solution - factor.column(width);
        let predicted = factor.column(width).norm_squared() - left.norm_squared();
        let mut step = [0.0; UNKNOWNS];
        for (&column, value) in columns.iter().zip(solution.iter()) {
            step[column] = *value;
        }
        return Some((step, predicted));
    }
}
