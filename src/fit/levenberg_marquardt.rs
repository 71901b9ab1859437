//! Nonlinear least squares with exact gradients: the Levenberg-Marquardt method on a QR factor.
//!
//! Each set of gradients is factored once; every damping that is tried costs another factorization of at most
//! 17 rows. The damping is scaled by the largest column norms so far (More, *The Levenberg-Marquardt
//! algorithm*, 1978); its size follows the ratio of actual to predicted reduction (Nielsen, 1999). A trial
//! point whose motion escapes is a rejected step. A step that would make friction negative, or leave the region to
//! which a descent is confined, is recomputed along that border.

use nalgebra::{DMatrix, DVector};

use super::loss::Loss;
use super::observation::{Bound, Observation, R, Region, Residual, Seen, UNKNOWNS, Unknowns};
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
    /// The region that a descent must not leave, if it is confined to one.
    pub within: Option<Region>,
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

    /// Compares the model with the record, and counts the motion.
    ///
    /// # Errors
    /// [`NoFit`] if the motion of the model escapes, or when interrupted.
    pub fn evaluated(
        &self,
        p: &Unknowns,
        derivatives: bool,
        runs: &mut Runs,
    ) -> Result<Seen, NoFit> {
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

    /// Whether a descent may come here.
    fn permits(&self, seen: &Seen) -> bool {
        self.within.is_none_or(|region| region == seen.region)
    }

    /// What a step must not violate: friction is not negative, and the rims around the region are not crossed. A
    /// step goes only a part of the way to a rim.
    fn bounds(&self, p: &Unknowns, seen: &Seen) -> Vec<Bound> {
        const PART: f64 = 0.9;
        let mut bounds = Vec::new();
        if self.free[R] {
            let mut by = [0.0; UNKNOWNS];
            by[R] = 1.0;
            bounds.push((p[R], by));
        }
        if self.within.is_some() {
            let rims = seen.clearances(p, self.observation).into_iter();
            bounds.extend(rims.map(|(value, by)| (PART * value, by)));
        }
        bounds
    }

    /// The point that the linear model predicts after one of the unknowns has moved by an amount: the others follow
    /// so that the loss remains as small as possible, and all remain within bounds.
    pub fn moved(&self, from: &Optimum, unknown: usize, by: f64) -> Option<Unknowns> {
        let columns = self.columns();
        let factor = self.factor(&from.seen, &columns);
        let norms: Vec<f64> =
            (0..columns.len()).map(|column| factor.column(column).norm()).collect();
        let step = Step { factor: &factor, norms: &norms, damping: 1e-12, columns: &columns };
        let (step, _) = step.within(&self.bounds(&from.p, &from.seen), Some((unknown, by)))?;
        let mut p: Unknowns = std::array::from_fn(|place| from.p[place] + step[place]);
        p[unknown] = from.p[unknown] + by;
        p[R] = p[R].max(0.0);
        Some(p)
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
        let mut seen = self.evaluated(&p, true, runs)?;
        if !self.permits(&seen) {
            return Err(NoFit::Lost);
        }
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
                let bounds = self.bounds(&p, &seen);
                let step = Step { factor: &factor, norms: &norms, damping, columns: &columns };
                let Some((step, predicted)) = step.within(&bounds, None) else { break None };
                if predicted <= enough * cost {
                    break None;
                }
                let trial: Unknowns = std::array::from_fn(|place| p[place] + step[place]);
                let found = match self.evaluated(&trial, false, runs) {
                    Err(NoFit::Interrupted) => return Err(NoFit::Interrupted),
                    other => {
                        other.ok().filter(|seen| self.permits(seen)).map(|seen| self.cost(&seen))
                    }
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
            seen = self.evaluated(&p, true, runs)?;
            if settled {
                break;
            }
        }
        Ok(Optimum { p, cost, seen })
    }
}

