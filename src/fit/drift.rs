//! A drift of the zero beside the motion, along a line or a parabola over the record, and fits with one where the record
//! shows it.

use serde::Serialize;

use super::{
    BEND, Beginning, Covariance, Extreme, LinearResiduals, NAMES, Optimum, SLOPE, Task, UNKNOWNS,
    Unknowns, autocorrelations, drift, middle_of, robust,
};
use crate::numerics::{powi, real};

/// A drift that a fit leaves over.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftDrift {
    /// By how much chi-squared falls if the zero may drift along a parabola; for noise with memory divided by the factor
    /// by which that raises chance.
    pub evidence: f64,
    /// The change of the zero from the beginning to the end of the record.
    pub change: f64,
    /// The distance by which it would move an estimated number, in standard errors of that number without a drift; the
    /// largest of all.
    pub moved: f64,
}

/// A drift that is fitted.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FittedDrift {
    /// The change of the zero from the beginning to the end of the record.
    pub change: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// How far its ends lie above its middle; 0 along a line.
    pub bend: f64,
    /// The standard error of that.
    pub bend_standard_error: f64,
}

/// Chance exceeds this fall of chi-squared for two more unknowns three times in ten thousand.
const RARE: f64 = 16.0;

impl LeftDrift {
    /// Whether the drift is real.
    pub fn is_seen(&self) -> bool {
        self.evidence > RARE
    }

    /// The drift by the linear model about a minimum, with the step of all unknowns to it; none for peaks.
    pub fn with_step(task: &Task, optimum: &Optimum) -> Option<(Self, Unknowns)> {
        if task.data.has_peaks() || task.free[SLOPE] {
            return None;
        }
        let wider = task.with_drift();
        let LinearResiduals { upper, turned, left } = wider.factor(&optimum.seen);
        let step = upper.solve_upper_triangular(&turned)?;
        let used = task.used_residuals(&optimum.seen);
        let values: Vec<f64> = used.map(|it| it.value - it.by.dot(&step)).collect();
        let freedom = (real(values.len()) - real(wider.columns().count())).max(1.0);
        let variance = powi(left, 2) / freedom;
        // Those of the slope and of the bend come last.
        let fall = turned.rows(SLOPE, 2).norm_squared();
        let evidence = fall / variance * independent(&values);
        Some((LeftDrift { evidence, change: step[SLOPE], moved: 0.0 }, step))
    }

    /// The drift by the linear model about a minimum with this covariance; none for peaks, or if it is fitted.
    pub fn of(task: &Task, optimum: &Optimum, covariance: &Covariance) -> Self {
        let Some((drift, step)) = LeftDrift::with_step(task, optimum) else {
            return LeftDrift::default();
        };
        let named = NAMES.iter().map(|row| row.place).filter(|place| task.free[*place]);
        let moved = named.map(|place| step[place].abs() / covariance.error(place));
        LeftDrift { moved: moved.fold(0.0, f64::max), ..drift }
    }
}

/// The share of residuals that are independent, by the memory between neighbours.
fn independent(residuals: &[f64]) -> f64 {
    let memory = autocorrelations(residuals, &[1])[0].clamp(0.0, 0.99);
    (1.0 - memory) / (1.0 + memory)
}

/// The slope and the bend of the middles of the swings; zero for fewer than three.
pub fn drift_of_swings(t: &[f64], extremes: &[Extreme]) -> [f64; 2] {
    /// Fewest middles that show a parabola.
    const FEWEST: usize = 6;
    let rows: Vec<([f64; 3], f64)> = extremes
        .windows(3)
        .map(|three| {
            let [slope, bend] = drift(t, three[1].t);
            ([1.0, slope, bend], middle_of(three))
        })
        .collect();
    let columns: &[usize] = if rows.len() < FEWEST { &[0, 1] } else { &[0, 1, 2] };
    let found = (rows.len() > 2).then(|| robust(&rows, columns)).flatten();
    found.map_or([0.0; 2], |[_, slope, bend]| [slope, bend])
}

/// Takes a drift off a record.
pub fn without_drift(t: &[f64], x: &[f64], by: [f64; 2]) -> Vec<f64> {
    let at = |time: f64| {
        let [slope, bend] = drift(t, time);
        by[0] * slope + by[1] * bend
    };
    t.iter().zip(x).map(|(&t, x)| x - at(t)).collect()
}

/// Minima with a drift of the zero, and which unknowns are then free.
pub(crate) type Drifting = (Vec<Optimum>, [bool; UNKNOWNS]);

impl Task<'_> {
    /// The minima with a drift of the zero, and which unknowns are then free, if it is real; `guessed` makes first
    /// guesses with a drift.
    ///
    /// Asked are records that may show a drift or are not explained without one. With it they must be explained, and
    /// chi-squared must fall by more than chance allows.
    pub(crate) fn drifting(
        &self,
        found: &[Optimum],
        guessed: impl FnOnce() -> Vec<Beginning>,
    ) -> Option<Drifting> {
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
        let best = &found[0];
        let (drift, step) = LeftDrift::with_step(self, best)?;
        if drift.evidence < ASKED && self.explains(best) {
            return None;
        }
        let mut beginnings = guessed();
        let guesses = vec![best.p + step, best.p];
        match beginnings.iter_mut().find(|beginning| beginning.start == best.start) {
            Some(beginning) => beginning.guesses.extend(guesses),
            None => beginnings.push(Beginning { start: best.start, certain: true, guesses }),
        }
        let mut wider = self.with_drift();
        // Only where a first descent comes much closer, or explains the record, is it worth the search.
        let mut helps = false;
        for (start, guess, _) in wider.ranked(&beginnings) {
            let tried = wider.starting(start).solve(guess);
            helps |= tried.is_some_and(|it| MUCH * it.cost < best.cost || wider.explains(&it));
        }
        if !helps {
            return None;
        }
        let mut drifting = wider.search(&beginnings)?;
        let least = &drifting[0];
        let values = wider.values(&least.seen);
        let unit = least.cost / real(values.len()) / independent(&values);
        if best.cost - least.cost <= FITTED * unit || !wider.explains(least) {
            return None;
        }
        let bend = Covariance::at(&wider, least, &[]).map_or(0.0, |it| it.of(BEND, BEND));
        if powi(least.p[BEND], 2) <= NOTHING * bend / independent(&values) {
            wider.free[BEND] = false;
            for minimum in &mut drifting {
                minimum.p[BEND] = 0.0;
            }
            wider.polish(&mut drifting)?;
        }
        Some((drifting, wider.free))
    }
}
