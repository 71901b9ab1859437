//! The estimate from a record: the best motion with its uncertainty; refits of it with some numbers held at new values, and
//! the contours along which the loss has then risen.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use serde::Serialize;

use super::{
    BEND, Choice, Covariance, DropReason, Extreme, FittedDrift, HIDDEN, LeftDrift, NAMES, NameSpec,
    NoEstimate, Noise, OMEGA0, Optimum, Profile, ProfileInterval, R, Record, Runs, SLOPE,
    StartKind, Task, UNKNOWNS, Unknowns, Whiteness, amplitudes, whiteness,
};
use crate::model::State;
use crate::numerics::sin_cos;

/// A minimum that competes with the best one.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Rival {
    /// Half swings within the record.
    pub half_swings: usize,
    /// By how much its loss exceeds that of the best, in units of the noise variance.
    pub delta_chi2: f64,
    /// Its unknowns.
    #[serde(skip)]
    pub p: Unknowns,
}

/// The estimate from a record.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Which numbers were asked for.
    pub choice: Choice,
    /// The measured data.
    pub data: Record,
    /// How the motion begins.
    pub start: StartKind,
    /// The unknowns.
    pub p: Unknowns,
    /// Which of them are free.
    pub free: [bool; UNKNOWNS],
    /// Their covariance.
    pub covariance: Covariance,
    /// 95 % intervals, indexed by the place of the unknown.
    pub intervals: [ProfileInterval; UNKNOWNS],
    /// Measured minus computed, for each measured number; those of times of peaks in units of displacement.
    pub residuals: Vec<f64>,
    /// The state of the fitted motion for each of them.
    pub states: Vec<State>,
    /// For each residual why it does not count. The residuals are those of the record without what lies outside the motion
    /// or the scale.
    pub left_out: Vec<Option<DropReason>>,
    /// Half swings within the record.
    pub half_swings: usize,
    /// Whether the motion comes to rest within the record.
    pub rests: bool,
    /// The minima for different numbers of half swings; the first one is the estimate itself.
    pub rivals: Vec<Rival>,
    /// Correlation of the residuals.
    pub whiteness: Whiteness,
    /// The turning points read from the record.
    pub extremes: Vec<Extreme>,
    /// The noise estimated without a model.
    pub noise: Noise,
    /// For each sample or peak of the record why it does not count; `None` if it does.
    pub dropped: Vec<Option<DropReason>>,
    /// Number of motions computed with and without derivatives.
    pub motions: (u64, u64),
    /// Displacement beyond which a motion counts as escaped.
    pub reach: f64,
    /// A drift of the zero beside the motion that is not fitted.
    pub left_drift: LeftDrift,
    /// How far a fit of a record simulated from this estimate comes off it, in standard errors; `None` if not tested.
    pub repeated: Option<f64>,
}

impl Estimate {
    /// Number of samples of the record that do not count for this reason.
    #[must_use]
    pub fn count(&self, why: DropReason) -> usize {
        self.dropped.iter().filter(|it| **it == Some(why)).count()
    }

    /// The residuals that count.
    pub fn kept_residuals(&self) -> impl Iterator<Item = f64> + '_ {
        let all = self.residuals.iter().zip(&self.left_out);
        all.filter(|(_, why)| why.is_none()).map(|(it, _)| *it)
    }

    /// The drift of the zero, if one is fitted.
    #[must_use]
    pub fn drift(&self) -> Option<FittedDrift> {
        /// What the ends of a parabola of height 1 are above its middle.
        const ENDS: f64 = 0.25;
        let error = |place| self.covariance.error(place);
        self.free[SLOPE].then(|| FittedDrift {
            change: self.p[SLOPE],
            standard_error: error(SLOPE),
            bend: ENDS * self.p[BEND],
            bend_standard_error: ENDS * error(BEND),
        })
    }

    /// The rows of the numbers that were asked for and could be estimated.
    pub fn wanted(&self) -> impl Iterator<Item = &'static NameSpec> + '_ {
        NAMES.iter().filter(|row| self.choice.is_wanted(row) && self.free[row.place])
    }

    /// Smallest and largest half peak-to-peak amplitude in the record.
    #[must_use]
    pub fn amplitudes(&self) -> (f64, f64) {
        let halves = amplitudes(&self.extremes).into_iter();
        halves.fold((f64::INFINITY, 0.0), |(low, high), half| (low.min(half), high.max(half)))
    }

    /// Minima that the data do not rule out: those with chi-squared less than 4 above the best.
    pub fn contenders(&self) -> impl Iterator<Item = &Rival> {
        self.rivals.iter().filter(|rival| rival.delta_chi2 < 4.0)
    }
}

