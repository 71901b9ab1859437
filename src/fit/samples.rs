//! Fits a sampled motion.

use super::estimate::{Estimate, judged};
use super::guess::{Guess, guess};
use super::levenberg_marquardt::{NoFit, Runs};
use super::loss::Loss;
use super::noise::{Noise, robust_deviation, within_scale};
use super::observation::Data;
use super::problem::Problem;
use super::question::{LossName, Question, Unfit, placed, reach};
use super::record::Record;
use super::search::Found;

/// Fits a record of samples.
///
/// # Errors
/// [`Unfit`].
pub fn samples(record: &Record, question: &Question, runs: &mut Runs) -> Result<Estimate, Unfit> {
    let within = within_scale(&record.x, Noise::of(&record.x).deviation);
    let keep = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(&within).filter(|(_, within)| **within).map(|(value, _)| *value).collect()
    };
    let (t, x) = (keep(record.t.as_deref().unwrap_or_default()), keep(&record.x));
    let held = question.choice.unknowns();
    let free = held.map(|held| held.is_none());
    let unknowns = free.iter().filter(|free| **free).count();
    if x.len() < unknowns + 8 {
        return Err(Unfit::TooFew { measured: x.len(), unknowns });
    }
    let noise = Noise::of(&x);
    let Guess { mut beginnings, extremes } = guess(&t, &x, &noise).ok_or(Unfit::NoSwings)?;
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
    let mut problem = Problem { data: &data, free, loss, used: &[], noise: noise.deviation, reach };
    let mut found = problem.search(&beginnings, runs)?;
    let mut used = vec![true; data.residuals()];
    if question.loss == LossName::Auto {
        problem.loss = Loss::Linear;
        used = refined(&problem, loss.is_robust(), &mut found, runs)?;
    }
    let saturated = within.iter().filter(|within| !**within).count();
    let mut estimate = judged(&problem, &used, &found, runs)?;
    estimate.choice = question.choice.clone();
    (estimate.extremes, estimate.noise, estimate.saturated) = (extremes, noise, saturated);
    Ok(estimate)
}

/// Leaves out what cannot belong to the motion and fits again, until nothing changes.
fn refined(
    problem: &Problem,
    robust: bool,
    found: &mut Found,
    runs: &mut Runs,
) -> Result<Vec<bool>, NoFit> {
    /// A model that leaves out more than this part of the record does not describe it.
    const MOST: f64 = 0.15;
    const ROUNDS: usize = 4;
    let mut used = vec![true; problem.data.residuals()];
    // The search may have ended with a loss that forgives: then even an unchanged choice is fitted again.
    let mut settled = !robust;
    for _ in 0..ROUNDS {
        let seen = &found.valleys[0].optimum.seen;
        let values = seen.residuals.iter().map(|residual| residual.value);
        let limit = limit_of(&values.clone().collect::<Vec<_>>());
        let possible: Vec<bool> = values.map(|value| value.abs() <= limit).collect();
        #[expect(clippy::cast_precision_loss, reason = "counts of samples")]
        let share = possible.iter().filter(|used| !**used).count() as f64 / used.len() as f64;
        let now = if share > MOST { vec![true; used.len()] } else { possible };
        if settled && now == used {
            break;
        }
        (used, settled) = (now, true);
        Problem { used: &used, ..*problem }.polish(found, runs)?;
    }
    Ok(used)
}

/// The size beyond which a residual is none of the motion's: so many deviations of those within it. Chance puts 7 in a
/// million there.
fn limit_of(residuals: &[f64]) -> f64 {
    const IMPOSSIBLE: f64 = 4.5;
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
