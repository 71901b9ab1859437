//! The least-squares problem of a record, and how well a minimum explains the record.

use super::levenberg_marquardt::{Optimum, Task};
use super::loss::Loss;
use super::noise::{IMPOSSIBLE, robust_deviation};
use super::observation::{D2, D3, Data, OMEGA0, Observation, StartKind, UNKNOWNS};
use super::residuals::whiteness;
use crate::numerics::count::real;

/// The least-squares problem of a record.
#[derive(Clone, Copy, Debug)]
pub struct LeastSquares<'a> {
    /// The measured data.
    pub data: &'a Data,
    /// Which unknowns are free.
    pub free: [bool; UNKNOWNS],
    /// How residuals are weighted.
    pub loss: Loss,
    /// Which residuals count; all of them if empty.
    pub used: &'a [bool],
    /// Standard deviation of the noise, if it is known beforehand; else 0.
    pub noise: f64,
    /// Displacement beyond which a motion counts as escaped.
    pub reach: f64,
}

/// What the residuals of a minimum may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
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

impl LeastSquares<'_> {
    /// The record and the model of its start.
    pub fn observation(&self, start: StartKind) -> Observation {
        let free = |place: usize| self.free[place];
        Observation {
            data: self.data.clone(),
            start,
            linear: !free(D2) && !free(D3),
            reach: self.reach,
        }
    }

    /// The task of minimizing the loss.
    pub fn task<'a>(&'a self, observation: &'a Observation) -> Task<'a> {
        let LeastSquares { free, loss, used, .. } = *self;
        Task { observation, free, loss, used, horizon: usize::MAX, within: None }
    }

    /// Whether the residuals look like noise.
    pub fn verdict(&self, optimum: &Optimum) -> Verdict {
        let Data::Samples { t, .. } = self.data else { return Verdict::Unexplained };
        let residuals: Vec<f64> = self.residuals(optimum).collect();
        let deviation = robust_deviation(residuals.iter().copied());
        // Outliers that a robust loss tolerates must not look like an oscillation.
        let within: Vec<f64> = residuals
            .into_iter()
            .map(|value| value.clamp(-4.0 * deviation, 4.0 * deviation))
            .collect();
        let rate = real(t.len()) / (t[t.len() - 1] - t[0]);
        let found = whiteness(&within, rate * std::f64::consts::TAU / optimum.p[OMEGA0]);
        let is_far = |value: &f64| value.abs() > IMPOSSIBLE * deviation;
        let runs_off = longest_run(self.residuals(optimum).map(|value| is_far(&value))) >= RUN;
        if found.systematic || runs_off || !self.is_small(deviation) {
            Verdict::Unexplained
        } else if found.white {
            Verdict::Noise
        } else {
            Verdict::Correlated
        }
    }

    fn is_small(&self, deviation: f64) -> bool {
        deviation <= HIDDEN * self.noise
    }

    /// Whether the residuals are no larger than noise may be. Their correlation does not matter, since those of
    /// a coarse converter are all equal while the mass rests.
    pub fn comes_near(&self, optimum: &Optimum) -> bool {
        let squares = self.residuals(optimum).map(|it| it * it);
        let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), it| (sum + it, count + 1.0));
        self.is_small((sum / count).sqrt())
    }

    /// The residuals that count.
    fn residuals(&self, optimum: &Optimum) -> impl Iterator<Item = f64> {
        let used = |index: &usize| self.used.get(*index).copied().unwrap_or(true);
        let each = optimum.seen.residuals.iter().enumerate();
        each.filter(move |(index, _)| used(index)).map(|(_, residual)| residual.value)
    }

    /// Whether the residuals may be noise.
    pub fn explains(&self, optimum: &Optimum) -> bool {
        self.verdict(optimum) != Verdict::Unexplained
    }
}
