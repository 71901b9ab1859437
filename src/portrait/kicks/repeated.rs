//! Repeated kicks, each after the mass has come to rest: how many until the rest is lost.
//!
//! Where a kick from one place of rest ends is decided by the motion alone, so the places of rest are a Markov
//! chain on the sticking set that a kick can leave forever. Its leading left eigenvector is the density of the
//! places after many kicks, given that none was lost (quasi-stationary; Darroch and Seneta, J. Appl. Prob. 2
//! (1965) 88); the mean number of kicks until one is lost solves `n = 1 + K n`.
//!
//! The sticking set is cut into cells. Motions from a grid of starts say where kicks end; the part that is lost
//! comes from the exact basin ([`crate::portrait::kicks`]), and each row of the chain is scaled to leave just that.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::flow::{Cost, Fate, Flow, Limits, Reason, Result};
use crate::numerics::{real, truncated};
use crate::portrait::{Portrait, RandomKick, Share};

/// What becomes of repeated kicks.
#[derive(Clone, Debug)]
pub struct Survival {
    /// The fraction of the first kicks, from the middle of the sticking set, that is lost.
    pub first: Share,
    /// The fraction of the kicks that is lost after many that were not.
    pub later: f64,
    /// Mean number of kicks until one is lost, that one included, from the middle; infinite where none is.
    pub mean: f64,
    /// Relative error of both, from a chain of half the cells and a grid of half the starts.
    pub error: f64,
    /// Density of the places of rest after many kicks, in cells of equal width from -r to r.
    pub density: Vec<f64>,
    /// What it cost.
    pub cost: Cost,
}

/// Cells of the sticking set.
const CELLS: usize = 64;

/// Columns of starts for one spread of a kick; twice as many rows.
const FINENESS: f64 = 10.0;

/// Maximum number of columns of starts.
const COLUMNS: f64 = 600.0;

/// Kicks beyond this many spreads are too rare to matter for where kicks end.
const FAR: f64 = 5.0;

/// Follows kicks until one is lost.
///
/// # Errors
/// The [`Reason`] why a motion could not be followed, with [`Reason::NotApplicable`] where the basin is not known, or
/// without friction.
pub fn repeated(portrait: &Portrait, kicks: &RandomKick, limits: &Limits) -> Result<Survival> {
    // Kicks start from all that the guide holds.
    let portrait = &*portrait.followed_to(kicks.reach() + portrait.model.guide_static)?;
    let first = kicks.lost(portrait)?;
    if portrait.model.guide_static == 0.0 {
        return Err(WITHOUT);
    }
    let coarse = Chain::of(portrait, kicks, CELLS / 2, limits)?;
    let fine = Chain::of(portrait, kicks, CELLS, limits)?;
    let mut cost = portrait.cost;
    cost += coarse.cost;
    cost += fine.cost;
    let (shares, later) = fine.settled();
    let (_, before) = coarse.settled();
    let width = 2.0 * portrait.model.guide_static / real(CELLS);
    let density = shares.iter().map(|share| share / width).collect();
    let mean = fine.mean(later);
    let relative =
        |one: f64, other: f64| if one == other { 0.0 } else { (one / other - 1.0).abs() };
    let error = relative(before, later).max(relative(coarse.mean(before), mean));
    Ok(Survival { first, later, mean, error, density, cost })
}

/// Why there is no chain without friction.
const WITHOUT: Reason =
    Reason::NotApplicable { needs: "friction, without which nothing comes to rest" };

impl Survival {
    /// The middles of the cells, and the density there, `r` being the friction.
    pub fn places(&self, r: f64) -> impl Iterator<Item = (f64, f64)> {
        middles(r, self.density.len()).zip(self.density.iter().copied())
    }
}

/// The middles of so many cells of the sticking set.
fn middles(r: f64, cells: usize) -> impl Iterator<Item = f64> {
    let width = 2.0 * r / real(cells);
    (0..cells).map(move |cell| (real(cell) + 0.5) * width - r)
}

/// The chain on cells.
struct Chain {
    /// Row by row: the chances to come from one cell to another.
    steps: DMatrix<f64>,
    /// The chance to be lost from each cell.
    lost: DVector<f64>,
    cost: Cost,
}

