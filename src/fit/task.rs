//! What is estimated from a record, and how well a motion explains it.

use std::cell::{Cell, OnceCell};

use nalgebra::{DMatrix, SMatrix};

use super::{
    BEND, IMPOSSIBLE, Loss, Misfit, NoEstimate, OMEGA0, Record, Region, Residual, SLOPE, StartKind,
    UNKNOWNS, Unknowns, UnknownsMatrix, Way, mean_square, robust_deviation, whiteness,
};
use crate::numerics::real;

/// Counters of the computation, and the check for an interruption. All tasks of a fit count together.
pub struct Runs<'a> {
    /// Number of motions computed with derivatives.
    pub with_derivatives: Cell<u64>,
    /// Number of motions computed without derivatives.
    pub plain: Cell<u64>,
    /// Number of motions after which the computation ends.
    pub most: u64,
    /// Called before each motion; `true` ends the computation.
    pub interrupted: &'a dyn Fn() -> bool,
    /// The smallest root mean square of residuals that a descent has reached.
    pub closest: Cell<f64>,
    /// Why the computation has ended, if it has: from then on there are no more motions.
    pub(super) end: OnceCell<NoEstimate>,
}

impl<'a> Runs<'a> {
    /// Counters at zero, without an end.
    pub fn new(interrupted: &'a dyn Fn() -> bool) -> Self {
        let (with_derivatives, plain) = (Cell::default(), Cell::default());
        let (most, closest) = (u64::MAX, Cell::new(f64::INFINITY));
        Runs { with_derivatives, plain, most, interrupted, closest, end: OnceCell::new() }
    }

    /// Why the computation has ended, if it has.
    pub fn ended(&self) -> Option<NoEstimate> {
        self.end.get().cloned()
    }

    /// Whether it has.
    pub fn has_ended(&self) -> bool {
        self.end.get().is_some()
    }

    /// Counts a motion, if there may be another one.
    fn count(&self, with_derivatives: bool) -> Option<()> {
        let (with, plain) = (&self.with_derivatives, &self.plain);
        if (self.interrupted)() {
            self.end.get_or_init(|| NoEstimate::Interrupted);
        } else if with.get() + plain.get() >= self.most {
            let (motions, closest) = (self.most, self.closest.get());
            self.end.get_or_init(|| NoEstimate::GaveUp { motions, closest });
        }
        let counter = if with_derivatives { with } else { plain };
        counter.set(counter.get() + 1);
        (!self.has_ended()).then_some(())
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
    pub seen: Misfit,
}

/// Why a sample does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DropReason {
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

impl DropReason {
    /// Whether it is no part of what was fitted.
    pub fn is_outside(self) -> bool {
        matches!(self, DropReason::Saturated | DropReason::Before | DropReason::After)
    }
}

/// What is estimated from a record, and how residuals are weighted.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// What counts its motions.
    pub runs: &'a Runs<'a>,
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
    pub dropped: &'a [Option<DropReason>],
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
    /// All unknowns and residuals of a record that begins with a release, of which nothing else is known.
    pub fn new(data: &'a Record, runs: &'a Runs<'a>) -> Self {
        let (start, free, within) = (StartKind::Release, [true; UNKNOWNS], None);
        let (reach, horizon, noise) = (f64::MAX, usize::MAX, 0.0);
        let (loss, dropped) = (Loss::LINEAR, &[][..]);
        Task { runs, data, start, reach, free, loss, dropped, noise, horizon, within }
    }

    /// The same for a motion that begins in this way.
    pub fn starting(self, start: StartKind) -> Self {
        Task { start, ..self }
    }

    /// The same within the region of a motion.
    pub fn around(self, seen: &Misfit) -> Self {
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
    pub fn used_residuals<'s>(&self, seen: &'s Misfit) -> impl Iterator<Item = &'s Residual> {
        let used = seen.residuals.iter().enumerate().filter(|(index, _)| self.counts(*index));
        used.map(|(_, residual)| residual)
    }

    /// The values of the residuals that count.
    pub fn values(&self, seen: &Misfit) -> Vec<f64> {
        self.used_residuals(seen).map(|residual| residual.value).collect()
    }

    /// The loss of a motion.
    pub fn cost(&self, seen: &Misfit) -> f64 {
        self.used_residuals(seen).map(|residual| self.loss.of(residual.value)).sum()
    }

    /// The loss of one residual of many.
    pub fn unit(&self, cost: f64) -> f64 {
        cost / real(self.data.residuals())
    }

    /// Compares the model with the record, and counts the motion; `None` if the motion of the model escapes, or if the
    /// computation has ended.
    pub fn evaluated(&self, p: &Unknowns, with_derivatives: bool) -> Option<Misfit> {
        self.runs.count(with_derivatives)?;
        let way = Way { with_derivatives, reach: self.reach, ..Way::default() };
        self.data.compare(self.start, p, way).ok()
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
    pub fn factor(&self, seen: &Misfit) -> LinearResiduals {
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
    pub fn directions(&self, seen: &Misfit) -> Vec<Unknowns> {
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
