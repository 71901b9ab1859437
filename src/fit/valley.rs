//! The minima for different numbers of half swings.
//!
//! If the motion comes to rest within the record, there is a separate minimum for each number of half swings
//! before the rest: where a turning point crosses the rim of the sticking set, the residuals are continuous but
//! their derivatives are not. A single descent is therefore never enough.

use std::cmp::Ordering;

use nalgebra::DVector;

use super::levenberg_marquardt::{NoFit, Optimum, Runs, Task, interrupted};
use super::observation::{Bound, D2, D3, Data, R, Region, UNKNOWNS, Unknowns};
use super::problem::{LeastSquares, Verdict};
use super::uncertainty::Covariance;
use crate::numerics::count::real;

/// A local minimum with its number of half swings.
#[derive(Clone, Debug)]
pub struct Valley {
    /// Number of half swings within the record.
    pub half_swings: usize,
    /// The minimum.
    pub optimum: Optimum,
}

impl LeastSquares<'_> {
    /// Whether the right valley may be far from this minimum because noise hides the number of half swings.
    pub fn may_be_elsewhere(&self, task: &Task, optimum: &Optimum) -> bool {
        /// Relative error of r above which the number of half swings is uncertain.
        const LOOSE: f64 = 0.03;
        let r = optimum.p[R];
        self.free[R]
            && (self.free[D2] || self.free[D3])
            && matches!(self.data, Data::Samples { .. })
            && (r == 0.0
                || optimum.seen.rests
                    && way_of_friction(task, optimum).is_none_or(|way| way.error > LOOSE * r))
    }

    /// These minima, and those of neighbouring regions, the lowest first.
    ///
    /// Descents start from points around each minimum that noise may have made the lowest: beyond the rims around
    /// its region, and from the closest points to the record along a change of r that the other unknowns follow.
    /// Each descent is confined to the region in which it starts, so that what is best there is found even if
    /// it lies on a rim. This is repeated until no other minimum is found. Fails with [`NoFit::Interrupted`].
    pub fn valleys(
        &self,
        task: &Task,
        optima: Vec<Optimum>,
        runs: &mut Runs,
    ) -> Result<Vec<Valley>, NoFit> {
        /// Maximum number of minima around which others are searched for.
        const MOST: usize = 8;
        /// Rise of chi-squared up to which a minimum may be the right one.
        const NEAR: f64 = 8.0;
        let mut valleys = Vec::new();
        for optimum in optima {
            let within = Task { within: Some(optimum.seen.region), ..*task };
            let found = interrupted(within.solve(optimum.p, runs))?;
            keep(&mut valleys, found.unwrap_or(optimum));
        }
        valleys.sort_by(by_cost);
        let mut asked: Vec<Region> = Vec::new();
        while self.free[R] && asked.len() < MOST {
            let least = valleys[0].optimum.cost;
            let limit = least * (1.0 + NEAR / real(self.data.residuals().max(1)));
            let next = valleys.iter().find(|valley| {
                valley.optimum.cost <= limit && !asked.contains(&valley.optimum.seen.region)
            });
            let Some(from) = next.map(|valley| valley.optimum.clone()) else { break };
            let is_lowest = from.cost == least;
            asked.push(from.seen.region);
            let Some(way) = way_of_friction(task, &from) else { continue };
            if from.p[R] == 0.0 {
                continue;
            }
            let verdict = self.verdict(&from);
            let mut guesses = beyond_the_rim(task, &from, verdict, runs)?;
            if is_lowest && from.seen.rests && !self.data.has_peaks() {
                guesses.extend(if verdict == Verdict::Noise {
                    along_the_valley(task, &from, &way, &valleys, runs)?
                } else {
                    through_the_valley(task, &from, FINE, &valleys, runs)?
                });
            }
            for guess in guesses {
                let Ok(seen) = interrupted(task.evaluated(&guess, false, runs))? else { continue };
                let within = Task { within: Some(seen.region), ..*task };
                let Ok(found) = interrupted(within.solve(guess, runs))? else { continue };
                keep(&mut valleys, found);
            }
            valleys.sort_by(by_cost);
        }
        Ok(valleys)
    }
}

