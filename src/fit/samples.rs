//! Fits a sampled motion, or a list of turning points.
//!
//! Friction turns round with the velocity, so an acceleration jumps at every turning point, at the release and at the
//! rest. On which side of a jump a sample lies depends on the unknowns, and no derivative tells of it; and no
//! sensor follows a jump. So the samples next to the jumps of an acceleration are left out.

use std::f64::consts::TAU;
use std::iter::{repeat, repeat_n};
use std::ops::Range;

use super::{
    BEND, Beginning, DropReason, Estimate, Extreme, Guess, IMPOSSIBLE, LAST, Loss, LossName,
    NoEstimate, Noise, OFFSET, OMEGA0, Optimum, Q0, Question, R, Record, Runs, SLOPE, Signal,
    StartKind, Task, dominant_frequency, drift_of_swings, guess, index_at, judged, mean_square,
    period_of, placed, rate, ratio_of_kinds, reach, regressions, released_before, robust_deviation,
    within_scale, without_drift,
};
use crate::numerics::{real, truncated};

/// Fits a record of samples or of peaks. Fails with [`NoEstimate`].
pub fn of_kind(record: &Record, question: &Question, runs: &Runs) -> Result<Estimate, NoEstimate> {
    if question.peaks {
        peaks(record, question, runs)
    } else {
        samples(record, question, runs)
    }
}

/// Fits a record of samples. Fails with [`NoEstimate`].
fn samples(record: &Record, question: &Question, runs: &Runs) -> Result<Estimate, NoEstimate> {
    let all = &record.t;
    let frequency = dominant_frequency(all, &record.x);
    let per_period = frequency.map_or(f64::INFINITY, |frequency| rate(all) / frequency);
    let within = within_scale(&record.x, &Noise::of(&record.x, per_period));
    let keep = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(&within).filter(|(_, within)| **within).map(|(value, _)| *value).collect()
    };
    let (t, x) = (keep(all), keep(&record.x));
    let held = question.choice.unknowns();
    let free = held.map(|held| held.is_none());
    let unknowns = free.iter().filter(|free| **free).count();
    if x.len() < unknowns + 8 {
        return Err(NoEstimate::TooFew { measured: x.len(), unknowns });
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
        let level = without_drift(&t, &swinging, [factor * slope, factor * bend]);
        let mut guess = guess(&t, &level, &quiet, signal)?;
        for p in guess.beginnings.iter_mut().flat_map(|beginning| &mut beginning.guesses) {
            p[OFFSET] /= factor;
            *p = placed(&held, *p);
            (p[SLOPE], p[BEND]) = (slope, bend);
        }
        Some(guess)
    };
    let Guess { beginnings, mut extremes, struck, again } =
        guessed([0.0; 2]).ok_or(NoEstimate::NoSwings)?;
    let cut = |range: Range<usize>| {
        let (t, x) = (t[range.clone()].to_vec(), x[range].to_vec());
        Record { t, x, signal, unit: record.unit.clone(), ..Record::default() }
    };
    let part = |range: Range<usize>| {
        let from = range.start;
        let found = samples(&cut(range), question, runs).ok();
        found.filter(|it| !it.whiteness.systematic).map(|it| of_part(it, from, &within))
    };
    let struck = struck.map(|from| from..x.len());
    let at_once = struck.clone().filter(|_| signal.is_displacement());
    let mut parts = again.map(|until| 0..until).into_iter().chain(at_once);
    if let Some(found) = parts.find_map(part) {
        return Ok(found);
    }
    let name = match question.loss {
        LossName::Auto if noise.has_outliers => LossName::SoftL1,
        name => name,
    };
    let loss = Loss { name, scale: 3.0 * noise.deviation };
    let reach = reach(&swinging);
    let data = cut(0..x.len());
    let start = beginnings[0].start;
    let blank = Task::new(&data, runs);
    let mut task = Task { start, free, reach, loss, noise: noise.deviation, ..blank };
    let lost = || runs.ended().unwrap_or(NoEstimate::NoMotion);
    let mut found = task.search(&beginnings).ok_or_else(lost)?;
    let swings = drift_of_swings(&t, &extremes).map(|drift| drift / factor);
    let drifting = || guessed(swings).map(|guess| guess.beginnings).unwrap_or_default();
    if let Some((minima, free)) = task.drifting(&found, drifting) {
        (found, task.free) = (minima, free);
        let p = &found[0].p;
        extremes = guessed([p[SLOPE], p[BEND]]).map_or(extremes, |guess| guess.extremes);
    }
    if start == StartKind::Release && !task.explains(&found[0]) {
        let other = released_before(&task, &held, &noise, &extremes);
        found = other.filter(|other| other[0].cost < found[0].cost).unwrap_or(found);
    }
    if let Some(range) = struck.filter(|_| !signal.is_displacement())
        && !task.explains(&found[0])
        && let Some(found) = part(range)
    {
        return Ok(found);
    }
    let dropped = vec![None; data.residuals()];
    let mut sorted = SampleSelection { task, found, dropped, is_due: false };
    sorted.sort_out(&noise, question.loss).ok_or_else(lost)?;
    let estimate = judged(&sorted.task(), &sorted.found)?;
    let estimate = of_part(estimate, 0, &within);
    let scale = (signal.as_displacement(estimate.p[OMEGA0]) / factor).abs();
    for extreme in &mut extremes {
        extreme.x *= scale;
    }
    Ok(Estimate { choice: question.choice.clone(), extremes, noise, ..estimate })
}