/// A damped step from a point.
struct Step<'a> {
    /// The triangular factor of the gradients, with the residuals as its last column.
    factor: &'a DMatrix<f64>,
    /// The scales of the unknowns.
    norms: &'a [f64],
    damping: f64,
    columns: &'a [usize],
}

impl Step<'_> {
    /// The step that violates no bound, and the reduction of the loss predicted by the linear model; with one
    /// of the unknowns moved by a given amount, if `moved` says so.
    fn within(&self, bounds: &[Bound], moved: Option<(usize, f64)>) -> Option<(Unknowns, f64)> {
        let unit = |place: usize| {
            let mut by = [0.0; UNKNOWNS];
            by[place] = 1.0;
            by
        };
        let mut fixed: Vec<Bound> =
            moved.into_iter().map(|(place, by)| (-by, unit(place))).collect();
        loop {
            let step = self.solved(&fixed)?;
            let short = |(value, by): &Bound| -> f64 {
                let size: f64 = by.iter().zip(&step).map(|(by, step)| (by * step).abs()).sum();
                let change: f64 = by.iter().zip(&step).map(|(by, step)| by * step).sum();
                if change + value < -1e-9 * size {
                    (change + value) / (size + value.abs())
                } else {
                    0.0
                }
            };
            let free = bounds.iter().filter(|bound| !fixed.contains(bound));
            let worst = free.min_by(|one, other| short(one).total_cmp(&short(other)));
            if let Some(bound) = worst
                && short(bound) < 0.0
                && fixed.len() < self.columns.len()
            {
                fixed.push(*bound);
                continue;
            }
            let width = self.columns.len();
            let along = self.columns.iter().map(|&column| step[column]);
            let gradients = self.factor.columns(0, width);
            let residuals = self.factor.column(width);
            let left = gradients * DVector::from_iterator(width, along) - residuals;
            return Some((step, residuals.norm_squared() - left.norm_squared()));
        }
    }

    /// The step on which these bounds become zero, by rows of overwhelming weight.
    fn solved(&self, fixed: &[Bound]) -> Option<Unknowns> {
        const OVERWHELMING: f64 = 1e7;
        let width = self.columns.len();
        let rows = 2 * width + 1 + fixed.len();
        let mut system = DMatrix::zeros(rows, width);
        let mut target = DVector::zeros(rows);
        let scale = |column: usize| Some(self.norms[column]).filter(|it| *it > 0.0).unwrap_or(1.0);
        for (row, (value, by)) in fixed.iter().enumerate() {
            let sizes = self.columns.iter().enumerate().map(|(i, &c)| by[c].abs() / scale(i));
            let weight = OVERWHELMING / sizes.fold(f64::MIN_POSITIVE, f64::max);
            for (column, &place) in self.columns.iter().enumerate() {
                system[(row, column)] = weight * by[place];
            }
            target[row] = -weight * value;
        }
        let below = fixed.len();
        system.view_mut((below, 0), (width + 1, width)).copy_from(&self.factor.columns(0, width));
        target.rows_mut(below, width + 1).copy_from(&self.factor.column(width));
        for column in 0..width {
            system[(below + width + 1 + column, column)] = self.damping.sqrt() * scale(column);
        }
        let qr = system.qr();
        let solution = qr.r().solve_upper_triangular(&(qr.q().transpose() * target))?;
        let mut step = [0.0; UNKNOWNS];
        for (&column, value) in self.columns.iter().zip(solution.iter()) {
            step[column] = *value;
        }
        // Friction that is set to zero is exactly zero.
        for (value, _) in fixed.iter().filter(|(_, by)| is_friction(by)) {
            step[R] = -value;
        }
        step.iter().all(|value| value.is_finite()).then_some(step)
    }
}

/// Whether a bound is that of friction alone.
fn is_friction(by: &Unknowns) -> bool {
    by[R] == 1.0 && by.iter().filter(|by| **by != 0.0).count() == 1
}
