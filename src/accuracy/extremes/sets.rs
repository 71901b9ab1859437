//! The limit cycles at the parameters of the lattice, and how well they close.

use serde::Serialize;

use super::all_parameters;
use crate::flow::{Cost, Limits, Result};
use crate::model::Parameters;
use crate::portrait::{Cycle, Equation, Route, STEP, SwingPair, all_closings};

/// Maximum number of evaluations of one half map in a search.
pub const BUDGET: u64 = 3_000_000;

/// Every how many sets the thin lattice takes one: no factor in common with the number of values of any
/// parameter.
pub const THIN: usize = 7;

/// Tolerance of the steps by which a cycle is followed again.
const AGAIN: f64 = 1e-13;

/// A limit cycle of the lattice.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LatticeCycle {
    #[serde(flatten)]
    pub cycle: Cycle,
    /// By what fraction of the clearance a turn fails to close, followed again by steps of another length, along
    /// the way in which it contracts.
    pub residual: f64,
}

/// The parameters of a place of the lattice and what the search for cycles answered there.
#[derive(Clone, Debug)]
pub struct SetVerdict {
    pub parameters: Parameters,
    /// All cycles, by amplitude, or why the search gave up.
    pub answer: Result<Vec<LatticeCycle>>,
    pub cost: Cost,
}

impl SetVerdict {
    /// The cycles; none where it gave up.
    pub fn cycles(&self) -> &[LatticeCycle] {
        self.answer.as_deref().unwrap_or_default()
    }
}

/// The parameters of the lattice, every set or, if `thin`, each [`THIN`]th.
pub fn sets(thin: bool) -> impl Iterator<Item = Parameters> {
    all_parameters().step_by(if thin { THIN } else { 1 })
}

/// Searches for all cycles at these parameters within [`BUDGET`].
pub fn judge_set(parameters: &Parameters, limits: &Limits) -> SetVerdict {
    let limits = limits.up_to(BUDGET);
    let mut equation = Equation::new(parameters, STEP, &limits);
    let closings = all_closings(&mut equation);
    let side = equation.side;
    let cycle = |closing: &SwingPair| LatticeCycle {
        cycle: closing.describe(parameters, side),
        residual: residual(closing, parameters, &limits),
    };
    let answer = closings.map(|found| found.iter().map(cycle).collect());
    SetVerdict { parameters: *parameters, answer, cost: equation.cost() }
}

/// By how much a turn fails to close; infinite where it cannot be followed.
fn residual(closing: &SwingPair, parameters: &Parameters, limits: &Limits) -> f64 {
    let mut equation = Equation::new(parameters, AGAIN, limits);
    let route = Route::contracting(closing.log_multiplier(parameters));
    let again = equation.at(route, closing.node.at);
    again.map_or(f64::INFINITY, |again| again.node.value.abs())
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::accuracy::extremes::lattice::{Case, STARTS, cases};

    /// Number of different pairs of values of two different coordinates of these points.
    fn pairs<const N: usize>(points: impl Iterator<Item = [u64; N]>) -> usize {
        let mut pairs = HashSet::new();
        for point in points {
            for first in 0..N {
                for second in first + 1..N {
                    pairs.insert((first, second, point[first], point[second]));
                }
            }
        }
        pairs.len()
    }

    #[test]
    fn the_thin_lattices_still_pair_every_value_with_every_other() {
        let numbers = |Parameters { d, d2, d3, r }: Parameters| [d, r, d2, d3].map(f64::to_bits);
        let motion = |case: Case| {
            let [d, r, d2, d3] = numbers(case.parameters);
            let start = STARTS.iter().position(|start| start.0 == case.start);
            [d, r, d2, d3, start.unwrap() as u64]
        };
        assert_eq!((cases(false).count(), sets(false).count()), (21_000, 1_500));
        assert_eq!(pairs(cases(true).map(motion)), pairs(cases(false).map(motion)));
        assert_eq!(pairs(sets(true).map(numbers)), pairs(sets(false).map(numbers)));
    }
}
