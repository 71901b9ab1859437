//! Fits a sampled motion.

use super::estimate::{Estimate, judged};
use super::guess::{Guess, guess};
use super::levenberg_marquardt::{NoFit, Runs};
use super::loss::Loss;
use super::noise::{IMPOSSIBLE, Noise, robust_deviation, within_scale};
use super::observation::{Data, LAST, OMEGA0, StartKind};
use super::problem::LeastSquares;
use super::question::{LossName, Question, Unfit, placed, reach};
use super::record::Record;
use super::release::released_before;
use super::search::Minima;
use super::spectrum::dominant_frequency;
use crate::numerics::count::{real, whole};
use crate::numerics::elementary::powi;

/// Fits a record of samples. Fails with [`Unfit`].
pub fn samples(record: &Record, question: &Question, runs: &mut Runs) -> Result<Estimate, Unfit> {
    let all = record.t.as_deref().unwrap_or_default();
    let per_period = dominant_frequency(all, &record.x).map_or(f64::INFINITY, |frequency| {
        real(all.len()) / ((all[all.len() - 1] - all[0]) * frequency)
    });
    let within = within_scale(&record.x, &Noise::of(&record.x, per_period));
    let keep = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(&within).filter(|(_, within)| **within).map(|(value, _)| *value).collect()
    };
    let (t, x) = (keep(all), keep(&record.x));
    let held = question.choice.unknowns();
    let free = held.map(|held| held.is_none());
    let unknowns = free.iter().filter(|free| **free).count();
    if x.len() < unknowns + 8 {
        return Err(Unfit::TooFew { measured: x.len(), unknowns });
    }
    let noise = Noise::of(&x, per_period);
    let Guess { mut beginnings, extremes, struck, again } =
        guess(&t, &x, &noise).ok_or(Unfit::NoSwings)?;
    let saturated = all.len() - x.len();
    let mut part = |t: &[f64], x: &[f64]| {
        let part = Record { t: Some(t.to_vec()), x: x.to_vec(), ..Record::default() };
        samples(&part, question, runs).ok().filter(|found| !found.whiteness.systematic)
    };
    if let Some(until) = again
        && let Some(found) = part(&t[..until], &x[..until])
    {
        return Ok(Estimate { after: x.len() - until, saturated, ..found });
    }
    if let Some(from) = struck
        && let Some(found) = part(&t[from..], &x[from..])
    {
        return Ok(Estimate { before: from, saturated, ..found });
    }
    for guess in beginnings.iter_mut().flat_map(|beginning| &mut beginning.guesses) {
        *guess = placed(&held, *guess);
    }
    let scale = 3.0 * noise.deviation;
    let loss = match question.loss {
        LossName::Auto if noise.has_outliers => Loss::SoftL1 { scale },
        LossName::Auto | LossName::Linear => Loss::Linear,
        LossName::SoftL1 => Loss::SoftL1 { scale },
        LossName::Cauchy => Loss::Cauchy { scale },
    };
    let reach = reach(&x);
    let data = Data::Samples { t, x };
    let mut problem =
        LeastSquares { data: &data, free, loss, used: &[], noise: noise.deviation, reach };
    let mut found = problem.search(&beginnings, runs)?;
    let is_held = beginnings[0].start == StartKind::Release;
    if is_held && !problem.explains(&found.valleys[0].optimum) {
        let other = released_before(&problem, &held, &noise, &extremes, runs)?;
        let cost = |of: &Minima| of.valleys[0].optimum.cost;
        found = other.filter(|other| cost(other) < cost(&found)).unwrap_or(found);
    }
    let mut used = vec![true; data.residuals()];
    let mut alike = used.clone();
    if question.loss == LossName::Auto {
        problem.loss = Loss::Linear;
        used = refined(&problem, loss.is_robust(), &mut found, runs)?;
        // If no motion fits, it is not known where the mass rests.
        if (LeastSquares { used: &used, ..problem }).comes_near(&found.valleys[0].optimum) {
            alike = telling(&problem, &noise, &mut used, &mut found, runs)?;
        }
    }
    let count = |flags: &[bool]| flags.iter().filter(|flag| !**flag).count();
    let mut estimate = judged(&problem, &used, &found, runs)?;
    (estimate.alike, estimate.saturated) = (count(&alike), count(&within));
    (estimate.choice, estimate.extremes, estimate.noise) =
        (question.choice.clone(), extremes, noise);
    Ok(estimate)
}

