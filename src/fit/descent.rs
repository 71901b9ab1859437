//! The descent to the motion that explains a record best: nonlinear least squares with exact gradients, by the
//! Levenberg-Marquardt method on a QR factor.
//!
//! Each set of gradients is factored once; every damping that is tried costs another factorization of some twenty
//! rows. The damping is scaled by the largest column norms so far (More, *The Levenberg-Marquardt
//! algorithm*, 1978); its size follows the ratio of actual to predicted reduction (Nielsen, 1999). A trial
//! point whose motion escapes is a rejected step. A step that would make friction negative, or leave the region to
//! which a descent is confined, is recomputed along that border.

use nalgebra::{DMatrix, DVector};

use super::{
    Bound, LinearResiduals, Misfit, Optimum, R, Task, UNKNOWNS, Unknowns, UnknownsMatrix, direction,
};
use crate::numerics::powi;

/// Maximum number of iterations.
const MOST: usize = 50;

/// Maximum number of iterations for a rough answer.
const FEW: usize = 12;

/// Relative reduction of the loss below which the iteration has converged.
const SETTLED: f64 = 1e-10;

impl Task<'_> {
    /// What a step must not violate: friction is not negative, and the rims around the region are not crossed. A
    /// step goes only a part of the way to a rim.
    fn bounds(&self, p: &Unknowns, seen: &Misfit) -> Vec<Bound> {
        const PART: f64 = 0.9;
        let mut bounds = Vec::new();
        if self.free[R] {
            bounds.push((p[R], direction(R)));
        }
        if self.within.is_some() {
            let rims = seen.clearances(p, self.data, self.start).into_iter();
            bounds.extend(rims.map(|(value, by)| (PART * value, self.by_free(&by))));
        }
        bounds
    }

    /// The point that the linear model predicts after one of the unknowns has moved by an amount: the others follow
    /// so that the loss remains as small as possible, and all remain within bounds.
    pub fn followed(&self, from: &Optimum, unknown: usize, by: f64) -> Option<Unknowns> {
        let model = LinearModel::of(self, &from.seen);
        let bounds = self.bounds(&from.p, &from.seen);
        let (step, _) = model.step(1e-12, &bounds, vec![(-by, direction(unknown))])?;
        let mut p = from.p + step;
        p[unknown] = from.p[unknown] + by;
        p[R] = p[R].max(0.0);
        Some(p)
    }

    /// Iterates from a first guess; `None` if even that cannot be compared with the record, or if the computation has
    /// ended.
    pub fn solve(&self, guess: Unknowns) -> Option<Optimum> {
        self.solve_within(SETTLED, MOST, guess)
    }

    /// The same to a fraction of a standard error, which suffices for a start or for the profile of the loss.
    pub fn solve_roughly(&self, guess: Unknowns) -> Option<Optimum> {
        self.solve_within(self.unit(0.01), FEW, guess)
    }

    fn solve_within(&self, enough: f64, most: usize, mut p: Unknowns) -> Option<Optimum> {
        // A descent may not leave its region.
        let permits = |seen: &Misfit| self.within.is_none_or(|region| region == seen.region);
        let mut seen = self.evaluated(&p, true).filter(permits)?;
        let mut cost = self.cost(&seen);
        let mut model = LinearModel::of(self, &seen);
        let (mut damping, mut grow) = (1e-4, 2.0);
        for _ in 0..most {
            let bounds = self.bounds(&p, &seen);
            let taken = loop {
                let step = model.step(damping, &bounds, Vec::new());
                let Some((step, predicted)) = step.filter(|it| it.1 > enough * cost) else {
                    break None;
                };
                let trial = p + step;
                let found = self.evaluated(&trial, false).filter(permits);
                let found = found.map(|seen| self.cost(&seen));
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
            let settled = cost - found <= enough * cost;
            (p, cost) = (trial, found);
            seen = self.evaluated(&p, true)?;
            if settled {
                break;
            }
            model.renew(self.factor(&seen));
        }
        let found = Optimum { start: self.start, p, cost, seen };
        Some(found).filter(|_| !self.runs.has_ended())
    }
}