/// Assesses a minimum: noise, covariance, intervals, rivals.
///
/// # Errors
/// [`NoEstimate::Blind`] if an unknown has no influence; why the computation has ended, if it has.
pub fn judged(task: &Task, found: &[Optimum]) -> Result<Estimate, NoEstimate> {
    /// Number of times that a profile may come upon a lower minimum.
    const LOWER: usize = 4;
    let task = task.starting(found[0].start);
    let mut found = found.to_vec();
    let mut judged = assessed(&task, &found);
    for _ in 0..LOWER {
        let Some((_, Some(lower))) = &judged else { break };
        found.insert(0, lower.clone());
        found = task.valleys(found);
        judged = assessed(&task, &found);
    }
    match task.runs.ended() {
        Some(end) => Err(end),
        None => judged.map(|(estimate, _)| estimate).ok_or(NoEstimate::Blind),
    }
}

/// The estimate, and a lower minimum if a profile comes upon one; its interval is then open.
fn assessed(task: &Task, found: &[Optimum]) -> Option<(Estimate, Option<Optimum>)> {
    let (data, best) = (task.data, &found[0]);
    let p = best.p;
    let kept = task.values(&best.seen);
    let samples_per_period = data.samples_per_period(p[OMEGA0]);
    let mut whiteness = whiteness(&kept, samples_per_period);
    if data.has_peaks() {
        // With a few peaks, or two kinds of residuals, correlation cannot be estimated.
        (whiteness.white, whiteness.autocorrelation) = (true, Vec::new());
    }
    let directions = task.directions(&best.seen);
    let restored = whiteness.clone().restored(&kept, samples_per_period, &directions);
    let covariance = |of: &Whiteness| {
        Covariance::at(task, best, &of.autocorrelation).filter(Covariance::is_possible)
    };
    let (mut whiteness, covariance) = if let Some(covariance) = covariance(&restored) {
        (restored, covariance)
    } else {
        // Noise cannot have this correlation.
        (whiteness.systematic, whiteness.autocorrelation) = (true, Vec::new());
        let covariance = covariance(&whiteness)?;
        (whiteness, covariance)
    };
    whiteness.systematic |= task.noise > 0.0 && covariance.deviation > HIDDEN * task.noise;
    whiteness.white &= !whiteness.systematic;
    // With correlated noise, larger differences of the loss occur by chance.
    let unit = covariance.variance * covariance.inflation(R);
    let rival = |other: &Optimum| Rival {
        half_swings: other.seen.turns.len(),
        delta_chi2: (other.cost - best.cost) / unit,
        p: other.p,
    };
    let (intervals, lower) = intervals(task, found, covariance.variance, &whiteness);
    let left_drift = LeftDrift::of(task, best, &covariance);
    let (residuals, states) = best.seen.residuals.iter().map(|it| (it.value, it.at)).unzip();
    let estimate = Estimate {
        choice: Choice::default(),
        data: data.clone(),
        start: best.start,
        p,
        free: task.free,
        covariance,
        intervals,
        residuals,
        states,
        left_out: task.dropped.to_vec(),
        half_swings: best.seen.turns.len(),
        rests: best.seen.rests,
        rivals: found.iter().map(rival).collect(),
        whiteness,
        extremes: Vec::new(),
        noise: Noise::default(),
        dropped: task.dropped.iter().copied().take(data.x.len()).collect(),
        motions: (task.runs.with_derivatives.get(), task.runs.plain.get()),
        reach: task.reach,
        left_drift,
        repeated: None,
    };
    Some((estimate, lower))
}

