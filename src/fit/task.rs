//! What is estimated from a record, how well a motion explains it, and the descent to the motion that explains it best.
//!
//! The descent is nonlinear least squares with exact gradients: the Levenberg-Marquardt method on a QR factor.
//! Each set of gradients is factored once; every damping that is tried costs another factorization of some twenty
//! rows. The damping is scaled by the largest column norms so far (More, *The Levenberg-Marquardt
//! algorithm*, 1978); its size follows the ratio of actual to predicted reduction (Nielsen, 1999). A trial
//! point whose motion escapes is a rejected step. A step that would make friction negative, or leave the region to
//! which a descent is confined, is recomputed along that border.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::{
    BEND, Bound, IMPOSSIBLE, Loss, OMEGA0, R, Record, Region, Residual, SLOPE, Seen, StartKind,
    UNKNOWNS, Unfit, Unknowns, UnknownsMatrix, Way, direction, robust_deviation, whiteness,
};
use crate::numerics::{powi, real};

/// Counters of the computation, and the check for an interruption.
pub struct Runs<'a> {
    /// Number of motions computed with derivatives.
    pub with_derivatives: u64,
    /// Number of motions computed without derivatives.
    pub plain: u64,
    /// Number of motions after which the computation ends.
    pub most: u64,
    /// Called before each motion; `true` ends the computation.
    pub interrupted: &'a dyn Fn() -> bool,
    /// The smallest root mean square of residuals that a descent has reached.
    pub closest: f64,
}

impl<'a> Runs<'a> {
    /// Counters at zero, without an end.
    pub fn new(interrupted: &'a dyn Fn() -> bool) -> Self {
        let (most, closest) = (u64::MAX, f64::INFINITY);
        Runs { with_derivatives: 0, plain: 0, most, interrupted, closest }
    }
}

/// The result, if there is one. The end of the computation remains an error.
///
/// # Errors
/// [`Unfit::Interrupted`] and [`Unfit::GaveUp`].
pub fn interrupted<T>(result: Result<T, Unfit>) -> Result<Option<T>, Unfit> {
    match result {
        Err(end @ (Unfit::Interrupted | Unfit::GaveUp { .. })) => Err(end),
        other => Ok(other.ok()),
    }
}

/// The point at which a descent ended.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// How the motion begins.
    pub start: StartKind,
    /// The unknowns.
    pub p: Unknowns,
    /// The loss, in squared units of the residuals.
    pub cost: f64,
    /// The model compared with the record, with derivatives.
    pub seen: Seen,
}

impl Optimum {
    /// The lower of two minima with the same start.
    pub fn or_lower(self, other: Option<Optimum>) -> Self {
        other.filter(|other| other.cost < self.cost).unwrap_or(self)
    }
}

/// Why a sample does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dropped {
    /// It cannot belong to the motion.
    Outlier,
    /// It is flattened at full scale, or next to such samples.
    Saturated,
    /// The mass had not yet been struck.
    Before,
    /// The mass had been excited again.
    After,
    /// It lies next to a jump of an acceleration.
    Jump,
    /// At rest, it only repeats the rounding error of others.
    Alike,
}

impl Dropped {
    /// Whether it is no part of what was fitted.
    pub fn is_outside(self) -> bool {
        matches!(self, Dropped::Saturated | Dropped::Before | Dropped::After)
    }
}

/// What is estimated from a record, and how residuals are weighted.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// What was measured.
    pub data: &'a Record,
    /// How the motion begins.
    pub start: StartKind,
    /// Displacement beyond which a motion counts as escaped.
    pub reach: f64,
    /// Which unknowns are free.
    pub free: [bool; UNKNOWNS],
    /// How residuals are weighted.
    pub loss: Loss,
    /// Why residuals do not count; `None` for those that do, and empty if all do.
    pub dropped: &'a [Option<Dropped>],
    /// Standard deviation of the noise, if it is known beforehand; else 0.
    pub noise: f64,
    /// Only this many residuals, from the first on, count.
    pub horizon: usize,
    /// The region that a descent must not leave, if it is confined to one.
    pub within: Option<Region>,
}

/// The weighted residuals as linear functions of the free unknowns, up to an orthogonal map: `turned - upper step`, and
/// one more that no step changes.
#[derive(Clone, Debug, Default)]
pub struct LinearResiduals {
    /// A triangular matrix.
    pub upper: UnknownsMatrix,
    /// What becomes of the residuals.
    pub turned: Unknowns,
    /// The one that no step changes.
    pub left: f64,
}

/// What the residuals of a minimum may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitVerdict {
    /// White and small.
    Noise,
    /// Small, with short-range correlation: filtered noise, or a minimum next to the right one.
    Correlated,
    /// Too large, or oscillating with the motion.
    Unexplained,
}

/// Residuals up to this many times the noise of neighbouring differences may still be noise, since these underestimate
/// filtered noise.
pub const HIDDEN: f64 = 3.0;

/// So many samples in a row that do not belong to the motion are no outliers: then the motion is wrong.
pub const RUN: usize = 5;

