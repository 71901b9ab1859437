//! The search for the best minimum from first guesses, with several starts and growing horizons.

use super::{
    Beginning, D2, D3, Extreme, Guess, LAST, Loss, LossName, Noise, OFFSET, OMEGA0, Optimum, Q0, R,
    Record, StartKind, Task, UNKNOWNS, Unknowns, WIDE, Way, by_cost, closest, follow, guess,
    index_at, parameters, placed,
};
use crate::model::State;
use crate::numerics::{pow, real};

/// The fractions of a record to which the horizon grows.
const HORIZONS: [f64; 4] = [0.2, 0.35, 0.6, 0.85];

/// Number of motions with derivatives after which no other way of descent is tried: a record that is not
/// explained by then is not a motion of this oscillator.
const ENOUGH: u64 = 250;

/// Fewest half swings within a horizon.
const FEWEST: usize = 4;

impl Task<'_> {
    /// Descends from the closest guess of each way of beginning, trying one way of descent after the other,
    /// until a minimum explains the record; otherwise the best minimum found is taken. The minima of all regions
    /// follow, the lowest first. `None` if no descent succeeds, or if the computation has ended.
    pub(crate) fn search(&self, guesses: &[Beginning]) -> Option<Vec<Optimum>> {
        let mut best: Option<Optimum> = None;
        let mut starts = self.ranked(guesses);
        for (round, way) in WAYS.into_iter().enumerate() {
            let mut costs = Vec::new();
            for &(start, guess, certain) in &starts {
                let found = way(&self.starting(start), guess);
                costs.push(found.as_ref().map_or(f64::INFINITY, |found| found.cost));
                let Some(found) = found else { continue };
                let closest = &self.runs.closest;
                closest.set(closest.get().min(self.unit(found.cost).sqrt()));
                let explained = self.explains(&found);
                if best.as_ref().is_none_or(|best| self.is_better(&found, best)) {
                    best = Some(found);
                }
                if explained && (certain || round > 0) {
                    break;
                }
            }
            let tired = self.runs.with_derivatives.get() > ENOUGH;
            if best.as_ref().is_some_and(|best| tired || self.explains(best)) {
                break;
            }
            // The beginning that came closest is tried first in the next round.
            let mut ranked: Vec<_> = costs.into_iter().zip(starts).collect();
            ranked.sort_by(|one, other| one.0.total_cmp(&other.0));
            starts = ranked.into_iter().map(|(_, start)| start).collect();
        }
        let mut optimum = best.filter(|_| !self.runs.has_ended())?;
        let task = self.starting(optimum.start);
        if optimum.start == StartKind::Release && !self.explains(&optimum) {
            optimum = task.released_elsewhere(optimum);
        }
        let mut optima = vec![optimum];
        if task.may_be_elsewhere(&optima[0]) {
            let alike = guesses.iter().filter(|beginning| beginning.start == optima[0].start);
            let guesses = alike.flat_map(|beginning| beginning.guesses.iter().copied());
            let guesses = guesses.chain([optima[0].p]).collect();
            optima.extend(task.by_fewer_terms(guesses));
        }
        Some(task.valleys(optima)).filter(|_| !self.runs.has_ended())
    }

    /// The lowest minimum if the same motion was released some periods earlier or later.
    fn released_elsewhere(&self, mut best: Optimum) -> Optimum {
        const ROUNDS: usize = 3;
        for _ in 0..ROUNDS {
            let guesses = [-2, -1, 1, 2].into_iter().filter_map(|it| released_after(&best, it));
            let found = guesses.filter_map(|guess| self.solve(guess)).min_by(by_cost);
            let Some(lower) = found.filter(|it| it.cost < best.cost) else { break };
            best = lower;
            if self.explains(&best) {
                break;
            }
        }
        best
    }

    /// The minima reached from those without D2 and D3, which have fewer valleys if noise leaves room for many.
    fn by_fewer_terms(&self, guesses: Vec<Unknowns>) -> Vec<Optimum> {
        /// Maximum number of minima from which to continue.
        const MOST: usize = 3;
        let fewer = self.holding(D2).holding(D3);
        let guesses = guesses.into_iter().map(|guess| self.without(guess, &[D2, D3])).collect();
        let beginning = Beginning { start: self.start, certain: true, guesses };
        let best = fewer.ranked(&[beginning]).into_iter().next();
        let Some(found) = best.and_then(|(_, guess, _)| fewer.solve(guess)) else {
            return Vec::new();
        };
        let through = closest(fewer.through_the_valley(&found, WIDE), &[]).into_iter();
        let optima = through.filter_map(|guess| fewer.solve(guess)).chain([found]).collect();
        let minima = fewer.valleys(optima).into_iter().take(MOST);
        minima.filter_map(|minimum| self.solve(minimum.p)).collect()
    }

    /// Fits every minimum again with the residuals that now count. `None` if the computation has ended, or if
    /// the motion is lost.
    pub(crate) fn polish(&self, found: &mut [Optimum]) -> Option<()> {
        for minimum in &mut *found {
            *minimum = self.starting(minimum.start).around(&minimum.seen).solve(minimum.p)?;
        }
        found.sort_by(by_cost);
        Some(())
    }

    /// Seeks the minima again with the residuals that now count, from the best one. Fails as [`Task::polish`].
    pub(crate) fn renew(&self, found: &mut Vec<Optimum>) -> Option<()> {
        let task = self.starting(found[0].start);
        let optimum = task.solve(found[0].p)?;
        *found = task.valleys(vec![optimum]);
        Some(())
    }

    /// Whether a minimum is better than the best one so far. A release must be clearly better than a mass in
    /// motion, since otherwise the record shows no hold.
    fn is_better(&self, found: &Optimum, best: &Optimum) -> bool {
        let unit = self.unit(best.cost);
        let needed = if found.start == StartKind::Release {
            4.0 * unit
        } else {
            -4.0 * unit
        };
        let needed = if self.data.has_peaks() { 0.0 } else { needed };
        found.cost < best.cost - needed
    }

    /// For each way of beginning, the guess that is closest to the record before any descent. Guesses without D2 and
    /// D3 are also tried, since with wrong values of these every motion may escape.
    pub(crate) fn ranked(&self, guesses: &[Beginning]) -> Vec<(StartKind, Unknowns, bool)> {
        let start = |Beginning { start, certain, guesses }: &Beginning| {
            let task = self.starting(*start);
            let plain = guesses.iter().map(|guess| self.without(*guess, &[D2, D3]));
            let tried = guesses.iter().copied().chain(plain).filter_map(|guess| {
                let cost = task.cost(&task.evaluated(&guess, false)?);
                cost.is_finite().then_some((cost, guess))
            });
            let (_, closest) = tried.min_by(|one, other| one.0.total_cmp(&other.0))?;
            Some((*start, closest, *certain))
        };
        guesses.iter().filter_map(start).collect()
    }

    /// A guess with zero for some of the unknowns, as far as they are free.
    fn without(&self, mut guess: Unknowns, places: &[usize]) -> Unknowns {
        for &place in places.iter().filter(|place| self.free[**place]) {
            guess[place] = 0.0;
        }
        guess
    }

    /// Descends on a growing part of the record, with a robust loss that tolerates samples that are still far off.
    fn growing(&self, mut p: Unknowns) -> Option<Optimum> {
        let t = &self.data.t;
        if self.data.has_peaks() {
            return self.solve(p);
        }
        let last = t[t.len() - 1];
        let shortest = real(FEWEST) * std::f64::consts::PI / p[OMEGA0];
        let begin = self.start.beginning(&p, t).0.max(t[0]);
        let scale = 3.0 * self.noise.max(f64::MIN_POSITIVE);
        let robust = Task { loss: Loss { name: LossName::SoftL1, scale }, ..*self };
        for part in HORIZONS {
            let until = begin + (part * (last - begin)).max(shortest);
            let horizon = t.partition_point(|&t| t <= until);
            if horizon >= t.len() {
                break;
            }
            p = Task { horizon, ..robust }.solve_roughly(p)?.p;
        }
        self.solve(robust.solve_roughly(p)?.p)
    }
}