/// The intervals of all unknowns, the union of those of all regions; and a lower minimum if a profile comes upon one.
fn intervals(
    task: &Task,
    found: &[Optimum],
    variance: f64,
    whiteness: &Whiteness,
) -> ([ProfileInterval; UNKNOWNS], Option<Optimum>) {
    /// How much of the rise of chi-squared to the minimum of another region counts. The lowest of several minima is lower by
    /// chance than any one of them: so they count up to a chi-squared of 9, not of 3.84.
    const CHOSEN: f64 = 0.43;
    let mut intervals = [ProfileInterval::default(); UNKNOWNS];
    let mut lower = None;
    for (number, optimum) in found.iter().enumerate() {
        let memory = &whiteness.autocorrelation;
        let Some(covariance) = Covariance::at(task, optimum, memory) else { continue };
        let (covariance, task) = (&covariance, &task.around(&optimum.seen));
        let least = optimum.cost - CHOSEN * (optimum.cost - found[0].cost);
        for unknown in task.columns() {
            let mut profile =
                Profile { task, optimum, covariance, unknown, least, variance, lower: None };
            // If the model leaves something out there is no likelihood, and a profile would be meaningless.
            let one = if whiteness.systematic {
                Some(profile.straight()).filter(|_| number == 0)
            } else {
                profile.interval()
            };
            lower = profile.lower.or(lower);
            if let Some(one) = one {
                let known = intervals[unknown];
                intervals[unknown] = if number == 0 { one } else { known.joined(one) };
            }
        }
    }
    (intervals, lower)
}

/// Samples that do not count, with at most one between two of them that does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Omission {
    /// Time of the first, in s.
    pub from: f64,
    /// Time of the last, in s.
    pub to: f64,
    /// Their number.
    pub samples: usize,
}

/// All samples of a record that do not count, in the order of their times; none for a list of peaks.
pub fn left_out(record: &Record, estimate: &Estimate) -> Vec<Omission> {
    let counts = estimate.dropped.iter().map(Option::is_none);
    stretches(record.t.iter().copied().zip(counts))
}

/// Stretches of the times of samples that do not count.
fn stretches(samples: impl Iterator<Item = (f64, bool)>) -> Vec<Omission> {
    let mut found: Vec<Omission> = Vec::new();
    let mut since = 0;
    for (t, counts) in samples {
        if counts {
            since += 1;
            continue;
        }
        match found.last_mut() {
            Some(last) if since <= 1 => (last.to, last.samples) = (t, last.samples + 1),
            _ => found.push(Omission { from: t, to: t, samples: 1 }),
        }
        since = 0;
    }
    found
}

impl Estimate {
    /// What was estimated, with these unknowns held. The loss is that of the samples that count.
    pub fn task<'a>(&'a self, held: &[usize], runs: &'a Runs<'a>) -> Task<'a> {
        let (start, free, reach, dropped) = (self.start, self.free, self.reach, &self.left_out[..]);
        let task = Task { start, reach, free, dropped, ..Task::new(&self.data, runs) };
        held.iter().fold(task, |task, place| task.holding(*place))
    }

    /// The loss that corresponds to one unit of chi-squared. It is larger for correlated noise, with which larger
    /// differences occur by chance.
    pub fn unit(&self, runs: &Runs) -> Option<f64> {
        let task = self.task(&[], runs);
        let cost = task.cost(&task.evaluated(&self.p, false)?);
        Some(cost / self.covariance.freedom * self.covariance.inflation(R))
    }

    /// The contour around the estimate along which chi-squared has risen by `rise`, in the plane of two free unknowns.
    /// It is cut off at r = 0.
    pub fn contour(&self, places: [usize; 2], rise: f64, runs: &Runs) -> Option<Vec<[f64; 2]>> {
        /// Number of directions in which the contour is located.
        const DIRECTIONS: u32 = 24;
        let [one, other] = places;
        let covariance = &self.covariance.matrix;
        let plane = covariance.select_rows(&places).select_columns(&places);
        let root = plane.cholesky()?.l();
        let task = self.task(&places, runs);
        let cost = task.cost(&task.evaluated(&self.p, false)?);
        let unit = self.unit(runs)?;
        let mut points = Vec::new();
        for index in 0..DIRECTIONS {
            let (sine, cosine) = sin_cos(TAU * f64::from(index) / f64::from(DIRECTIONS));
            let step = rise.sqrt() * &root * Vector2::new(cosine, sine);
            // The linear model predicts the other unknowns.
            let along = self.covariance.following(&[(one, step[0]), (other, step[1])]);
            if let Some(at) = risen(&task, &self.p, along, (cost, rise * unit)) {
                points.push([self.p[one] + at * step[0], self.p[other] + at * step[1]]);
            }
        }
        points.extend(points.first().copied());
        Some(points)
    }
}

