//! The computations at a point of a scan: of the paper's oscillator, or of a machine by its whole model.

use super::row::{Cells, Failed};
use super::settling::{largest_and_mean, rested, starts};
use super::table::CYCLES;
use super::{Measure, Value};
use crate::branch::{escape_point, fold};
use crate::flow::{Detail, Problem, Reason, Result, Subject};
use crate::model::{Body, Model, Parameters, State};
use crate::numerics::Interval;
use crate::portrait::guarantee::certain::guaranteed;
use crate::portrait::{Portrait, cycles, friction_for, proved, repeated};

impl Cells<'_> {
    /// Computes a measure, and fills its cells and those of all that are computed with it. Fails with why it gave up.
    pub fn compute(&mut self, measure: Measure) -> Result<(), Failed> {
        let (limits, conditions) = (self.limits, self.conditions);
        let Subject { source, tolerances, .. } = self.subject;
        let paper = self.subject.paper().map(|problem| problem.parameters);
        match (measure, paper) {
            (Measure::Outcome | Measure::Settling, _) => self.motions(measure)?,
            (Measure::Cycles, Some(parameters)) => self.cycles_of(&parameters)?,
            (Measure::Margin, Some(parameters)) => self.basin_of(&parameters)?,
            (Measure::Proved, Some(parameters)) => self.proof_of(&parameters)?,
            (Measure::Fold, Some(parameters)) => {
                let found = self.cost.spend(fold(&parameters, limits)?);
                self.fill(Measure::Fold, || found.into_iter().flat_map(|it| [it.d, it.q_max]));
            }
            (Measure::Escape, Some(parameters)) => {
                let found = self.cost.spend(escape_point(&parameters, limits)?);
                self.fill(Measure::Escape, || found);
            }
            // The numbers of a mode have no tolerances.
            (Measure::Guaranteed, _) if matches!(source.body, Body::Mode(_)) => {}
            (Measure::Guaranteed, paper) => {
                let found = guaranteed(source, tolerances, 0.0, limits)?;
                let (basin, margin) = found.map_err(|why| why.to_string())?;
                if paper.is_some() {
                    self.cost += basin.cost;
                }
                self.margin(Measure::Guaranteed, basin.border, margin);
            }
            (Measure::Design, _) => {
                let Some((kick, wanted)) = conditions.wanted else { return Ok(()) };
                let found = friction_for(source, tolerances, kick, wanted, limits)?;
                let needed = self.cost.spend(found).ok_or("no friction was found to suffice")?;
                self.fill(Measure::Design, || [needed.least().unwrap_or(0.0)]);
            }
            (Measure::Repeated, paper) => {
                // Without friction there is no set of places to rest.
                if let Some(parameters) = paper.filter(|it| it.r > 0.0) {
                    let reach = conditions.kicks.reach() + parameters.r;
                    self.portrait = Some(Portrait::of_oscillator(&parameters, reach, limits)?);
                }
                let held = |found: &&Portrait| found.model.guide_static > 0.0;
                let Some(portrait) = self.portrait.as_ref().filter(held) else { return Ok(()) };
                let found = repeated(portrait, &conditions.kicks, limits)?;
                if paper.is_some() {
                    self.cost += found.cost;
                }
                self.fill(Measure::Repeated, || [found.mean, found.later, found.error]);
            }
            (_, None) => self.portray()?,
            _ => debug_assert!(false, "it is computed with another"),
        }
        Ok(())
    }

    /// The motion of the point, or those from a window of starts. Fails with why one was given up.
    fn motions(&mut self, measure: Measure) -> Result<()> {
        let (limits, conditions) = (self.limits, self.conditions);
        let (problem, model) = self.subject.problem()?;
        let follow = |initial: State| {
            let problem = Problem { initial, ..problem };
            problem.followed(model.as_ref(), Detail::default(), limits)
        };
        if measure == Measure::Outcome {
            return self.motion(&follow(problem.initial));
        }
        let window = model.as_ref().map_or(conditions.window, |model| conditions.about(model));
        let mut times = Vec::new();
        for start in starts(window) {
            let motion = follow(start);
            self.cost += motion.cost;
            times.push(motion.outcome.rest()?);
        }
        self.fill(Measure::Settling, || largest_and_mean(&times).into_iter().flatten());
        self.fill(Measure::FiniteTime, || rested(&times));
        Ok(())
    }

    fn cycles_of(&mut self, parameters: &Parameters) -> Result<()> {
        let found = cycles(parameters, self.limits)?;
        self.cost += found.cost;
        self.cycles(&found.cycles);
        self.known = Some(found);
        Ok(())
    }

    fn basin_of(&mut self, parameters: &Parameters) -> Result<()> {
        let conditions = self.conditions;
        // The edge has to be followed as far as the window or the kicks reach only if these matter.
        let reach = |measure, reach| if self.asks(measure) { reach } else { 0.0 };
        let reach = reach(Measure::Stability, conditions.window.reach())
            .max(reach(Measure::Lost, conditions.kicks.reach()));
        // What is beyond the edge does not matter here.
        let portrait = if let Some(found) = &self.known {
            let model = Model::of_paper(parameters)?;
            let inner = found.closings.first().copied();
            Portrait::around(&model, parameters, inner.as_slice(), reach, self.limits)?
        } else {
            Portrait::innermost(parameters, reach, self.limits)?
        };
        self.cost += portrait.cost;
        self.around_rest(&portrait);
        Ok(())
    }

    fn proof_of(&mut self, parameters: &Parameters) -> Result<()> {
        if self.known.is_none() {
            self.cycles_of(parameters)?;
        }
        let Some(found) = &self.known else { return Ok(()) };
        let differ = |_| Reason::NotApplicable { needs: "a search that agrees with its proof" };
        let proof = proved(found).map_err(differ)?;
        let word = Value::Word(if proof.is_complete() { "yes" } else { "no" });
        let bounds = proof.cycles.iter().take(CYCLES).flat_map(|cycle| {
            let q_max = cycle.enclosure.map(|it| it.q_max);
            [q_max.map(Interval::lower), q_max.map(Interval::upper)].map(Value::from)
        });
        self.fill(Measure::Proved, || std::iter::once(word).chain(bounds));
        Ok(())
    }

    /// The cycles and the basin of a machine: one computation, on which repeated kicks rest, too.
    fn portray(&mut self) -> Result<()> {
        let portrait = self.subject.source.portrait()?;
        self.cost.steps += portrait.cost.steps;
        self.cycles(&portrait.cycles);
        self.around_rest(&portrait);
        let incomplete = portrait.incomplete();
        self.portrait = Some(portrait);
        incomplete.map_or(Ok(()), Err)
    }
}
