//! The computations at a point of a scan of a machine, by the whole model.

use std::collections::BTreeSet;

use super::row::{Cells, Failed};
use super::settling::Settling;
use super::table::Measure;
use crate::flow::machine::motion::turns;
use crate::flow::{Fate, MachineMotion, Reason};
use crate::model::{MachineProblem, State};
use crate::portrait::Portrait;
use crate::portrait::basin::StartWindow;
use crate::portrait::design::friction_of_guide;
use crate::portrait::guarantee::machine::guaranteed;
use crate::portrait::kicks::repeated::{part_lost, repeated_by};

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
                let motion = MachineMotion::new(&subject.model()?, start.0, start.1, *until);
                let (end, swings) = (motion.end, turns(&motion.legs).count());
                let known = !matches!(motion.outcome, Fate::Unknown(_));
                cells.outcome(motion.outcome.word(), known.then_some((end.t, swings)));
                match motion.outcome {
                    Fate::Rest => cells.fill(Measure::Rest, || [end.x, end.t]),
                    Fate::Unknown(stop) => return Err(stop.into()),
                    _ => {}
                }
            }
            Measure::Guaranteed => {
                let Some(belt) = subject.of_belt() else { return Ok(()) };
                let margin = guaranteed(belt, tolerances)?.map_err(|why| why.to_string())?;
                cells.margin(Measure::Guaranteed, margin);
            }
            Measure::Design => {
                let Some((kick, wanted)) = cells.conditions.wanted else { return Ok(()) };
                let needed = friction_of_guide(subject, tolerances, kick, wanted)?;
                let needed = needed.ok_or("no friction was found to suffice")?;
                cells.fill(Measure::Design, || [needed.least()]);
            }
            Measure::Settling => self.settling(cells)?,
            Measure::Repeated => {
                let Some(portrait) = &self.portrait else { return Ok(()) };
                // Without friction there is no set of places to rest.
                if portrait.model.guide_static > 0.0 {
                    cells.repeated(&repeated_by(portrait, &cells.conditions.kicks)?);
                }
            }
            _ => self.portray(cells)?,
        }
        Ok(())
    }

    fn settling(&self, cells: &mut Cells) -> Result<(), Reason> {
        let model = self.problem.subject.model()?;
        let cost = &mut cells.cost;
        let found = Settling::of(&cells.conditions.about(&model), |State { q, v }| {
            let motion = MachineMotion::new(&model, q, v, self.problem.until);
            *cost += motion.cost;
            match motion.outcome {
                Fate::Rest => Ok(Some(motion.end.t)),
                Fate::Unknown(stop) => Err(stop),
                _ => Ok(None),
            }
        });
        cells.settling(&found?);
        Ok(())
    }

    fn portray(&mut self, cells: &mut Cells) -> Result<(), Reason> {
        let portrait = self.problem.subject.portrait()?;
        let conditions = cells.conditions;
        cells.cost.steps += portrait.steps;
        cells.cycles(&portrait.cycles);
        cells.edge(portrait.border, portrait.margin);
        cells.fill(Measure::Stability, || {
            let StartWindow { q, v } = conditions.about(&portrait.model);
            portrait.rest_share(q, v)
        });
        cells.share(Measure::Lost, || part_lost(&portrait, &conditions.kicks).ok());
        cells.fill(Measure::Area, || portrait.area());
        cells.fill(Measure::Integrity, || [portrait.inner_radius(), portrait.integrity()]);
        let incomplete = portrait.incomplete();
        self.portrait = Some(portrait);
        incomplete.map_or(Ok(()), Err)
    }
}