/// The length of the longest run of `true`.
pub fn longest_run(flags: impl Iterator<Item = bool>) -> usize {
    let (longest, _) = flags.fold((0, 0), |(longest, run), flag| {
        let run = if flag { run + 1 } else { 0 };
        (longest.max(run), run)
    });
    longest
}

impl<'a> Task<'a> {
    /// All unknowns and residuals of a record, of which nothing else is known.
    pub fn new(data: &'a Record, start: StartKind, free: [bool; UNKNOWNS], reach: f64) -> Self {
        let (loss, dropped, noise) = (Loss::LINEAR, &[][..], 0.0);
        Task { data, start, reach, free, loss, dropped, noise, horizon: usize::MAX, within: None }
    }

    /// The same for a motion that begins in this way.
    pub fn starting(self, start: StartKind) -> Self {
        Task { start, ..self }
    }

    /// The same within the region of a motion.
    pub fn around(self, seen: &Seen) -> Self {
        Task { within: Some(seen.region), ..self }
    }

    /// The same with one of the unknowns held.
    pub fn holding(mut self, place: usize) -> Self {
        self.free[place] = false;
        self
    }

    /// The same with a drift of the zero.
    pub fn with_drift(mut self) -> Self {
        (self.free[SLOPE], self.free[BEND]) = (true, true);
        self
    }

    fn counts(&self, index: usize) -> bool {
        index < self.horizon && self.dropped.get(index).is_none_or(Option::is_none)
    }

    /// The residuals that count.
    pub fn used_residuals<'s>(&self, seen: &'s Seen) -> impl Iterator<Item = &'s Residual> {
        let used = seen.residuals.iter().enumerate().filter(|(index, _)| self.counts(*index));
        used.map(|(_, residual)| residual)
    }

    /// The values of the residuals that count.
    pub fn values(&self, seen: &Seen) -> Vec<f64> {
        self.used_residuals(seen).map(|residual| residual.value).collect()
    }

    /// The loss of a motion.
    pub fn cost(&self, seen: &Seen) -> f64 {
        self.used_residuals(seen).map(|residual| self.loss.of(residual.value)).sum()
    }

    /// The loss of one residual of many.
    pub fn unit(&self, cost: f64) -> f64 {
        cost / real(self.data.residuals().max(1))
    }

    /// Compares the model with the record, and counts the motion.
    ///
    /// # Errors
    /// [`Unfit`] if the motion of the model escapes, or when interrupted.
    pub fn evaluated(
        &self,
        p: &Unknowns,
        with_derivatives: bool,
        runs: &mut Runs,
    ) -> Result<Seen, Unfit> {
        if (runs.interrupted)() {
            return Err(Unfit::Interrupted);
        }
        if runs.with_derivatives + runs.plain >= runs.most {
            return Err(Unfit::GaveUp { motions: runs.most, closest: runs.closest });
        }
        *(if with_derivatives { &mut runs.with_derivatives } else { &mut runs.plain }) += 1;
        let way = Way { with_derivatives, reach: self.reach, ..Way::default() };
        self.data.compare(self.start, p, way).map_err(|_| Unfit::NoMotion)
    }

    /// The places of the free unknowns.
    pub fn columns(&self) -> impl Iterator<Item = usize> {
        let free = self.free;
        (0..UNKNOWNS).filter(move |place| free[*place])
    }

    /// One for each unknown that is held, in the diagonal.
    pub fn held(&self) -> UnknownsMatrix {
        UnknownsMatrix::from_diagonal(&Unknowns::from_fn(|place, _| f64::from(!self.free[place])))
    }

    /// The derivatives by the free unknowns, with zeros for those that are held.
    pub fn by_free(&self, by: &Unknowns) -> Unknowns {
        Unknowns::from_fn(|place, _| if self.free[place] { by[place] } else { 0.0 })
    }

    /// The triangular factor of the weighted gradients of the free unknowns, and the vector to which the orthogonal factor
    /// turns the residuals, with what is left of them beyond. Each held unknown has a row of its own, a unit vector.
    pub fn factor(&self, seen: &Seen) -> LinearResiduals {
        /// Number of rows that are factored together, few enough to stay in the cache.
        const BLOCK: usize = 128;
        const WIDTH: usize = UNKNOWNS + 1;
        let mut factor = SMatrix::<f64, WIDTH, WIDTH>::zeros();
        factor.fixed_view_mut::<UNKNOWNS, UNKNOWNS>(0, 0).copy_from(&self.held());
        for (number, residuals) in seen.residuals.chunks(BLOCK).enumerate() {
            // The orthogonal factor is never formed: the residuals, to which it would be applied, are the last column.
            let mut block = DMatrix::zeros(WIDTH + residuals.len(), WIDTH);
            block.rows_mut(0, WIDTH).copy_from(&factor);
            for (row, it) in residuals.iter().enumerate() {
                if self.counts(number * BLOCK + row) {
                    let root = self.loss.weight(it.value).sqrt();
                    for place in self.columns() {
                        block[(WIDTH + row, place)] = root * it.by[place];
                    }
                    block[(WIDTH + row, UNKNOWNS)] = root * it.value;
                }
            }
            factor.copy_from(&block.qr().r().rows(0, WIDTH));
        }
        LinearResiduals {
            upper: factor.fixed_view::<UNKNOWNS, UNKNOWNS>(0, 0).into_owned(),
            turned: factor.fixed_view::<UNKNOWNS, 1>(0, UNKNOWNS).into_owned(),
            left: factor[(UNKNOWNS, UNKNOWNS)],
        }
    }

    /// The rows of Q if the weighted gradients of the residuals that count are `Q U`, with an orthogonal Q and a
    /// triangular U.
    pub fn directions(&self, seen: &Seen) -> Vec<Unknowns> {
        let lower = self.factor(seen).upper.transpose();
        let row = |it: &Residual| {
            let row = self.loss.weight(it.value).sqrt() * self.by_free(&it.by);
            lower.solve_lower_triangular(&row).unwrap_or_default()
        };
        self.used_residuals(seen).map(row).collect()
    }

    /// Whether the residuals look like noise.
    pub fn verdict(&self, optimum: &Optimum) -> FitVerdict {
        if self.data.has_peaks() {
            return FitVerdict::Unexplained;
        }
        let residuals = self.values(&optimum.seen);
        let deviation = robust_deviation(residuals.iter().copied());
        // Outliers that a robust loss tolerates must not look like an oscillation.
        let within = residuals.iter().map(|value| value.clamp(-4.0 * deviation, 4.0 * deviation));
        let period = self.data.samples_per_period(optimum.p[OMEGA0]);
        let found = whiteness(&within.collect::<Vec<_>>(), period);
        let is_far = |value: &f64| value.abs() > IMPOSSIBLE * deviation;
        let runs_off = longest_run(residuals.iter().map(is_far)) >= RUN;
        if found.systematic || runs_off || !self.is_small(deviation) {
            FitVerdict::Unexplained
        } else if found.white {
            FitVerdict::Noise
        } else {
            FitVerdict::Correlated
        }
    }

    fn is_small(&self, deviation: f64) -> bool {
        deviation <= HIDDEN * self.noise
    }

    /// Whether the residuals are no larger than noise may be. Their correlation does not matter, since those of
    /// a coarse converter are all equal while the mass rests.
    pub fn comes_near(&self, optimum: &Optimum) -> bool {
        self.is_small(mean_square(&self.values(&optimum.seen)).sqrt())
    }

    /// Whether the residuals may be noise.
    pub fn explains(&self, optimum: &Optimum) -> bool {
        self.verdict(optimum) != FitVerdict::Unexplained
    }
}

