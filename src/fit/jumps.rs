//! The samples of an acceleration next to its jumps.
//!
//! Friction turns round with the velocity, so the acceleration jumps at every turning point, at the release and at the
//! rest. On which side of a jump a sample lies depends on the unknowns, and no derivative tells of it; and no
//! sensor follows a jump. So the samples next to the jumps are left out.

use super::levenberg_marquardt::{NoFit, Runs};
use super::observation::{Data, LAST, OMEGA0, StartKind};
use super::problem::LeastSquares;
use super::search::Minima;
use super::signal::Signal;
use crate::numerics::count::real;

impl LeastSquares<'_> {
    /// Which samples are far from every jump of the signal: all, unless it is an acceleration. The minima are then
    /// sought again with these samples. Fails with [`NoFit`] when interrupted, or if the motion is lost.
    pub fn smooth(&self, found: &mut Minima, runs: &mut Runs) -> Result<Vec<bool>, NoFit> {
        /// The jumps move as the fit improves.
        const ROUNDS: usize = 2;
        let mut smooth = vec![true; self.data.residuals()];
        let Data::Samples { t, signal: Signal::Acceleration, .. } = self.data else {
            return Ok(smooth);
        };
        for _ in 0..ROUNDS {
            let best = &found.valleys[0].optimum;
            smooth = away_from(&jumps(found, t[0]), t, best.p[OMEGA0]);
            let problem = LeastSquares { used: &smooth, ..*self };
            let observation = problem.observation(found.start);
            let task = problem.task(&observation);
            let optimum = task.solve(best.p, runs)?;
            found.valleys = problem.valleys(&task, vec![optimum], runs)?;
        }
        Ok(smooth)
    }
}

/// The times of the jumps of the best motion.
fn jumps(found: &Minima, first: f64) -> Vec<f64> {
    let best = &found.valleys[0].optimum;
    let (origin, release) = match found.start {
        StartKind::Release => (best.p[LAST], Some(best.p[LAST])),
        StartKind::Moving => (first, None),
    };
    let turns = best.seen.turns.iter().map(|turn| origin + turn.tau / best.p[OMEGA0]);
    release.into_iter().chain(turns).collect()
}

/// Whether each sample is further from the jumps than half a step, and than the phase of a record is uncertain by.
fn away_from(jumps: &[f64], t: &[f64], omega0: f64) -> Vec<bool> {
    /// In radians of the phase.
    const UNCERTAIN: f64 = 0.03;
    let step = (t[t.len() - 1] - t[0]) / real(t.len());
    let near = f64::max(0.5 * step, UNCERTAIN / omega0);
    let mut away = vec![true; t.len()];
    for jump in jumps {
        let range = [jump - near, jump + near].map(|end| t.partition_point(|t| *t <= end));
        away[range[0]..range[1]].fill(false);
    }
    away
}