/// The answer for some of the samples within the scale, from this one on, as one for the whole record.
fn of_part(found: Estimate, from: usize, within: &[bool]) -> Estimate {
    let before = repeat_n(Some(DropReason::Before), from);
    let after = repeat(Some(DropReason::After));
    let mut inner = before.chain(found.dropped).chain(after);
    let saturated = Some(DropReason::Saturated);
    let why = |within: &bool| if *within { inner.next().flatten() } else { saturated };
    Estimate { dropped: within.iter().map(why).collect(), ..found }
}

/// Seeks minima again with the residuals that now count. `None` if the computation has ended, or if the motion is lost.
type Refit = fn(&Task, &mut Vec<Optimum>) -> Option<()>;

/// A fit whose samples are sorted out: which of them count follows from the motion, and the motion from these.
struct SampleSelection<'a> {
    task: Task<'a>,
    /// The minima, the lowest first.
    found: Vec<Optimum>,
    dropped: Vec<Option<DropReason>>,
    /// Whether the next selection is fitted even if nothing has changed.
    is_due: bool,
}

impl SampleSelection<'_> {
    /// What is estimated from the samples that count.
    fn task(&self) -> Task<'_> {
        Task { dropped: &self.dropped, ..self.task }
    }

    /// Leaves out samples next to jumps, outliers and readings at rest. `None` as [`Refit`].
    fn sort_out(&mut self, noise: &Noise, loss: LossName) -> Option<()> {
        let renew: Refit = |task, found| task.renew(found);
        let polish: Refit = |task, found| task.polish(found);
        let Record { t, signal, .. } = self.task.data;
        if *signal == Signal::Acceleration {
            // The jumps move as the fit improves.
            self.leave_out(2, renew, |_, best, _| beside_jumps(best, t))?;
        }
        if loss != LossName::Auto {
            return Some(());
        }
        // If the search used a robust loss, even an unchanged selection is fitted again.
        self.is_due = self.task.loss.name == LossName::SoftL1;
        self.task.loss = Loss::LINEAR;
        self.leave_out(4, polish, |_, best, before| outliers(best, before))?;
        // If no motion fits, it is not known where the mass rests.
        if self.task().comes_near(&self.found[0]) {
            // Two rounds, since the first fit, biased by the common error at rest, overestimates the noise.
            self.leave_out(2, renew, |task, best, before| {
                let variance = mean_square(&task.values(&best.seen));
                let enough = noise.readings_at_rest(variance);
                alike_at_rest(task, best, enough, before)
            })?;
        }
        Some(())
    }

    /// Leaves out what `why` says of the best minimum and of what was left out before, and fits again, until nothing
    /// changes. `None` as [`Refit`].
    fn leave_out(
        &mut self,
        rounds: usize,
        refit: Refit,
        why: impl Fn(&Task, &Optimum, &[Option<DropReason>]) -> Vec<Option<DropReason>>,
    ) -> Option<()> {
        let before = self.dropped.clone();
        for _ in 0..rounds {
            let now = why(&self.task(), &self.found[0], &before);
            if now == self.dropped && !self.is_due {
                break;
            }
            (self.dropped, self.is_due) = (now, false);
            refit(&Task { dropped: &self.dropped, ..self.task }, &mut self.found)?;
        }
        Some(())
    }
}