/// Adds a minimum, if it is the lowest of its region.
pub fn keep(valleys: &mut Vec<Valley>, optimum: Optimum) {
    let half_swings = optimum.seen.turns.len();
    let region = optimum.seen.region;
    match valleys.iter_mut().find(|valley| valley.optimum.seen.region == region) {
        Some(known) if known.optimum.cost <= optimum.cost => {}
        Some(known) => *known = Valley { half_swings, optimum },
        None => valleys.push(Valley { half_swings, optimum }),
    }
}

/// The order of minima: the lowest first.
pub fn by_cost(one: &Valley, other: &Valley) -> Ordering {
    one.optimum.cost.total_cmp(&other.optimum.cost)
}

/// Points just beyond each rim that bounds the region of a minimum, where the loss is smallest by the linear model.
///
/// If the residuals are white and the linear model puts a rim far outside the noise, its point is left out.
fn beyond_the_rim(
    task: &Task,
    optimum: &Optimum,
    verdict: Verdict,
    runs: &mut Runs,
) -> Result<Vec<Unknowns>, NoFit> {
    /// How much further to go while a point still lies in the same region.
    const FURTHER: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
    /// Distance beyond the rim: this fraction of the way to it, plus this many standard errors.
    const BEYOND: f64 = 0.1;
    const ERRORS: f64 = 0.5;
    /// Largest distance of a rim, in its standard errors.
    const FAR: f64 = 100.0;
    let Some(covariance) = Covariance::at(task, optimum, &[]) else { return Ok(Vec::new()) };
    let point = |(value, by): Bound| {
        let columns = &covariance.columns;
        let by = DVector::from_iterator(columns.len(), columns.iter().map(|&column| by[column]));
        let lean = &covariance.white * &by;
        let variance = by.dot(&lean);
        let error = variance.sqrt();
        let step = (value * (1.0 + BEYOND) + ERRORS * error) / variance;
        let mut p = optimum.p;
        for (&column, lean) in columns.iter().zip(lean.iter()) {
            p[column] -= step * lean;
        }
        let is_near = verdict != Verdict::Noise || value <= FAR * error;
        Some(p).filter(|p| is_near && p[R] > 0.0 && p.iter().all(|value| value.is_finite()))
    };
    let rims = optimum.seen.clearances(&optimum.p, task.observation);
    let mut found = Vec::new();
    for beyond in rims.into_iter().filter_map(point) {
        for further in FURTHER {
            let p: Unknowns = std::array::from_fn(|place| {
                optimum.p[place] + further * (beyond[place] - optimum.p[place])
            });
            let Ok(seen) = interrupted(task.evaluated(&p, false, runs))? else { break };
            if p[R] > 0.0 && seen.region != optimum.seen.region {
                found.push(p);
                break;
            }
        }
    }
    Ok(found)
}

/// The points along the valley of r that are closest to the record: one for each number of half swings, if it is
/// lower than the minimum known there, and only a few of these. Each point tried costs one motion without
/// derivatives. Only points that noise could nearly explain are worth a descent.
fn along_the_valley(
    task: &Task,
    optimum: &Optimum,
    way: &WayOfFriction,
    known: &[Valley],
    runs: &mut Runs,
) -> Result<Vec<Unknowns>, NoFit> {
    /// Steps on each side: `STEPS` of the fraction `PART` of r, and `ERRORS` of one standard error.
    const PART: f64 = 0.012;
    const STEPS: u32 = 22;
    const ERRORS: u32 = 15;
    /// Rise of chi-squared beyond which a point is too far off.
    const FAR: f64 = 500.0;
    let parts = (1..=STEPS).map(|k| PART * f64::from(k) * optimum.p[R]);
    let errors = (1..=ERRORS).map(|k| f64::from(k) * way.error);
    let mut closest = Closest::default();
    for step in parts.chain(errors).flat_map(|step| [step, -step]) {
        let p = way.moved(optimum, step);
        if p[R] > 0.0
            && let Ok(seen) = interrupted(task.evaluated(&p, false, runs))?
        {
            closest.see(seen.turns.len(), task.cost(&seen), p);
        }
    }
    let unit = optimum.cost / real(optimum.seen.residuals.len().max(1));
    closest.0.retain(|(_, cost, _)| cost - optimum.cost <= FAR * unit);
    Ok(closest.beside(known))
}

