//! The computations at a point of a scan of the paper's oscillator.

use super::row::{Cells, Failed};
use super::table::{CYCLES, Measure, Value};
use crate::branch::escape::escape_point;
use crate::branch::fold::fold;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Problem, Reason};
use crate::numerics::Interval;
use crate::portrait::basin::cycle::cycles_and_closings;
use crate::portrait::closing::all::{STEP, first_closings};
use crate::portrait::closing::equation::Equation;
use crate::portrait::closing::pair::Closing;
use crate::portrait::design::friction_for;
use crate::portrait::guarantee::oscillator::guaranteed;
use crate::portrait::kicks::repeated::repeated;
use crate::portrait::proved::proved;
use crate::portrait::{Cycles, Portrait};

/// A point, and its cycles once they are known.
pub(super) struct OscillatorPoint<'a> {
    problem: &'a Problem,
    limits: &'a Limits<'a>,
    cycles: Option<(Cycles, Vec<Closing>)>,
}

impl<'a> OscillatorPoint<'a> {
    pub fn new(problem: &'a Problem, limits: &'a Limits<'a>) -> Self {
        OscillatorPoint { problem, limits, cycles: None }
    }

    /// Computes a measure, and fills its cells and those of all that are computed with it. Fails with why it gave up.
    pub fn compute(&mut self, measure: Measure, cells: &mut Cells) -> Result<(), Failed> {
        let (parameters, limits) = (&self.problem.parameters, self.limits);
        match measure {
            Measure::Outcome => self.motion(cells)?,
            Measure::Cycles => self.cycles(cells)?,
            Measure::Margin => self.edge(cells)?,
            Measure::Fold => {
                let (found, cost) = fold(parameters, limits)?;
                cells.cost += cost;
                cells.fill(Measure::Fold, || found.into_iter().flat_map(|it| [it.d, it.q_max]));
            }
            Measure::Escape => {
                let (found, cost) = escape_point(parameters, limits)?;
                cells.cost += cost;
                cells.fill(Measure::Escape, || found);
            }
            Measure::Guaranteed => {
                let known = cells.conditions.around(parameters);
                let found = guaranteed(&known, cells.conditions.disturbance, 0.0, limits)?;
                let (worst, margin) = found.map_err(|why| why.to_string())?;
                cells.cost += worst.cost;
                cells.margin(Measure::Guaranteed, margin);
            }
            Measure::Settling => {
                let follow = |initial| {
                    trajectory(&Problem { initial, ..*self.problem }, Detail::default(), limits)
                };
                cells.settling(&cells.conditions.window, follow)?;
            }
            Measure::Proved => self.proof(cells)?,
            Measure::Design => {
                let Some((kick, wanted)) = cells.conditions.wanted else { return Ok(()) };
                let (needed, cost) = friction_for(parameters, kick, wanted, limits)?;
                cells.cost += cost;
                cells.fill(Measure::Design, || [needed.least()]);
            }
            // Without friction there is no set of places to rest.
            Measure::Repeated if parameters.r == 0.0 => {}
            Measure::Repeated => {
                let kicks = &cells.conditions.kicks;
                let reach = kicks.reach() + parameters.r;
                let portrait = Portrait::of_oscillator(parameters, reach, limits)?;
                let found = repeated(&portrait, kicks, limits)?;
                cells.cost += found.cost;
                cells.repeated(&found);
            }
            _ => debug_assert!(false, "it is computed with another"),
        }
        Ok(())
    }

    fn motion(&self, cells: &mut Cells) -> Result<(), Reason> {
        let motion = trajectory(self.problem, Detail::default(), self.limits);
        cells.cost += motion.cost;
        cells.motion(&motion)
    }

    fn cycles(&mut self, cells: &mut Cells) -> Result<(), Reason> {
        let found = cycles_and_closings(&self.problem.parameters, self.limits)?;
        cells.cost += found.0.cost;
        cells.cycles(&found.0.cycles);
        self.cycles = Some(found);
        Ok(())
    }

    fn edge(&self, cells: &mut Cells) -> Result<(), Reason> {
        let (parameters, conditions) = (&self.problem.parameters, cells.conditions);
        // What is beyond the edge does not matter here.
        let inner = if let Some((_, closings)) = &self.cycles {
            closings.first().copied()
        } else {
            let mut equation = Equation::new(parameters, STEP, self.limits);
            let inner = first_closings(&mut equation, 1);
            cells.cost += equation.cost();
            inner?.first().copied()
        };
        // It has to be followed as far as the window or the kicks reach only if these matter.
        let reach = |measure, reach| if cells.asks(measure) { reach } else { 0.0 };
        let reach = reach(Measure::Stability, conditions.reach())
            .max(reach(Measure::Lost, conditions.kicks.reach()));
        let portrait = Portrait::around(parameters, inner.as_slice(), reach, self.limits)?;
        cells.cost += portrait.cost;
        cells.around_rest(&portrait);
        Ok(())
    }

    fn proof(&mut self, cells: &mut Cells) -> Result<(), Reason> {
        if self.cycles.is_none() {
            self.cycles(cells)?;
        }
        let Some((found, _)) = &self.cycles else { return Ok(()) };
        let differ = |_| Reason::NotApplicable { needs: "a search that agrees with its proof" };
        let proof = proved(found).map_err(differ)?;
        let word = Value::Word(if proof.is_complete() { "yes" } else { "no" });
        let bounds = proof.cycles.iter().take(CYCLES).flat_map(|cycle| {
            let q_max = cycle.enclosure.map(|it| it.q_max);
            [q_max.map(Interval::lower), q_max.map(Interval::upper)].map(Value::from)
        });
        cells.fill(Measure::Proved, || std::iter::once(word).chain(bounds));
        Ok(())
    }
}