/// The estimate with some numbers held: everything that follows from the new minimum, except intervals and rivals.
///
/// # Errors
/// [`NoEstimate::NoMotion`] if the motion with these numbers escapes; [`NoEstimate::Blind`]; [`NoEstimate::Interrupted`].
pub fn held(
    estimate: &Estimate,
    numbers: &[(usize, f64)],
    runs: &Runs,
) -> Result<Estimate, NoEstimate> {
    let places: Vec<usize> = numbers.iter().map(|(place, _)| *place).collect();
    let task = estimate.task(&places, runs);
    let optimum = task.solve_roughly(following(estimate, numbers));
    let optimum = optimum.ok_or_else(|| runs.ended().unwrap_or(NoEstimate::NoMotion))?;
    let autocorrelation = &estimate.whiteness.autocorrelation;
    let covariance = Covariance::at(&task, &optimum, autocorrelation).ok_or(NoEstimate::Blind)?;
    let half_swings = optimum.seen.turns.len();
    let (residuals, states) = optimum.seen.residuals.iter().map(|it| (it.value, it.at)).unzip();
    Ok(Estimate {
        p: optimum.p,
        free: task.free,
        covariance,
        // The ends are not computed; it is assumed that the likelihood is quadratic where it was before.
        intervals: estimate.intervals.map(|it| ProfileInterval { lower: None, upper: None, ..it }),
        residuals,
        states,
        half_swings,
        rests: optimum.seen.rests,
        rivals: vec![Rival { half_swings, delta_chi2: 0.0, p: optimum.p }],
        ..estimate.clone()
    })
}

/// All unknowns as predicted by the linear model, after some have been set to new values; friction is not negative.
pub fn following(estimate: &Estimate, numbers: &[(usize, f64)]) -> Unknowns {
    let change = |(place, value): &(usize, f64)| (*place, value - estimate.p[*place]);
    let changes: Vec<(usize, f64)> = numbers.iter().map(change).collect();
    let mut guess = estimate.p + estimate.covariance.following(&changes);
    for (place, value) in numbers {
        guess[*place] = *value;
    }
    guess[R] = guess[R].max(0.0);
    guess
}

/// Rises of chi-squared whose contours contain two unknowns with a probability of 68 and 95 %.
pub const RISES: [f64; 2] = [2.3, 6.0];

/// The distance from a point along a direction at which the loss, `cost` at the point, has risen by `rise`; `None` if
/// the motion escapes before.
fn risen(task: &Task, p: &Unknowns, along: Unknowns, (cost, rise): (f64, f64)) -> Option<f64> {
    /// Number of refits. Each corrects the distance by the rise found before, as for a quadratic loss; if
    /// the loss is quadratic, the first distance is right.
    const ROUNDS: usize = 3;
    let farthest = if along[R] < 0.0 {
        -p[R] / along[R]
    } else {
        f64::INFINITY
    };
    let mut at = f64::min(1.0, farthest);
    for _ in 0..ROUNDS {
        let mut guess = p + at * along;
        guess[R] = guess[R].max(0.0);
        let found = task.solve_roughly(guess)?;
        let part = ((found.cost - cost).max(0.0) / rise).sqrt();
        if (part - 1.0).abs() < 0.03 || part < 1.0 && at >= farthest {
            break;
        }
        at = (at / part.clamp(0.4, 2.5)).min(farthest);
    }
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_do_not_count_are_found_in_stretches() {
        let of =
            |counted: &[u8]| stretches((0..12_u8).map(|t| (f64::from(t), counted.contains(&t))));
        let stretch = |from: i32, to: i32, samples| Omission {
            from: f64::from(from),
            to: f64::from(to),
            samples,
        };
        assert_eq!(of(&[2, 3, 5, 8, 9, 10, 11]), [stretch(0, 1, 2), stretch(4, 7, 3)]);
        assert_eq!(of(&(0..12).collect::<Vec<u8>>()), []);
        assert_eq!(of(&[]), [stretch(0, 11, 12)]);
    }
}