/// Factors of successive steps of r on each side; a valley may be as narrow as one percent of r.
const FINE: [f64; 9] = [1.01, 1.01, 1.01, 1.02, 1.02, 1.04, 1.04, 1.04, 1.04];

/// Factors that lead to about twice and half of r.
pub const WIDE: [f64; 9] = [1.03, 1.04, 1.05, 1.06, 1.08, 1.1, 1.12, 1.15, 1.2];

/// The same with all other unknowns refitted at each step of r: while the residuals are not white, the right
/// minimum may be too far away for the linear model. Fails with [`NoFit::Interrupted`].
pub fn through_the_valley(
    task: &Task,
    optimum: &Optimum,
    factors: [f64; 9],
    known: &[Valley],
    runs: &mut Runs,
) -> Result<Vec<Unknowns>, NoFit> {
    let mut held = *task;
    held.free[R] = false;
    let mut closest = Closest::default();
    for up in [true, false] {
        let mut p = optimum.p;
        for factor in factors {
            p[R] *= if up { factor } else { 1.0 / factor };
            let Ok(found) = interrupted(held.solve_roughly(p, runs))? else { break };
            p = found.p;
            closest.see(found.seen.turns.len(), found.cost, p);
        }
    }
    Ok(closest.beside(known))
}

/// For each number of half swings, the point that is closest to the record.
#[derive(Default)]
struct Closest(Vec<(usize, f64, Unknowns)>);

impl Closest {
    fn see(&mut self, half_swings: usize, cost: f64, p: Unknowns) {
        match self.0.iter_mut().find(|other| other.0 == half_swings) {
            Some(other) if other.1 <= cost => {}
            Some(other) => *other = (half_swings, cost, p),
            None => self.0.push((half_swings, cost, p)),
        }
    }

    /// A few of the closest points that are lower than the minimum known for their number of half swings.
    fn beside(mut self, known: &[Valley]) -> Vec<Unknowns> {
        /// Maximum number of points from which to descend.
        const MOST: usize = 3;
        self.0.retain(|(half_swings, cost, _)| {
            let same = known.iter().find(|valley| valley.half_swings == *half_swings);
            same.is_none_or(|valley| *cost < valley.optimum.cost)
        });
        self.0.sort_by(|one, other| one.1.total_cmp(&other.1));
        self.0.into_iter().take(MOST).map(|(_, _, p)| p).collect()
    }
}

/// The change of all unknowns with r, and the standard error of r.
struct WayOfFriction {
    along: Unknowns,
    error: f64,
}

impl WayOfFriction {
    /// The point after r has been changed by `step`.
    fn moved(&self, from: &Optimum, step: f64) -> Unknowns {
        std::array::from_fn(|place| from.p[place] + step * self.along[place])
    }
}

fn way_of_friction(task: &Task, optimum: &Optimum) -> Option<WayOfFriction> {
    let mut columns = task.columns();
    // With r as the last column, the last row of the factor gives the error of r when all other unknowns follow.
    columns.retain(|&column| column != R);
    columns.push(R);
    let factor = task.factor(&optimum.seen, &columns);
    let last = columns.len() - 1;
    let inner = factor.view((0, 0), (last, last)).into_owned();
    let follow =
        inner.solve_upper_triangular(&(-factor.view((0, last), (last, 1)).into_owned()))?;
    let mut along = [0.0; UNKNOWNS];
    for (&column, value) in columns.iter().zip(follow.iter()) {
        along[column] = *value;
    }
    along[R] = 1.0;
    let deviation = (optimum.cost / real(optimum.seen.residuals.len().max(1))).sqrt();
    let error = deviation / factor[(last, last)].abs();
    error.is_finite().then_some(WayOfFriction { along, error })
}
