//! Nonlinear least squares with exact gradients: the Levenberg-Marquardt method on a QR factor.
//!
//! Each set of gradients is factored once; every damping that is tried costs another factorization of at most
//! 17 rows. The damping is scaled by the largest column norms so far (More, *The Levenberg-Marquardt
//! algorithm*, 1978); its size follows the ratio of actual to predicted reduction (Nielsen, 1999). A trial
//! point whose motion escapes is a rejected step. A step that would make friction negative, or leave the region to
//! which a descent is confined, is recomputed along that border.

use nalgebra::{DMatrix, DVector};

use super::{
    Bound, Optimum, R, Runs, Seen, Task, UNKNOWNS, Unfit, Unknowns, interrupted, moved, scattered,
};
use crate::numerics::count::real;
use crate::numerics::elementary::powi;

/// Maximum number of iterations.
const MOST: usize = 50;

/// Maximum number of iterations for a rough answer.
const FEW: usize = 12;

/// Relative reduction of the loss below which the iteration has converged.
const SETTLED: f64 = 1e-10;

impl Task<'_> {
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
    pub fn followed(&self, from: &Optimum, unknown: usize, by: f64) -> Option<Unknowns> {
        let (columns, factor) = (self.columns(), self.factor(&from.seen));
        let norms = norms(&factor);
        let step = DampedStep { factor: &factor, norms: &norms, damping: 1e-12, columns: &columns };
        let (step, _) = step.within(&self.bounds(&from.p, &from.seen), Some((unknown, by)))?;
        let mut p = moved(&from.p, 1.0, &step);
        p[unknown] = from.p[unknown] + by;
        p[R] = p[R].max(0.0);
        Some(p)
    }

    /// Iterates from a first guess.
    ///
    /// # Errors
    /// [`Unfit`] if even the guess cannot be compared with the record.
    pub fn solve(&self, guess: Unknowns, runs: &mut Runs) -> Result<Optimum, Unfit> {
        self.solve_within(SETTLED, MOST, guess, runs)
    }

    /// The same to a fraction of a standard error, which suffices for a start or for the profile of the loss.
    ///
    /// # Errors
    /// As [`Task::solve`].
    pub fn solve_roughly(&self, guess: Unknowns, runs: &mut Runs) -> Result<Optimum, Unfit> {
        self.solve_within(0.01 / real(self.observation.data.residuals().max(1)), FEW, guess, runs)
    }

    fn solve_within(
        &self,
        enough: f64,
        most: usize,
        guess: Unknowns,
        runs: &mut Runs,
    ) -> Result<Optimum, Unfit> {
        let mut p = guess;
        let mut seen = self.evaluated(&p, true, runs)?;
        if !self.permits(&seen) {
            return Err(Unfit::NoMotion);
        }
        let mut cost = self.cost(&seen);
        let columns = self.columns();
        let mut largest = vec![0.0_f64; columns.len()];
        let (mut damping, mut grow) = (1e-4, 2.0);
        for _ in 0..if columns.is_empty() { 0 } else { most } {
            let factor = self.factor(&seen);
            for (largest, norm) in largest.iter_mut().zip(norms(&factor)) {
                *largest = largest.max(norm);
            }
            let taken = loop {
                let bounds = self.bounds(&p, &seen);
                let step =
                    DampedStep { factor: &factor, norms: &largest, damping, columns: &columns };
                let Some((step, predicted)) = step.within(&bounds, None) else { break None };
                if predicted <= enough * cost {
                    break None;
                }
                let trial = moved(&p, 1.0, &step);
                let found = interrupted(self.evaluated(&trial, false, runs))?;
                let found = found.filter(|seen| self.permits(seen)).map(|seen| self.cost(&seen));
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
        Ok(Optimum { start: self.observation.start, p, cost, seen })
    }
}

/// The scales of the unknowns.
fn norms(factor: &DMatrix<f64>) -> Vec<f64> {
    (0..factor.ncols() - 1).map(|column| factor.column(column).norm()).collect()
}

/// A damped step from a point.
struct DampedStep<'a> {
    /// The triangular factor of the gradients, with the residuals as its last column.
    factor: &'a DMatrix<f64>,
    /// The scales of the unknowns.
    norms: &'a [f64],
    damping: f64,
    columns: &'a [usize],
}

impl DampedStep<'_> {
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
        let mut step = scattered(self.columns, &solution);
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
