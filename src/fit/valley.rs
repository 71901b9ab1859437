//! The minima for different numbers of half swings.
//!
//! If the motion comes to rest within the record, there is a separate minimum for each number of half swings
//! before the rest: where a turning point crosses the rim of the sticking set, the residuals are continuous but
//! their derivatives are not. A single descent is therefore never enough.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use super::{Bound, Covariance, D2, D3, FitVerdict, Optimum, R, Region, Task, Unknowns};

/// Factors of successive steps of r on each side; a valley may be as narrow as one percent of r.
const FINE: [f64; 9] = [1.01, 1.01, 1.01, 1.02, 1.02, 1.04, 1.04, 1.04, 1.04];

/// Factors that lead to about twice and half of r.
pub const WIDE: [f64; 9] = [1.03, 1.04, 1.05, 1.06, 1.08, 1.1, 1.12, 1.15, 1.2];

impl Task<'_> {
    /// Whether the right valley may be far from this minimum because noise hides the number of half swings.
    pub fn may_be_elsewhere(&self, optimum: &Optimum) -> bool {
        /// Relative error of r above which the number of half swings is uncertain.
        const LOOSE: f64 = 0.03;
        let r = optimum.p[R];
        let is_loose = |covariance: Covariance| covariance.error(R) > LOOSE * r;
        self.free[R]
            && (self.free[D2] || self.free[D3])
            && !self.data.has_peaks()
            && (r == 0.0
                || optimum.seen.rests && Covariance::at(self, optimum, &[]).is_none_or(is_loose))
    }

    /// These minima, and those of neighbouring regions, the lowest first.
    ///
    /// Descents start from points around each minimum that noise may have made the lowest: beyond the rims around
    /// its region, and from the closest points to the record along a change of r that the other unknowns follow.
    /// Each descent is confined to the region in which it starts, so that what is best there is found even if
    /// it lies on a rim. This is repeated until no other minimum is found.
    pub(crate) fn valleys(&self, optima: Vec<Optimum>) -> Vec<Optimum> {
        /// Maximum number of minima around which others are searched for.
        const MOST: usize = 8;
        /// Rise of chi-squared up to which a minimum may be the right one.
        const NEAR: f64 = 8.0;
        let mut valleys = Vec::new();
        for optimum in optima {
            let found = self.around(&optimum.seen).solve(optimum.p);
            keep(&mut valleys, found.unwrap_or(optimum));
        }
        let mut asked: Vec<Region> = Vec::new();
        while self.free[R] && asked.len() < MOST {
            let least = valleys[0].cost;
            let limit = least + NEAR * self.unit(least);
            let next = valleys
                .iter()
                .find(|valley| valley.cost <= limit && !asked.contains(&valley.seen.region));
            let Some(from) = next.cloned() else { break };
            asked.push(from.seen.region);
            let Some(covariance) = Covariance::at(self, &from, &[]) else { continue };
            if from.p[R] == 0.0 {
                continue;
            }
            let is_noise = self.verdict(&from) == FitVerdict::Noise;
            let mut guesses = self.beyond_rims(&from, &covariance, is_noise);
            if from.cost == least && from.seen.rests && !self.data.has_peaks() {
                let points = if is_noise {
                    self.along_the_valley(&from, &covariance)
                } else {
                    self.through_the_valley(&from, FINE)
                };
                guesses.extend(closest(points, &valleys));
            }
            for guess in guesses {
                let Some(seen) = self.evaluated(&guess, false) else { continue };
                if let Some(found) = self.around(&seen).solve(guess) {
                    keep(&mut valleys, found);
                }
            }
        }
        valleys
    }

    /// Points just beyond each rim that bounds the region of a minimum, where the loss is smallest by the linear model.
    ///
    /// If the residuals are white and the linear model puts a rim far outside of it, its point is left out.
    fn beyond_rims(&self, from: &Optimum, covariance: &Covariance, white: bool) -> Vec<Unknowns> {
        /// How much further to go while a point still lies in the same region.
        const FURTHER: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
        /// Distance beyond the rim: this fraction of the way to it, plus this many standard errors.
        const BEYOND: f64 = 0.1;
        const ERRORS: f64 = 0.5;
        /// Largest distance of a rim, in its standard errors.
        const FAR: f64 = 100.0;
        let step = |(value, by): Bound| {
            let lean = covariance.white * by;
            let variance = by.dot(&lean);
            let error = variance.sqrt();
            let size = (value * (1.0 + BEYOND) + ERRORS * error) / variance;
            (!white || value <= FAR * error).then(|| -size * lean)
        };
        let is_possible = |p: &Unknowns| p[R] > 0.0 && p.iter().all(|value| value.is_finite());
        let rims = from.seen.clearances(&from.p, self.data, self.start);
        // The first point that lies in another region, if the motion is not lost before.
        let beyond = |step: Unknowns| {
            let points = FURTHER.map(|further| from.p + further * step).into_iter();
            let possible = points.take_while(is_possible);
            let seen = possible.map_while(|p| Some((p, self.evaluated(&p, false)?.region)));
            let mut other = seen.filter(|(_, region)| *region != from.seen.region);
            other.next().map(|(p, _)| p)
        };
        rims.into_iter().filter_map(step).filter_map(beyond).collect()
    }

    /// Points along the valley of r by the linear model, of which those that noise could nearly explain are worth a
    /// descent. Each costs one motion without derivatives.
    fn along_the_valley(&self, from: &Optimum, covariance: &Covariance) -> Vec<ValleyPoint> {
        /// Steps on each side: `STEPS` of the fraction `PART` of r, and `ERRORS` of one standard error.
        const PART: f64 = 0.012;
        const STEPS: u32 = 22;
        const ERRORS: u32 = 15;
        /// Rise of chi-squared beyond which a point is too far off.
        const FAR: f64 = 500.0;
        let (along, error) = (covariance.following(&[(R, 1.0)]), covariance.error(R));
        let parts = (1..=STEPS).map(|k| PART * f64::from(k) * from.p[R]);
        let errors = (1..=ERRORS).map(|k| f64::from(k) * error);
        let steps = parts.chain(errors).flat_map(|step| [step, -step]);
        let possible = steps.map(|step| from.p + step * along).filter(|p| p[R] > 0.0);
        let highest = from.cost + FAR * self.unit(from.cost);
        let point = |p: Unknowns| {
            let seen = self.evaluated(&p, false)?;
            Some(ValleyPoint { half_swings: seen.turns.len(), cost: self.cost(&seen), p })
        };
        possible.filter_map(point).filter(|point| point.cost <= highest).collect()
    }

    /// The same with all other unknowns refitted at each step of r: while the residuals are not white, the right
    /// minimum may be too far away for the linear model.
    pub fn through_the_valley(&self, from: &Optimum, factors: [f64; 9]) -> Vec<ValleyPoint> {
        let held = self.holding(R);
        let mut points = Vec::new();
        for up in [true, false] {
            let mut p = from.p;
            for factor in factors {
                p[R] *= if up { factor } else { 1.0 / factor };
                let Some(found) = held.solve_roughly(p) else { break };
                p = found.p;
                let half_swings = found.seen.turns.len();
                points.push(ValleyPoint { half_swings, cost: found.cost, p });
            }
        }
        points
    }
}