/// The mean of the squares of values.
pub fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|it| it * it).sum::<f64>() / real(values.len())
}

/// Maximum number of iterations.
const MOST: usize = 50;

/// Maximum number of iterations for a rough answer.
const FEW: usize = 12;

/// Relative reduction of the loss below which the iteration has converged.
const SETTLED: f64 = 1e-10;

impl Task<'_> {
    /// What a step must not violate: friction is not negative, and the rims around the region are not crossed. A
    /// step goes only a part of the way to a rim.
    fn bounds(&self, p: &Unknowns, seen: &Seen) -> Vec<Bound> {
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
        self.solve_within(self.unit(0.01), FEW, guess, runs)
    }

    fn solve_within(
        &self,
        enough: f64,
        most: usize,
        guess: Unknowns,
        runs: &mut Runs,
    ) -> Result<Optimum, Unfit> {
        // A descent may not leave its region.
        let permits = |seen: &Seen| self.within.is_none_or(|region| region == seen.region);
        let mut p = guess;
        let mut seen = self.evaluated(&p, true, runs)?;
        if !permits(&seen) {
            return Err(Unfit::NoMotion);
        }
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
                let found = interrupted(self.evaluated(&trial, false, runs))?;
                let found = found.filter(permits).map(|seen| self.cost(&seen));
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
            model.renew(self.factor(&seen));
        }
        Ok(Optimum { start: self.start, p, cost, seen })
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
    fn of(task: &Task, seen: &Seen) -> Self {
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
    /// that the linear model predicts; `None` where all unknowns are held.
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
                if left < -1e-9 * size { left / (size + value.abs()) } else { 0.0 }
            };
            let free = bounds.iter().filter(|bound| !fixed.contains(bound));
            let worst = free.min_by(|one, other| short(one).total_cmp(&short(other)));
            let worst = worst.filter(|bound| short(bound) < 0.0 && fixed.len() < self.free);
            if let Some(bound) = worst {
                fixed.push(*bound);
                continue;
            }
            let LinearResiduals { upper, turned, .. } = &self.residuals;
            return Some((step, turned.norm_squared() - (upper * step - turned).norm_squared()));
        }
    }

    /// The step on which these bounds become zero, by rows of overwhelming weight.
    fn solved(&self, damping: f64, fixed: &[Bound]) -> Option<Unknowns> {
        const OVERWHELMING: f64 = 1e7;
        if self.free == 0 {
            return None;
        }
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
