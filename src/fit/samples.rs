//! Fits a sampled motion.

use std::f64::consts::TAU;

use super::drift;
use super::estimate::{Estimate, judged};
use super::guess::{Guess, guess};
use super::levenberg_marquardt::{NoFit, Runs};
use super::loss::Loss;
use super::noise::{IMPOSSIBLE, Noise, robust_deviation, within_scale};
use super::observation::{BEND, Data, LAST, OFFSET, OMEGA0, SLOPE, StartKind};
use super::problem::LeastSquares;
use super::question::{LossName, Question, Unfit, placed, reach};
use super::record::Record;
use super::release::released_before;
use super::search::Minima;
use super::spectrum::dominant_frequency;
use crate::numerics::count::{real, truncated};
use crate::numerics::elementary::powi;

/// Fits a record of samples. Fails with [`Unfit`].
pub fn samples(record: &Record, question: &Question, runs: &mut Runs) -> Result<Estimate, Unfit> {
    let all = record.t.as_deref().unwrap_or_default();
    let frequency = dominant_frequency(all, &record.x);
    let per_period = frequency.map_or(f64::INFINITY, |frequency| {
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
    let signal = record.signal;
    let omega0 = TAU * frequency.unwrap_or(1.0);
    let factor = signal.as_displacement(omega0);
    let swinging: Vec<f64> = x.iter().map(|x| factor * x).collect();
    let quiet = Noise {
        deviation: factor.abs() * noise.deviation,
        step: factor.abs() * noise.step,
        ..noise
    };
    let guessed = |[slope, bend]: [f64; 2]| {
        let level = drift::without(&t, &swinging, [factor * slope, factor * bend]);
        let mut guess = guess(&t, &level, &quiet, signal)?;
        for p in guess.beginnings.iter_mut().flat_map(|beginning| &mut beginning.guesses) {
            p[OFFSET] /= factor;
            *p = placed(&held, *p);
            (p[SLOPE], p[BEND]) = (slope, bend);
        }
        Some(guess)
    };
    let Guess { beginnings, mut extremes, struck, again } =
        guessed([0.0; 2]).ok_or(Unfit::NoSwings)?;
    let saturated = all.len() - x.len();
    let part = |t: &[f64], x: &[f64], runs: &mut Runs| {
        let part = Record { t: Some(t.to_vec()), x: x.to_vec(), signal, ..Record::default() };
        samples(&part, question, runs).ok().filter(|found| !found.whiteness.systematic)
    };
    if let Some(until) = again
        && let Some(found) = part(&t[..until], &x[..until], runs)
    {
        return Ok(Estimate { after: x.len() - until, saturated, ..found });
    }
    if let Some(from) = struck.filter(|_| signal.is_displacement())
        && let Some(found) = part(&t[from..], &x[from..], runs)
    {
        return Ok(Estimate { before: from, saturated, ..found });
    }
    let loss = loss_of(question.loss, &noise);
    let reach = reach(&swinging);
    let data = Data::Samples { t: t.clone(), x: x.clone(), signal };
    let mut problem =
        LeastSquares { data: &data, free, loss, used: &[], noise: noise.deviation, reach };
    let mut found = problem.search(&beginnings, runs)?;
    let swings = drift::of_swings(&t, &extremes).map(|drift| drift / factor);
    let drifting = || guessed(swings).map(|guess| guess.beginnings).unwrap_or_default();
    if let Some((minima, free)) = problem.drifting(&found, drifting, runs)? {
        (found, problem.free) = (minima, free);
        let p = &found.valleys[0].optimum.p;
        extremes = guessed([p[SLOPE], p[BEND]]).map_or(extremes, |guess| guess.extremes);
    }
    if beginnings[0].start == StartKind::Release && !problem.explains(&found.valleys[0].optimum) {
        let other = released_before(&problem, &held, &noise, &extremes, runs)?;
        let cost = |of: &Minima| of.valleys[0].optimum.cost;
        found = other.filter(|other| cost(other) < cost(&found)).unwrap_or(found);
    }
    if let Some(from) = struck.filter(|_| !signal.is_displacement())
        && !problem.explains(&found.valleys[0].optimum)
        && let Some(found) = part(&t[from..], &x[from..], runs)
    {
        return Ok(Estimate { before: from, saturated, ..found });
    }
    let smooth = problem.smooth(&mut found, runs)?;
    let mut used = smooth.clone();
    let mut alike = vec![true; data.residuals()];
    if question.loss == LossName::Auto {
        problem.loss = Loss::Linear;
        used = refined(&problem, &smooth, loss.is_robust(), &mut found, runs)?;
        // If no motion fits, it is not known where the mass rests.
        if (LeastSquares { used: &used, ..problem }).comes_near(&found.valleys[0].optimum) {
            alike = telling(&problem, &noise, &mut used, &mut found, runs)?;
        }
    }
    let count = |flags: &[bool]| flags.iter().filter(|flag| !**flag).count();
    let mut estimate = judged(&problem, &used, &found, runs)?;
    let both: Vec<bool> = alike.iter().zip(&smooth).map(|(one, other)| *one && *other).collect();
    (estimate.alike, estimate.saturated) = (count(&both) - count(&smooth), count(&within));
    estimate.jumps = (0..smooth.len()).filter(|index| !smooth[*index]).collect();
    let scale = (signal.as_displacement(estimate.p[OMEGA0]) / factor).abs();
    for extreme in &mut extremes {
        extreme.x *= scale;
    }
    (estimate.choice, estimate.extremes, estimate.noise) =
        (question.choice.clone(), extremes, noise);
    Ok(estimate)
}

/// The loss with this name; by itself it is robust where there are outliers.
fn loss_of(name: LossName, noise: &Noise) -> Loss {
    let scale = 3.0 * noise.deviation;
    match name {
        LossName::Auto if noise.has_outliers => Loss::SoftL1 { scale },
        LossName::Auto | LossName::Linear => Loss::Linear,
        LossName::SoftL1 => Loss::SoftL1 { scale },
        LossName::Cauchy => Loss::Cauchy { scale },
    }
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
        let kept = (truncated(enough.ceil().min(1e9))).max(FEWEST);
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
    smooth: &[bool],
    robust: bool,
    found: &mut Minima,
    runs: &mut Runs,
) -> Result<Vec<bool>, NoFit> {
    /// A model that leaves out more than this fraction of the record does not describe it.
    const MOST: f64 = 0.15;
    const ROUNDS: usize = 4;
    let mut used = smooth.to_vec();
    // If the search used a robust loss, even an unchanged selection is fitted again.
    let mut settled = !robust;
    for _ in 0..ROUNDS {
        let seen = &found.valleys[0].optimum.seen;
        let values = seen.residuals.iter().map(|residual| residual.value);
        let limit = limit_of(&values.clone().collect::<Vec<_>>());
        let possible: Vec<bool> =
            values.zip(smooth).map(|(value, smooth)| *smooth && value.abs() <= limit).collect();
        let left_out = possible.iter().zip(smooth).filter(|(used, smooth)| **smooth && !**used);
        let share = real(left_out.count()) / real(used.len());
        let now = if share > MOST { smooth.to_vec() } else { possible };
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
