//! The computations at a point of a scan of a machine, by the whole model.

use std::collections::BTreeSet;

use super::row::{Cells, Failed};
use super::table::Measure;
use crate::flow::{Limits, Reason, follow_by_series};
use crate::model::{MachineProblem, State};
use crate::portrait::Portrait;
use crate::portrait::design::friction_of_guide;
use crate::portrait::guarantee::machine::guaranteed;
use crate::portrait::kicks::repeated::repeated;

/// A point, and its portrait once that is known.
pub(super) struct MachinePoint<'a> {
    problem: &'a MachineProblem,
    portrait: Option<Portrait>,
}

impl<'a> MachinePoint<'a> {
    pub fn new(problem: &'a MachineProblem) -> Self {
        MachinePoint { problem, portrait: None }
    }

    /// What is computed in place of these: cycles and margin are one computation, on which repeated kicks rest.
    pub fn computed(mut wanted: BTreeSet<Measure>) -> BTreeSet<Measure> {
        if wanted.remove(&Measure::Margin) || wanted.contains(&Measure::Repeated) {
            wanted.insert(Measure::Cycles);
        }
        wanted
    }

    /// Computes a measure, and fills its cells and those of all that are computed with it. Fails with why it gave up.
    pub fn compute(&mut self, measure: Measure, cells: &mut Cells) -> Result<(), Failed> {
        let MachineProblem { subject, tolerances, start, until } = self.problem;
        match measure {
            Measure::Outcome => {
                cells.motion(&follow_by_series(&subject.model()?, *start, *until))?;
            }
            Measure::Guaranteed => {
                let Some(belt) = subject.of_belt() else { return Ok(()) };
                let found = guaranteed(belt, tolerances)?;
                let (_, margin) = found.map_err(|why| why.to_string())?;
                cells.margin(Measure::Guaranteed, margin);
            }
            Measure::Design => {
                let Some((kick, wanted)) = cells.conditions.wanted else { return Ok(()) };
                let needed = friction_of_guide(subject, tolerances, kick, wanted)?;
                let needed = needed.ok_or("no friction was found to suffice")?;
                cells.fill(Measure::Design, || [needed.least()]);
            }
            Measure::Settling => {
                let model = subject.model()?;
                let follow = |State { q, v }| follow_by_series(&model, (q, v), *until);
                cells.settling(&cells.conditions.about(&model), follow)?;
            }
            Measure::Repeated => {
                let Some(portrait) = &self.portrait else { return Ok(()) };
                // Without friction there is no set of places to rest.
                if portrait.model.guide_static > 0.0 {
                    let kicks = &cells.conditions.kicks;
                    cells.repeated(&repeated(portrait, kicks, &Limits::PATIENT)?);
                }
            }
            _ => self.portray(cells)?,
        }
        Ok(())
    }

    fn portray(&mut self, cells: &mut Cells) -> Result<(), Reason> {
        let portrait = self.problem.subject.portrait()?;
        cells.cost.steps += portrait.cost.steps;
        cells.cycles(&portrait.cycles);
        cells.around_rest(&portrait);
        let incomplete = portrait.incomplete();
        self.portrait = Some(portrait);
        incomplete.map_or(Ok(()), Err)
    }
}