impl Chain {
    fn of(portrait: &Portrait, kicks: &RandomKick, cells: usize, limits: &Limits) -> Result<Self> {
        /// Error of a place of rest that matters to no cell.
        const TOLERANCE: f64 = 1e-7;
        let mut model = portrait.model.clone();
        model.tolerance = TOLERANCE;
        let r = model.guide_static;
        let width = 2.0 * r / real(cells);
        let centres: Vec<f64> = middles(r, cells).collect();
        let fineness = FINENESS * real(cells) / real(CELLS);
        let (columns, rows) = (columns(kicks, &centres, fineness), rows(kicks, fineness));
        let mut cost = Cost::default();
        let mut steps = DMatrix::zeros(cells, cells);
        // Where the motion from a start comes to rest; `None` where it is lost, or where that takes too long.
        let rest = |q: f64, v: f64| {
            limits.go_on()?;
            let mut flow = Flow::new(&model);
            let comes = portrait.fate(q, v) == Ok(Fate::Rest);
            let place = comes.then(|| flow.rest_of(q, v / model.omega_0, limits).ok()).flatten();
            Ok((place, flow.cost()))
        };
        let of = |(q, _): &StartColumn| {
            let rests = rows.iter().map(|&(v, share)| Ok((rest(*q, v)?, share)));
            rests.collect::<Result<Vec<_>>>()
        };
        let found: Vec<_> = columns.par_iter().map(of).collect::<Result<_, _>>()?;
        for ((_, weights), rests) in columns.iter().zip(found) {
            for ((rest, more), share) in rests {
                cost += more;
                let Some(rest) = rest else { continue };
                // Shared between the two cells whose centres it lies between.
                let place = ((rest + r) / width - 0.5).clamp(0.0, real(cells - 1));
                let left = (truncated(place)).min(cells - 2);
                let part = place - real(left);
                for &(from, weight) in weights {
                    steps[(from, left)] += weight * share * (1.0 - part);
                    steps[(from, left + 1)] += weight * share * part;
                }
            }
        }
        let lost = |centre: &f64| {
            let from = RandomKick { q: (kicks.q.0 + centre, kicks.q.1), ..*kicks };
            Ok(from.lost(portrait)?.part)
        };
        let lost = centres.iter().map(lost).collect::<Result<Vec<_>>>()?;
        let lost = DVector::from_vec(lost);
        for (mut row, lost) in steps.row_iter_mut().zip(&lost) {
            let sum: f64 = row.sum();
            row *= if sum > 0.0 { (1.0 - lost) / sum } else { 0.0 };
        }
        Ok(Chain { steps, lost, cost })
    }

    /// The share of each cell after many kicks, and the part that is then lost.
    fn settled(&self) -> (DVector<f64>, f64) {
        /// Kicks until nothing changes any more.
        const KICKS: usize = 10_000;
        const STILL: f64 = 1e-14;
        let cells = self.lost.len();
        let mut shares = DVector::repeat(cells, 1.0 / real(cells));
        for _ in 0..KICKS {
            let next = self.steps.tr_mul(&shares);
            let sum = next.sum();
            if sum <= 0.0 {
                // Every kick is lost.
                break;
            }
            let next = next / sum;
            let change = (&next - &shares).amax();
            shares = next;
            if change < STILL {
                break;
            }
        }
        let later = shares.dot(&self.lost);
        (shares, later)
    }

    /// Mean number of kicks from the middle; `later` is the part that is lost in the long run.
    fn mean(&self, later: f64) -> f64 {
        /// Chances of loss below which the equations have no digits left, and all places are alike.
        const RARE: f64 = 1e-9;
        let cells = self.lost.len();
        if later < RARE {
            return 1.0 / later;
        }
        let system = DMatrix::identity(cells, cells) - &self.steps;
        let means = system.lu().solve(&DVector::repeat(cells, 1.0));
        let middle = |means: DVector<f64>| 0.5 * (means[cells / 2 - 1] + means[cells / 2]);
        means.map_or(f64::INFINITY, middle)
    }
}

/// The displacement of a column of starts, and with which weight kicks from each cell lead to it.
type StartColumn = (f64, Vec<(usize, f64)>);

fn columns(kicks: &RandomKick, centres: &[f64], fineness: f64) -> Vec<StartColumn> {
    let (mean, spread) = kicks.q;
    if spread == 0.0 {
        let places = centres.iter().enumerate();
        return places.map(|(cell, centre)| (centre + mean, vec![(cell, 1.0)])).collect();
    }
    let far = kicks.law.reach().min(FAR) * spread;
    let half = far + centres.last().copied().unwrap_or_default();
    let column = |q: f64| {
        let weight = |centre: &f64| kicks.law.density(q - mean - centre, spread);
        let weights = centres.iter().map(weight).enumerate();
        (q, weights.filter(|(_, weight)| *weight > 0.0).collect())
    };
    steps(mean, half, (spread / fineness).max(2.0 * half / COLUMNS)).map(column).collect()
}