/// The unknowns of nearly the same motion, released some periods later or, by the ratio of its first swings, earlier.
fn released_after(from: &Optimum, periods: i32) -> Option<Unknowns> {
    let turn = from.seen.turns.get(2 * periods.unsigned_abs() as usize - 1)?;
    let (ratio, sign) = (turn.q / from.p[Q0], f64::from(periods.signum()));
    let mut p = from.p;
    p[Q0] *= pow(ratio.abs(), sign);
    p[LAST] += sign * turn.tau / p[OMEGA0];
    Some(p)
}

/// A way of descent from a guess to a minimum.
type Descent = fn(&Task, Unknowns) -> Option<Optimum>;

/// The ways of descent in the order in which they are tried.
const WAYS: [Descent; 4] = [
    |task, guess| task.solve(guess),
    |task, guess| task.growing(guess),
    |task, guess| task.growing(task.without(guess, &[D2, D3])),
    |task, guess| task.growing(task.without(guess, &[R])),
];

/// The minima from guesses that release the held mass so that it comes into the motion after its first swings. Those of a
/// growth from near an unstable cycle say little about the motion: it is fitted without them, and then followed from the
/// hold.
///
/// `extremes` are the hold and the turning points. `None` if there is no such motion, or if the
/// signal does not show where the mass was held.
pub fn released_before(
    task: &Task,
    held: &[Option<f64>; UNKNOWNS],
    noise: &Noise,
    extremes: &[Extreme],
) -> Option<Vec<Optimum>> {
    /// Number of turning points left out, at most, and the part of all.
    const FIRST: usize = 4;
    const PART: usize = 4;
    /// Number of swings between the release and the fitted motion, at most.
    const SWINGS: usize = 60;
    let Record { t, x, signal, .. } = task.data;
    if !signal.is_displacement() {
        return None;
    }
    let first = extremes[FIRST.min(extremes.len() / PART)];
    let from = index_at(t, first.t);
    let (later, times) = (&x[from..], &t[from..]);
    let Guess { mut beginnings, .. } = guess(times, later, noise, *signal)?;
    beginnings.retain(|beginning| beginning.start == StartKind::Moving);
    for guess in beginnings.iter_mut().flat_map(|beginning| &mut beginning.guesses) {
        *guess = placed(held, *guess);
    }
    let data = Record { t: times.to_vec(), x: later.to_vec(), ..task.data.clone() };
    let part = Task { data: &data, ..*task };
    let found = part.search(&beginnings)?;
    let optimum = &found[0];
    let turn = optimum.seen.turns.first().filter(|_| part.explains(optimum))?;
    let p = &optimum.p;
    let begin = State { q: extremes[0].x - p[OFFSET], v: 0.0 };
    let way = Way { reach: task.reach, turns: SWINGS, ..Way::default() };
    let motion = follow(&parameters(p), begin, &[f64::MAX], way, |_, _| {}).ok()?;
    let released = |tau: f64| {
        let mut guess: Unknowns = *p;
        (guess[Q0], guess[LAST]) = (begin.q, times[0] + (turn.tau - tau) / p[OMEGA0]);
        guess
    };
    let same = motion.turns.iter().filter(|it| it.q * turn.q > 0.0);
    let guesses = same.map(|it| placed(held, released(it.tau))).filter(|it| it[LAST] > t[0]);
    let guesses: Vec<Unknowns> = guesses.collect();
    let beginning = Beginning { start: StartKind::Release, certain: true, guesses };
    task.search(&[beginning])
}
