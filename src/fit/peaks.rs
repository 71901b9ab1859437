//! Fits a list of turning points.

use super::{
    Beginning, Data, Estimate, Extreme, LAST, OFFSET, OMEGA0, Q0, Question, R, Record, Runs,
    Signal, StartKind, Task, Unfit, judged, period_of, placed, ratio_of_kinds, reach, regressions,
};

/// Fits a list of peaks. The relative weight of displacements and times follows from their residuals.
/// Fails with [`Unfit`].
pub fn peaks(record: &Record, question: &Question, runs: &mut Runs) -> Result<Estimate, Unfit> {
    const ROUNDS: usize = 8;
    let x = &record.x;
    let mut held = question.choice.unknowns();
    if record.t.is_none() {
        (held[OMEGA0], held[LAST]) = (Some(1.0), Some(0.0));
    }
    let free = held.map(|held| held.is_none());
    let unknowns = free.iter().filter(|free| **free).count();
    let t = record.t.clone();
    let measured = x.len() * if t.is_some() { 2 } else { 1 };
    let seen_in_x = unknowns - usize::from(free[OMEGA0]) - usize::from(free[LAST]);
    if x.len() < 3 || x.len() <= seen_in_x {
        return Err(Unfit::TooFew { measured: x.len(), unknowns: seen_in_x });
    }
    let turned = |three: &[f64]| (three[1] - three[0]) * (three[2] - three[1]) >= 0.0;
    let wrong = x.windows(3).filter(|three| turned(three)).count();
    if 3 * wrong > x.len() {
        let peak = x.windows(3).position(turned).unwrap_or(0) + 1;
        return Err(Unfit::NotAlternating { peak });
    }
    let time = |index: usize| t.as_ref().map_or(0.0, |t| t[index]);
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
    if measured <= unknowns {
        return Err(Unfit::TooFew { measured, unknowns });
    }
    let of = |ratio: f64| Data {
        t: t.clone().unwrap_or_default(),
        x: x.clone(),
        signal: Signal::Displacement,
        peaks: Some(ratio),
    };
    let reach = reach(x);
    let mut data = of(ratio);
    let mut found = Task::new(&data, StartKind::Release, free, reach).search(&starts, runs)?;
    for _ in 0..ROUNDS {
        let task = Task::new(&data, StartKind::Release, free, reach);
        let next = ratio * ratio_of_kinds(&task, &found[0], x.len());
        if t.is_none() || !next.is_finite() || (next / ratio - 1.0).abs() < 0.01 {
            break;
        }
        ratio = next;
        data = of(ratio);
        Task::new(&data, StartKind::Release, free, reach).polish(&mut found, runs)?;
    }
    let task = Task::new(&data, StartKind::Release, free, reach);
    let used = vec![true; data.residuals()];
    let mut estimate = judged(&Task { used: &used, ..task }, &found, runs)?;
    (estimate.choice, estimate.extremes) = (question.choice.clone(), extremes);
    Ok(estimate)
}
