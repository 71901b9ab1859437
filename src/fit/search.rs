//! The search for the best minimum from first guesses, with several starts and growing horizons; and with a drift of the
//! zero beside the motion, along a line or a parabola over the record, where the record shows one.

use serde::Serialize;

use super::{
    BEND, Beginning, Covariance, D2, D3, Extreme, Guess, LAST, LinearResiduals, Loss, LossName,
    NAMES, Noise, OFFSET, OMEGA0, Optimum, Q0, R, Record, SLOPE, StartKind, Task, UNKNOWNS,
    Unknowns, WIDE, Way, autocorrelations, by_cost, closest, drift, follow, guess, middle_of,
    parameters, placed, robust,
};
use crate::model::State;
use crate::numerics::{pow, powi, real};

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
            let from = best.clone();
            for guess in [-2, -1, 1, 2].into_iter().filter_map(|it| released_after(&from, it)) {
                best = best.or_lower(self.solve(guess));
            }
            if best.cost == from.cost || self.explains(&best) {
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
        let needed = if found.start == StartKind::Release { 4.0 * unit } else { -4.0 * unit };
        let needed = if self.data.has_peaks() { 0.0 } else { needed };
        found.cost < best.cost - needed
    }

    /// For each way of beginning, the guess that is closest to the record before any descent. Guesses without D2 and
    /// D3 are also tried, since with wrong values of these every motion may escape.
    pub(crate) fn ranked(&self, guesses: &[Beginning]) -> Vec<(StartKind, Unknowns, bool)> {
        let mut starts = Vec::new();
        for Beginning { start, certain, guesses } in guesses {
            let task = self.starting(*start);
            let mut best = (f64::INFINITY, None);
            let plain = guesses.iter().map(|guess| self.without(*guess, &[D2, D3]));
            for guess in guesses.iter().copied().chain(plain) {
                if let Some(seen) = task.evaluated(&guess, false) {
                    let cost = task.cost(&seen);
                    if cost < best.0 {
                        best = (cost, Some(guess));
                    }
                }
            }
            starts.extend(best.1.map(|guess| (*start, guess, *certain)));
        }
        starts
    }

    /// A guess with zero for some of the unknowns, as far as they are free.
    fn without(&self, mut guess: Unknowns, places: &[usize]) -> Unknowns {
        for &place in places.iter().filter(|place| self.free[**place]) {
            guess[place] = 0.0;
        }
        guess
    }

    /// Descends on a growing part of the record, with a robust loss that tolerates samples that are still far off.
    fn growing(&self, guess: Unknowns) -> Option<Optimum> {
        let mut p = guess;
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
        let rough = robust.solve_roughly(p)?;
        self.solve(rough.p)
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
    let from = t.partition_point(|&t| t < first.t);
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

/// A drift that a fit leaves over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
        let (drift, step) = LeftDrift::with_step(&self.starting(best.start), best)?;
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
        let bend = Covariance::white(&wider, least).map_or(0.0, |it| it.of(BEND, BEND));
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