/// The residuals as linear functions of the free unknowns about a point.
struct LinearModel {
    /// The number of free unknowns.
    free: usize,
    residuals: LinearResiduals,
    /// The scales of the unknowns: the largest norms of their gradients so far.
    norms: Unknowns,
}

impl LinearModel {
    fn of(task: &Task, seen: &Misfit) -> Self {
        let (free, norms) = (task.columns().count(), Unknowns::zeros());
        let mut model = LinearModel { free, residuals: LinearResiduals::default(), norms };
        model.renew(task.factor(seen));
        model
    }

    /// The same about another point.
    fn renew(&mut self, residuals: LinearResiduals) {
        for (largest, column) in self.norms.iter_mut().zip(residuals.upper.column_iter()) {
            *largest = largest.max(column.norm());
        }
        self.residuals = residuals;
    }

    /// The damped step that violates no bound and on which those in `fixed` become zero, and the reduction of the loss
    /// that the linear model predicts; `None` where it predicts none.
    fn step(
        &self,
        damping: f64,
        bounds: &[Bound],
        mut fixed: Vec<Bound>,
    ) -> Option<(Unknowns, f64)> {
        loop {
            let step = self.solved(damping, &fixed)?;
            let short = |(value, by): &Bound| -> f64 {
                let size = by.component_mul(&step).abs().sum();
                let left = by.dot(&step) + value;
                if left < -1e-9 * size {
                    left / (size + value.abs())
                } else {
                    0.0
                }
            };
            let free = bounds.iter().filter(|bound| !fixed.contains(bound));
            let worst = free.min_by(|one, other| short(one).total_cmp(&short(other)));
            let worst = worst.filter(|bound| short(bound) < 0.0 && fixed.len() < self.free);
            let Some(bound) = worst else {
                let LinearResiduals { upper, turned, .. } = &self.residuals;
                let left = (upper * step - turned).norm_squared();
                return Some((step, turned.norm_squared() - left));
            };
            fixed.push(*bound);
        }
    }

    /// The step on which these bounds become zero, by rows of overwhelming weight.
    fn solved(&self, damping: f64, fixed: &[Bound]) -> Option<Unknowns> {
        const OVERWHELMING: f64 = 1e7;
        let scales = self.norms.map(|norm| if norm > 0.0 { norm } else { 1.0 });
        let mut system = DMatrix::zeros(fixed.len() + 2 * UNKNOWNS, UNKNOWNS);
        let mut target = DVector::zeros(system.nrows());
        for (row, (value, by)) in fixed.iter().enumerate() {
            let weight = OVERWHELMING / by.component_div(&scales).amax().max(f64::MIN_POSITIVE);
            system.row_mut(row).copy_from(&(weight * by.transpose()));
            target[row] = -weight * value;
        }
        let LinearResiduals { upper, turned, .. } = &self.residuals;
        system.rows_mut(fixed.len(), UNKNOWNS).copy_from(upper);
        target.rows_mut(fixed.len(), UNKNOWNS).copy_from(turned);
        let damped = UnknownsMatrix::from_diagonal(&(damping.sqrt() * scales));
        system.rows_mut(fixed.len() + UNKNOWNS, UNKNOWNS).copy_from(&damped);
        let qr = system.qr();
        let solution = qr.r().solve_upper_triangular(&(qr.q().transpose() * target))?;
        let mut step = Unknowns::from_column_slice(solution.as_slice());
        // Friction that is set to zero is exactly zero.
        for (value, _) in fixed.iter().filter(|(_, by)| *by == direction(R)) {
            step[R] = -value;
        }
        step.iter().all(|value| value.is_finite()).then_some(step)
    }
}