/// Leaves out readings of a mass at rest that only repeat the rounding error of others, and fits again. Returns
/// the readings that are kept.
fn telling(
    problem: &LeastSquares,
    noise: &Noise,
    used: &mut [bool],
    found: &mut Minima,
    runs: &mut Runs,
) -> Result<Vec<bool>, NoFit> {
    /// Two rounds, since the first fit, biased by the common error at rest, overestimates the noise.
    const ROUNDS: usize = 2;
    let possible = used.to_vec();
    let mut telling = vec![true; used.len()];
    for _ in 0..ROUNDS {
        let best = &found.valleys[0].optimum;
        let values = best.seen.residuals.iter().zip(&*used).filter(|(_, used)| **used);
        let (sum, count) =
            values.fold((0.0, 0.0), |(sum, count), (it, _)| (sum + powi(it.value, 2), count + 1.0));
        let enough = noise.readings_at_rest(sum / count);
        let now = some_at_rest(problem, found, enough);
        if now == telling {
            break;
        }
        telling = now;
        for ((used, possible), telling) in used.iter_mut().zip(&possible).zip(&telling) {
            *used = *possible && *telling;
        }
        let problem = LeastSquares { used, ..*problem };
        let observation = problem.observation(found.start);
        let task = problem.task(&observation);
        let optimum = task.solve(best.p, runs)?;
        found.valleys = problem.valleys(&task, vec![optimum], runs)?;
    }
    Ok(telling)
}

/// Selects all samples in motion, and `enough` (at least two) of those held and of those at rest, evenly spread.
fn some_at_rest(problem: &LeastSquares, found: &Minima, enough: f64) -> Vec<bool> {
    const FEWEST: usize = 2;
    let Data::Samples { t, .. } = problem.data else { return vec![true; problem.data.residuals()] };
    let best = &found.valleys[0].optimum;
    let release = match found.start {
        StartKind::Release => best.p[LAST],
        StartKind::Moving => t[0],
    };
    let held = t.partition_point(|&t| t < release);
    let end = best.seen.turns.last().filter(|_| best.seen.rests);
    let rest =
        end.map_or(t.len(), |turn| t.partition_point(|&t| t < release + turn.tau / best.p[OMEGA0]));
    let mut some = vec![true; t.len()];
    for stretch in [0..held, rest..t.len()] {
        let kept = (whole(enough.ceil().min(1e9))).max(FEWEST);
        let length = stretch.len();
        if length > kept {
            some[stretch.clone()].fill(false);
            for number in 0..kept {
                some[stretch.start + (2 * number + 1) * length / (2 * kept)] = true;
            }
        }
    }
    some
}

/// Leaves out samples that cannot belong to the motion and fits again, until nothing changes.
fn refined(
    problem: &LeastSquares,
    robust: bool,
    found: &mut Minima,
    runs: &mut Runs,
) -> Result<Vec<bool>, NoFit> {
    /// A model that leaves out more than this fraction of the record does not describe it.
    const MOST: f64 = 0.15;
    const ROUNDS: usize = 4;
    let mut used = vec![true; problem.data.residuals()];
    // If the search used a robust loss, even an unchanged selection is fitted again.
    let mut settled = !robust;
    for _ in 0..ROUNDS {
        let seen = &found.valleys[0].optimum.seen;
        let values = seen.residuals.iter().map(|residual| residual.value);
        let limit = limit_of(&values.clone().collect::<Vec<_>>());
        let possible: Vec<bool> = values.map(|value| value.abs() <= limit).collect();
        let share = real(possible.iter().filter(|used| !**used).count()) / real(used.len());
        let now = if share > MOST { vec![true; used.len()] } else { possible };
        if settled && now == used {
            break;
        }
        (used, settled) = (now, true);
        LeastSquares { used: &used, ..*problem }.polish(found, runs)?;
    }
    Ok(used)
}

/// The size beyond which a residual does not belong to the motion: a multiple of the standard deviation of the
/// residuals within it.
fn limit_of(residuals: &[f64]) -> f64 {
    const ROUNDS: usize = 5;
    let mut limit = IMPOSSIBLE * robust_deviation(residuals.iter().copied());
    for _ in 0..ROUNDS {
        let within = residuals.iter().filter(|value| value.abs() <= limit);
        let (sum, count) =
            within.fold((0.0, 0.0), |(sum, count), value| (sum + value * value, count + 1.0));
        limit = IMPOSSIBLE * (sum / count).sqrt();
    }
    if limit > 0.0 { limit } else { f64::INFINITY }
}
