//! The search for the best minimum from first guesses, with several starts and growing horizons.

use super::levenberg_marquardt::{NoFit, Optimum, Runs, Task, interrupted};
use super::loss::Loss;
use super::observation::{D2, D3, Data, LAST, OMEGA0, Q0, R, StartKind, Unknowns};
use super::problem::LeastSquares;
use super::valley::{Valley, WIDE, by_cost, through_the_valley};
use crate::numerics::count::real;
use crate::numerics::elementary::pow;

/// A way in which a record may begin, with guesses of the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Beginning {
    /// How the motion begins.
    pub start: StartKind,
    /// Whether the record leaves no doubt about this.
    pub certain: bool,
    /// Guesses of the unknowns.
    pub guesses: Vec<Unknowns>,
}

/// The minima that were found.
#[derive(Clone, Debug)]
pub struct Minima {
    /// How the motion begins.
    pub start: StartKind,
    /// The minima in the order of their cost; the first is the answer.
    pub valleys: Vec<Valley>,
}

/// The fractions of a record to which the horizon grows.
const HORIZONS: [f64; 4] = [0.2, 0.35, 0.6, 0.85];

/// Number of motions with derivatives after which no other way of descent is tried: a record that is not
/// explained by then is not a motion of this oscillator.
const ENOUGH: u64 = 250;

/// Fewest half swings within a horizon.
const FEWEST: usize = 4;

