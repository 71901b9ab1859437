//! A record with what is asked of it, and how well a minimum explains it.

use super::levenberg_marquardt::{Optimum, Task};
use super::loss::Loss;
use super::noise::robust_deviation;
use super::observation::{D2, D3, Data, OMEGA0, Observation, StartKind, UNKNOWNS};
use super::residuals::whiteness;
use crate::numerics::count::real;

/// What the search is told.
#[derive(Clone, Copy, Debug)]
pub struct LeastSquares<'a> {
    /// What was measured.
    pub data: &'a Data,
    /// Which unknowns are free.
    pub free: [bool; UNKNOWNS],
    /// How residuals count.
    pub loss: Loss,
    /// Which residuals count; empty: all.
    pub used: &'a [bool],
    /// Noise of the record as far as it is known beforehand; 0 where it is not.
    pub noise: f64,
    /// A motion larger than this has escaped.
    pub reach: f64,
}

/// What the residuals of a minimum look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// White and small.
    Noise,
    /// Small, with a short memory: filtered noise, or a minimum next to the right one.
    Correlated,
    /// Too large, or swinging with the motion.
    Unexplained,
}

/// Residuals this many times the noise may still be noise: filtered noise hides from second differences.
const HIDDEN: f64 = 4.0;

impl LeastSquares<'_> {
    /// Record and model.
    pub fn observation(&self, start: StartKind) -> Observation {
        let free = |place: usize| self.free[place];
        Observation {
            data: self.data.clone(),
            start,
            linear: !free(D2) && !free(D3),
            reach: self.reach,
        }
    }

    /// What is estimated, and how residuals count.
    pub fn task<'a>(&'a self, observation: &'a Observation) -> Task<'a> {
        let LeastSquares { free, loss, used, .. } = *self;
        Task { observation, free, loss, used, horizon: usize::MAX }
    }

    /// How far the residuals are from noise.
    pub fn verdict(&self, optimum: &Optimum) -> Verdict {
        let Data::Samples { t, .. } = self.data else { return Verdict::Unexplained };
        let residuals: Vec<f64> = self.residuals(optimum).collect();
        let deviation = robust_deviation(residuals.iter().copied());
        // What a robust loss tolerates must not look like a swing.
        let within: Vec<f64> = residuals
            .into_iter()
            .map(|value| value.clamp(-4.0 * deviation, 4.0 * deviation))
            .collect();
        let rate = real(t.len()) / (t[t.len() - 1] - t[0]);
        let found = whiteness(&within, rate * std::f64::consts::TAU / optimum.p[OMEGA0]);
        if found.systematic || !self.is_small(deviation) {
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

    /// Whether the residuals are no larger than noise may be, whatever they look like: those of a coarse converter
    /// are alike where the mass rests.
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
