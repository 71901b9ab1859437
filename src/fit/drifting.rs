//! Fits with a drift of the zero, where the record shows one.

use super::drift::{LeftDrift, independent};
use super::levenberg_marquardt::{NoFit, Runs, interrupted};
use super::observation::{BEND, SLOPE, UNKNOWNS};
use super::problem::LeastSquares;
use super::search::{Beginning, Minima};
use super::uncertainty::Covariance;
use crate::numerics::count::real;
use crate::numerics::elementary::powi;

impl LeastSquares<'_> {
    /// The minima with a drift of the zero, and which unknowns are then free, if it is real; `guessed` makes first
    /// guesses with a drift.
    ///
    /// Asked are records that may show a drift or are not explained without one. With it they must be explained, and
    /// chi-squared must fall by more than chance allows. Fails with [`NoFit::Interrupted`].
    pub fn drifting(
        &self,
        found: &Minima,
        guessed: impl FnOnce() -> Vec<Beginning>,
        runs: &mut Runs,
    ) -> Result<Option<(Minima, [bool; UNKNOWNS])>, NoFit> {
        /// Fall of chi-squared below which a line does as well as a parabola.
        const NOTHING: f64 = 4.0;
        /// Evidence by the linear model, which chance exceeds once in ten records, from which a drift is tried: motions
        /// with it may lie in other regions, where the linear model does not lead.
        const ASKED: f64 = 4.6;
        /// Fall of chi-squared from which it is fitted. Chance exceeds it seven times in a thousand, and then two
        /// unknowns too many only widen the intervals.
        const FITTED: f64 = 10.0;
        /// By this factor a descent comes much closer.
        const MUCH: f64 = 4.0;
        let observation = self.observation(found.start);
        let task = self.task(&observation);
        let best = &found.valleys[0].optimum;
        let Some((drift, step)) = LeftDrift::with_step(&task, best) else { return Ok(None) };
        if drift.evidence < ASKED && self.explains(best) {
            return Ok(None);
        }
        let mut beginnings = guessed();
        let stepped = std::array::from_fn(|place| best.p[place] + step[place]);
        let known = Beginning { start: found.start, certain: true, guesses: vec![stepped, best.p] };
        match beginnings.iter_mut().find(|beginning| beginning.start == found.start) {
            Some(beginning) => beginning.guesses.extend(known.guesses),
            None => beginnings.push(known),
        }
        let mut wider = *self;
        (wider.free[SLOPE], wider.free[BEND]) = (true, true);
        // Only where a first descent comes much closer, or explains the record, is it worth the search.
        let mut helps = false;
        for (start, guess, _) in wider.ranked(&beginnings, runs)? {
            let observation = wider.observation(start);
            let tried = interrupted(wider.task(&observation).solve(guess, runs))?;
            helps |= tried.is_ok_and(|it| MUCH * it.cost < best.cost || wider.explains(&it));
        }
        if !helps {
            return Ok(None);
        }
        let mut drifting = match wider.search(&beginnings, runs) {
            Ok(drifting) => drifting,
            Err(NoFit::Lost) => return Ok(None),
            Err(NoFit::Interrupted) => return Err(NoFit::Interrupted),
        };
        let least = &drifting.valleys[0].optimum;
        let observation = self.observation(drifting.start);
        let task = wider.task(&observation);
        let values: Vec<f64> = task.used_residuals(&least.seen).iter().map(|it| it.value).collect();
        let unit = least.cost / real(values.len()) / independent(&values);
        if best.cost - least.cost <= FITTED * unit || !wider.explains(least) {
            return Ok(None);
        }
        let bend = Covariance::at(&task, least, &[]).map_or(0.0, |it| it.of(BEND, BEND));
        if powi(least.p[BEND], 2) <= NOTHING * bend / independent(&values) {
            wider.free[BEND] = false;
            for valley in &mut drifting.valleys {
                valley.optimum.p[BEND] = 0.0;
            }
            wider.polish(&mut drifting, runs)?;
        }
        Ok(Some((drifting, wider.free)))
    }
}