impl LeastSquares<'_> {
    /// Descends from the closest guess of each way of beginning, trying one way of descent after the other,
    /// until a minimum explains the record; otherwise the best minimum found is taken. Fails with [`NoFit`] if
    /// no descent succeeds.
    pub fn search(&self, guesses: &[Beginning], runs: &mut Runs) -> Result<Minima, NoFit> {
        let mut best: Option<(StartKind, Optimum)> = None;
        let mut failure = NoFit::Lost;
        let mut starts = self.ranked(guesses, runs)?;
        for (round, way) in WAYS.into_iter().enumerate() {
            let mut costs = Vec::new();
            for &(start, guess, certain) in &starts {
                let observation = self.observation(start);
                let mut cost = f64::INFINITY;
                let mut explained = false;
                match interrupted(way(self, &self.task(&observation), guess, runs))? {
                    Ok(found) => {
                        cost = found.cost;
                        runs.closest = runs.closest.min(self.typical(cost));
                        explained = self.explains(&found);
                        if best.as_ref().is_none_or(|(_, best)| self.is_better(&found, start, best))
                        {
                            best = Some((start, found));
                        }
                    }
                    Err(other) => failure = other,
                }
                costs.push(cost);
                if explained && (certain || round > 0) {
                    break;
                }
            }
            let tired = runs.with_derivatives > ENOUGH;
            if best.as_ref().is_some_and(|(_, best)| tired || self.explains(best)) {
                break;
            }
            // The beginning that came closest is tried first in the next round.
            let mut ranked: Vec<_> = costs.into_iter().zip(starts).collect();
            ranked.sort_by(|one, other| one.0.total_cmp(&other.0));
            starts = ranked.into_iter().map(|(_, start)| start).collect();
        }
        let (start, mut optimum) = best.ok_or(failure)?;
        let observation = self.observation(start);
        let task = self.task(&observation);
        if start == StartKind::Release && !self.explains(&optimum) {
            optimum = self.released_elsewhere(&task, optimum, runs)?;
        }
        let mut optima = vec![optimum];
        if self.may_be_elsewhere(&task, &optima[0]) {
            let alike = guesses.iter().filter(|beginning| beginning.start == start);
            let guesses = alike.flat_map(|beginning| beginning.guesses.iter().copied());
            let guesses = guesses.chain([optima[0].p]).collect();
            optima.extend(self.by_fewer_terms(start, guesses, runs)?);
        }
        let valleys = self.valleys(&task, optima, runs)?;
        Ok(Minima { start, valleys })
    }

    /// The lowest minimum if the same motion was released some periods earlier or later.
    fn released_elsewhere(
        &self,
        task: &Task,
        mut best: Optimum,
        runs: &mut Runs,
    ) -> Result<Optimum, NoFit> {
        const ROUNDS: usize = 3;
        for _ in 0..ROUNDS {
            let from = best.clone();
            for periods in [-2, -1, 1, 2] {
                let Some(guess) = released_after(&from, periods) else { continue };
                if let Ok(found) = interrupted(task.solve(guess, runs))?
                    && found.cost < best.cost
                {
                    best = found;
                }
            }
            if best.cost == from.cost || self.explains(&best) {
                break;
            }
        }
        Ok(best)
    }

    /// The minima reached from those without D2 and D3, which have fewer valleys if noise leaves room for many.
    fn by_fewer_terms(
        &self,
        start: StartKind,
        guesses: Vec<Unknowns>,
        runs: &mut Runs,
    ) -> Result<Vec<Optimum>, NoFit> {
        /// Maximum number of minima from which to continue.
        const MOST: usize = 3;
        let mut fewer = *self;
        (fewer.free[D2], fewer.free[D3]) = (false, false);
        let guesses = guesses.into_iter().map(|guess| without(guess, &[D2, D3], self)).collect();
        let beginning = Beginning { start, certain: true, guesses };
        let (observation, all) = (fewer.observation(start), self.observation(start));
        let task = fewer.task(&observation);
        let mut minima = Vec::new();
        for (_, guess, _) in fewer.ranked(&[beginning], runs)? {
            if let Ok(found) = interrupted(task.solve(guess, runs))? {
                let mut optima = Vec::new();
                for guess in through_the_valley(&task, &found, WIDE, &[], runs)? {
                    optima.extend(interrupted(task.solve(guess, runs))?);
                }
                optima.push(found);
                minima = fewer.valleys(&task, optima, runs)?;
            }
        }
        let mut optima = Vec::new();
        for minimum in minima.into_iter().take(MOST) {
            optima.extend(interrupted(self.task(&all).solve(minimum.optimum.p, runs))?);
        }
        Ok(optima)
    }

    /// The root mean square of the residuals at a cost.
    fn typical(&self, cost: f64) -> f64 {
        let count = real(self.data.residuals().max(1));
        (cost / count).sqrt()
    }

    /// Fits every minimum again with the residuals that now count. Fails with [`NoFit`] when interrupted, or if
    /// the motion is lost.
    pub fn polish(&self, found: &mut Minima, runs: &mut Runs) -> Result<(), NoFit> {
        let observation = self.observation(found.start);
        let task = self.task(&observation);
        for valley in &mut found.valleys {
            let within = Task { within: Some(valley.optimum.seen.region), ..task };
            valley.optimum = within.solve(valley.optimum.p, runs)?;
            valley.half_swings = valley.optimum.seen.turns.len();
        }
        found.valleys.sort_by(by_cost);
        Ok(())
    }

    /// Whether a minimum is better than the best one so far. A release must be clearly better than a mass in
    /// motion, since otherwise the record shows no hold.
    fn is_better(&self, found: &Optimum, start: StartKind, best: &Optimum) -> bool {
        let unit = best.cost / real(self.data.residuals().max(1));
        let needed = if start == StartKind::Release { 4.0 * unit } else { -4.0 * unit };
        let needed = if self.data.has_peaks() { 0.0 } else { needed };
        found.cost < best.cost - needed
    }

    /// For each way of beginning, the guess that is closest to the record before any descent. Guesses without D2 and
    /// D3 are also tried, since with wrong values of these every motion may escape.
    pub fn ranked(
        &self,
        guesses: &[Beginning],
        runs: &mut Runs,
    ) -> Result<Vec<(StartKind, Unknowns, bool)>, NoFit> {
        let mut starts = Vec::new();
        for beginning in guesses {
            let observation = self.observation(beginning.start);
            let task = self.task(&observation);
            let mut best = (f64::INFINITY, None);
            let plain = beginning.guesses.iter().map(|guess| without(*guess, &[D2, D3], self));
            for guess in beginning.guesses.iter().copied().chain(plain) {
                if let Ok(seen) = interrupted(task.evaluated(&guess, false, runs))? {
                    let cost = task.cost(&seen);
                    if cost < best.0 {
                        best = (cost, Some(guess));
                    }
                }
            }
            starts.extend(best.1.map(|guess| (beginning.start, guess, beginning.certain)));
        }
        Ok(starts)
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
type Descent = fn(&LeastSquares, &Task, Unknowns, &mut Runs) -> Result<Optimum, NoFit>;

/// The ways of descent in the order in which they are tried.
const WAYS: [Descent; 4] = [
    |_, task, guess, runs| task.solve(guess, runs),
    growing,
    |problem, task, guess, runs| growing(problem, task, without(guess, &[D2, D3], problem), runs),
    |problem, task, guess, runs| growing(problem, task, without(guess, &[R], problem), runs),
];

fn without(mut guess: Unknowns, places: &[usize], problem: &LeastSquares) -> Unknowns {
    for &place in places {
        if problem.free[place] {
            guess[place] = 0.0;
        }
    }
    guess
}

/// Descends on a growing part of the record, with a robust loss that tolerates samples that are still far off.
fn growing(
    problem: &LeastSquares,
    task: &Task,
    guess: Unknowns,
    runs: &mut Runs,
) -> Result<Optimum, NoFit> {
    let mut p = guess;
    let Data::Samples { t, .. } = problem.data else { return task.solve(p, runs) };
    let (first, last) = (t[0], t[t.len() - 1]);
    let half_swing = std::f64::consts::PI / p[OMEGA0];
    let shortest = real(FEWEST) * half_swing;
    let begin = match task.observation.start {
        StartKind::Release => p[LAST].max(first),
        StartKind::Moving => first,
    };
    let loss = Loss::SoftL1 { scale: 3.0 * problem.noise.max(f64::MIN_POSITIVE) };
    for part in HORIZONS {
        let until = begin + (part * (last - begin)).max(shortest);
        let horizon = t.partition_point(|&t| t <= until);
        if horizon >= t.len() {
            break;
        }
        p = Task { loss, horizon, ..*task }.solve_roughly(p, runs)?.p;
    }
    let rough = Task { loss, ..*task }.solve_roughly(p, runs)?;
    task.solve(rough.p, runs)
}