/// The samples closer to a jump of an acceleration than half a step, or than the phase of a record is uncertain by.
fn beside_jumps(best: &Optimum, t: &[f64]) -> Vec<Option<DropReason>> {
    /// In radians of the phase.
    const UNCERTAIN: f64 = 0.03;
    let omega0 = best.p[OMEGA0];
    let near = f64::max(0.5 / rate(t), UNCERTAIN / omega0);
    let (origin, _) = best.start.beginning(&best.p, t);
    let release = Some(origin).filter(|_| best.start == StartKind::Release);
    let turns = best.seen.turns.iter().map(|turn| origin + turn.tau / omega0);
    let mut dropped = vec![None; t.len()];
    for jump in release.into_iter().chain(turns) {
        let range = [jump - near, jump + near].map(|end| t.partition_point(|t| *t <= end));
        dropped[range[0]..range[1]].fill(Some(DropReason::Jump));
    }
    dropped
}

/// Beside what was left out before the readings of a mass at rest that only repeat the rounding error of others: all of
/// those held, and all of those at rest, except for `enough` (at least two) of each, evenly spread.
fn alike_at_rest(
    task: &Task,
    best: &Optimum,
    enough: f64,
    before: &[Option<DropReason>],
) -> Vec<Option<DropReason>> {
    const FEWEST: usize = 2;
    let t = &task.data.t;
    let (release, _) = best.start.beginning(&best.p, t);
    let held = index_at(t, release);
    let end = best.seen.turns.last().filter(|_| best.seen.rests);
    let rest = end.map_or(t.len(), |turn| index_at(t, release + turn.tau / best.p[OMEGA0]));
    let kept = truncated(enough.ceil().min(1e9)).max(FEWEST);
    let mut dropped = before.to_vec();
    for stretch in [0..held, rest..t.len()] {
        let length = stretch.len();
        if length <= kept {
            continue;
        }
        for why in &mut dropped[stretch.clone()] {
            *why = why.filter(|why| *why == DropReason::Jump).or(Some(DropReason::Alike));
        }
        for number in 0..kept {
            let index = stretch.start + (2 * number + 1) * length / (2 * kept);
            dropped[index] = before[index];
        }
    }
    dropped
}

/// Beside what was left out before the samples that cannot belong to the motion.
fn outliers(best: &Optimum, before: &[Option<DropReason>]) -> Vec<Option<DropReason>> {
    /// A model that leaves out more than this fraction of the record does not describe it.
    const MOST: f64 = 0.15;
    let values: Vec<f64> = best.seen.residuals.iter().map(|it| it.value).collect();
    let limit = limit_of(&values);
    let why = |(before, value): (&Option<DropReason>, &f64)| {
        before.or((value.abs() > limit).then_some(DropReason::Outlier))
    };
    let now: Vec<_> = before.iter().zip(&values).map(why).collect();
    let outliers = now.iter().filter(|why| **why == Some(DropReason::Outlier)).count();
    if real(outliers) > MOST * real(now.len()) {
        before.to_vec()
    } else {
        now
    }
}