/// Adds a minimum, if it is the lowest of its region, to minima in the order of their cost.
fn keep(valleys: &mut Vec<Optimum>, optimum: Optimum) {
    match valleys.iter_mut().find(|valley| valley.seen.region == optimum.seen.region) {
        Some(known) if known.cost <= optimum.cost => {}
        Some(known) => *known = optimum,
        None => valleys.push(optimum),
    }
    valleys.sort_by(by_cost);
}

/// The order of minima: the lowest first.
pub fn by_cost(one: &Optimum, other: &Optimum) -> Ordering {
    one.cost.total_cmp(&other.cost)
}

/// A point with its number of half swings and its loss.
pub struct ValleyPoint {
    half_swings: usize,
    cost: f64,
    p: Unknowns,
}

/// For each number of half swings the point that is closest to the record, if it is lower than the minimum known there:
/// the lowest few of these.
pub fn closest(mut points: Vec<ValleyPoint>, known: &[Optimum]) -> Vec<Unknowns> {
    /// Maximum number of points from which to descend.
    const MOST: usize = 3;
    points.sort_by(|one, other| one.cost.total_cmp(&other.cost));
    let mut met = BTreeSet::new();
    points.retain(|ValleyPoint { half_swings, cost, .. }| {
        let same = known.iter().find(|valley| valley.seen.turns.len() == *half_swings);
        met.insert(*half_swings) && same.is_none_or(|valley| *cost < valley.cost)
    });
    points.into_iter().take(MOST).map(|point| point.p).collect()
}