/// Velocities of starts with their weights.
fn rows(kicks: &RandomKick, fineness: f64) -> Vec<(f64, f64)> {
    let (mean, spread) = kicks.v;
    if spread == 0.0 {
        return vec![(mean, 1.0)];
    }
    let far = kicks.law.reach().min(FAR) * spread;
    let weighted = |v: f64| (v, kicks.law.density(v - mean, spread));
    steps(mean, far, 0.5 * spread / fineness).map(weighted).collect()
}

/// Middles of steps of about this length, over `half` on either side of `mean`.
fn steps(mean: f64, half: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = truncated((2.0 * half / step).ceil().max(1.0));
    (0..count).map(move |index| mean - half + 2.0 * half * (real(index) + 0.5) / real(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Outcome, Problem};
    use crate::model::{Parameters, State};
    use crate::numerics::random::Random;
    use crate::portrait::kicks::Distribution;

    /// Where the motion from a start of the basin comes to rest.
    fn rest_of(parameters: Parameters, initial: State) -> f64 {
        let problem =
            Problem { parameters, initial, until: 1e4, tolerance: 1e-7, ..Problem::default() };
        let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
        let Outcome::Captured { q, .. } = motion.outcome else { panic!("it is in the basin") };
        q
    }

    fn found(parameters: &Parameters, kicks: &RandomKick) -> Result<Survival, Reason> {
        let reach = kicks.reach() + parameters.r;
        let portrait = Portrait::of_oscillator(parameters, reach, &Limits::PATIENT)?;
        repeated(&portrait, kicks, &Limits::PATIENT)
    }

    /// Kicks one after the other, each from where the last one came to rest: mean number until one is lost, and
    /// its standard error.
    fn drawn(parameters: &Parameters, kicks: &RandomKick, most: u32) -> (f64, f64) {
        let found = Portrait::of_oscillator(parameters, 5.0, &Limits::PATIENT).unwrap();
        let mut random = Random::new(7);
        let (mut kicked, mut runs, mut squares, mut sum) = (0, 0.0, 0.0, 0.0);
        while kicked < most {
            let (mut place, mut run) = (0.0, 0.0);
            loop {
                let (a, b) = (random.normal(), random.normal());
                let start =
                    State { q: place + kicks.q.0 + kicks.q.1 * a, v: kicks.v.0 + kicks.v.1 * b };
                kicked += 1;
                run += 1.0;
                if found.fate(start.q, start.v) != Ok(Fate::Rest) {
                    break;
                }
                place = rest_of(*parameters, start);
            }
            (runs, sum, squares) = (runs + 1.0, sum + run, squares + run * run);
        }
        let mean: f64 = sum / runs;
        (mean, ((squares / runs - mean * mean) / runs).sqrt())
    }

    const PARAMETERS: Parameters = Parameters { d: -0.3, d2: 0.2, d3: 0.5, r: 0.1 };
    const KICKS: RandomKick =
        RandomKick { law: Distribution::Normal, q: (0.0, 0.04), v: (0.02, 0.08) };

    fn agrees(parameters: &Parameters, kicks: &RandomKick, drawn_kicks: u32) {
        let found = found(parameters, kicks).unwrap();
        let (mean, deviation) = drawn(parameters, kicks, drawn_kicks);
        let error = 3.0 * deviation + found.error * found.mean;
        assert!(
            (mean - found.mean).abs() < error,
            "{mean} +- {deviation}, {} {}",
            found.mean,
            found.error
        );
        assert!(found.error < 0.02, "{}", found.error);
        let width = 2.0 * parameters.r / real(found.density.len());
        assert!((found.density.iter().sum::<f64>() * width - 1.0).abs() < 1e-9);
    }

    #[test]
    fn kicks_are_lost_after_as_many_as_a_monte_carlo_needs() {
        agrees(&PARAMETERS, &KICKS, 20_000);
    }

    #[test]
    #[ignore = "1e6 kicks: a minute"]
    fn kicks_are_lost_after_as_many_as_a_large_monte_carlo_needs() {
        agrees(&PARAMETERS, &KICKS, 1_000_000);
        let impulses = RandomKick { q: (0.0, 0.0), ..KICKS };
        agrees(
            &Parameters { d: -0.05, d2: 0.5, d3: 0.0, r: 0.2 },
            &RandomKick { v: (0.0, 0.6), ..impulses },
            1_000_000,
        );
    }

    #[test]
    fn where_nothing_is_lost_nothing_ever_is() {
        let damped = Parameters { d: 0.2, d2: 0.0, d3: 0.0, r: 0.1 };
        let kicks = RandomKick { q: (0.0, 0.0), ..KICKS };
        let nothing = found(&damped, &kicks).unwrap();
        assert_eq!((nothing.first.part, nothing.later, nothing.mean), (0.0, 0.0, f64::INFINITY));
        let without = Parameters { r: 0.0, ..damped };
        assert!(found(&without, &kicks).is_err());
    }
}