/// The size beyond which a residual does not belong to the motion: a multiple of the standard deviation of the
/// residuals within it.
fn limit_of(residuals: &[f64]) -> f64 {
    const ROUNDS: usize = 5;
    let mut limit = IMPOSSIBLE * robust_deviation(residuals.iter().copied());
    for _ in 0..ROUNDS {
        let within = residuals.iter().copied().filter(|value| value.abs() <= limit);
        limit = IMPOSSIBLE * mean_square(&within.collect::<Vec<_>>()).sqrt();
    }
    if limit > 0.0 { limit } else { f64::INFINITY }
}

/// Fits a list of peaks. The relative weight of displacements and times follows from their residuals.
/// Fails with [`NoEstimate`].
fn peaks(record: &Record, question: &Question, runs: &Runs) -> Result<Estimate, NoEstimate> {
    const ROUNDS: usize = 8;
    let x = &record.x;
    let mut held = question.choice.unknowns();
    if record.t.is_empty() {
        (held[OMEGA0], held[LAST]) = (Some(1.0), Some(0.0));
    }
    let free = held.map(|held| held.is_none());
    let unknowns = free.iter().filter(|free| **free).count();
    let seen_in_x = unknowns - usize::from(free[OMEGA0]) - usize::from(free[LAST]);
    if x.len() < 3 || x.len() <= seen_in_x {
        return Err(NoEstimate::TooFew { measured: x.len(), unknowns: seen_in_x });
    }
    let turned = |three: &[f64]| (three[1] - three[0]) * (three[2] - three[1]) >= 0.0;
    let wrong = x.windows(3).filter(|three| turned(three)).count();
    if 3 * wrong > x.len() {
        let peak = x.windows(3).position(turned).unwrap_or(0) + 1;
        return Err(NoEstimate::NotAlternating { peak });
    }
    let time = |index: usize| record.t.get(index).copied().unwrap_or(0.0);
    let extremes: Vec<Extreme> =
        x.iter().enumerate().map(|(index, &x)| Extreme { t: time(index), x }).collect();
    let omega0 = period_of(&extremes).map_or(1.0, |period| std::f64::consts::TAU / period);
    let mut guesses = Vec::new();
    for averaged in regressions(&extremes) {
        let mut p = averaged;
        (p[OMEGA0], p[Q0], p[LAST]) = (omega0, x[0] - averaged[OFFSET], time(0));
        // A guess that comes to rest before the last peak is useless; with less friction the mass keeps moving.
        for part in [1.0, 0.9, 0.7, 0.4, 0.0] {
            p[R] = part * averaged[R];
            guesses.push(placed(&held, p));
        }
    }
    let starts = [Beginning { start: StartKind::Release, certain: true, guesses }];
    let amplitude = 0.5 * (x[1] - x[0]).abs();
    let mut ratio = 1.0 / (omega0 * amplitude);
    let mut data = Record { peaks: Some(ratio), ..record.clone() };
    let lost = || runs.ended().unwrap_or(NoEstimate::NoMotion);
    let plain = Task { free, reach: reach(x), ..Task::new(record, runs) };
    let mut found = Task { data: &data, ..plain }.search(&starts).ok_or_else(lost)?;
    for _ in 0..ROUNDS {
        let task = Task { data: &data, ..plain };
        let next = ratio * ratio_of_kinds(&task, &found[0], x.len());
        // Without times there is no ratio.
        if !next.is_finite() || (next / ratio - 1.0).abs() < 0.01 {
            break;
        }
        ratio = next;
        data.peaks = Some(ratio);
        Task { data: &data, ..plain }.polish(&mut found).ok_or_else(lost)?;
    }
    let dropped = vec![None; data.residuals()];
    let estimate = judged(&Task { data: &data, dropped: &dropped, ..plain }, &found)?;
    Ok(Estimate { choice: question.choice.clone(), extremes, ..estimate })
}
