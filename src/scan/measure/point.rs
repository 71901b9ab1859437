//! The computations at a point of a scan: of the paper's oscillator, or of a machine by its whole model.

use super::row::{Cells, Failed};
use super::table::ScanSource::{self, Machine, Oscillator};
use super::table::{CYCLES, Measure, Value};
use crate::branch::escape::escape_point;
use crate::branch::fold::fold;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Problem, Reason, Trajectory, follow_by_series};
use crate::model::{MachineProblem, Parameters, State};
use crate::numerics::Interval;
use crate::portrait::guarantee::{machine, oscillator};
use crate::portrait::kicks::repeated::repeated;
use crate::portrait::proved::proved;
use crate::portrait::{
    Equation, Portrait, STEP, cycles_and_closings, first_closings, friction_for, friction_of_guide,
};

impl Cells<'_> {
    /// Computes a measure, and fills its cells and those of all that are computed with it. Fails with why it gave up.
    pub fn compute(&mut self, measure: Measure) -> Result<(), Failed> {
        let (limits, conditions) = (self.limits, self.conditions);
        match (measure, self.source) {
            (Measure::Outcome | Measure::Settling, source) => self.motions(measure, source)?,
            (Measure::Cycles, Oscillator(problem)) => self.cycles_of(&problem.parameters)?,
            (Measure::Margin, Oscillator(problem)) => self.basin_of(&problem.parameters)?,
            (Measure::Proved, Oscillator(problem)) => self.proof_of(&problem.parameters)?,
            (Measure::Fold, Oscillator(problem)) => {
                let found = self.cost.spend(fold(&problem.parameters, limits)?);
                self.fill(Measure::Fold, || found.into_iter().flat_map(|it| [it.d, it.q_max]));
            }
            (Measure::Escape, Oscillator(problem)) => {
                let found = self.cost.spend(escape_point(&problem.parameters, limits)?);
                self.fill(Measure::Escape, || found);
            }
            (Measure::Guaranteed, Oscillator(problem)) => {
                let (known, bound) =
                    (conditions.around(&problem.parameters), conditions.disturbance);
                let found = oscillator::guaranteed(&known, bound, 0.0, limits)?;
                let (basin, margin) = found.map_err(|why| why.to_string())?;
                self.cost += basin.cost;
                self.margin(Measure::Guaranteed, margin);
            }
            (Measure::Guaranteed, Machine(problem)) => {
                let Some(belt) = problem.subject.of_belt() else { return Ok(()) };
                let found = machine::guaranteed(belt, &problem.tolerances)?;
                let (_, margin) = found.map_err(|why| why.to_string())?;
                self.margin(Measure::Guaranteed, margin);
            }
            (Measure::Design, source) => {
                let Some((kick, wanted)) = conditions.wanted else { return Ok(()) };
                let needed = match source {
                    Oscillator(Problem { parameters, .. }) => {
                        self.cost.spend(friction_for(parameters, kick, wanted, limits)?)
                    }
                    Machine(problem) => {
                        let MachineProblem { subject, tolerances, .. } = &**problem;
                        friction_of_guide(subject, tolerances, kick, wanted)?
                            .ok_or("no friction was found to suffice")?
                    }
                };
                self.fill(Measure::Design, || [needed.least().unwrap_or(0.0)]);
            }
            // Without friction there is no set of places to rest.
            (Measure::Repeated, Oscillator(problem)) if problem.parameters.r == 0.0 => {}
            (Measure::Repeated, source) => {
                if let Oscillator(Problem { parameters, .. }) = source {
                    let reach = conditions.kicks.reach() + parameters.r;
                    self.portrait = Some(Portrait::of_oscillator(parameters, reach, limits)?);
                }
                let held = |found: &&Portrait| found.model.guide_static > 0.0;
                let Some(portrait) = self.portrait.as_ref().filter(held) else { return Ok(()) };
                let found = repeated(portrait, &conditions.kicks, limits)?;
                if let Oscillator(_) = source {
                    self.cost += found.cost;
                }
                self.fill(Measure::Repeated, || [found.mean, found.later, found.error]);
            }
            (_, Machine(problem)) => self.portray(problem)?,
            _ => debug_assert!(false, "it is computed with another"),
        }
        Ok(())
    }

    /// The motion of the point, or those from a window of starts. Fails with why one was given up.
    fn motions(&mut self, measure: Measure, source: &ScanSource) -> Result<(), Reason> {
        let limits = self.limits;
        let (follow, window): (Box<dyn Fn(Option<State>) -> Trajectory>, _) = match source {
            Oscillator(problem) => {
                let follow = |start: Option<State>| {
                    let initial = start.unwrap_or(problem.initial);
                    trajectory(&Problem { initial, ..*problem }, Detail::default(), limits)
                };
                (Box::new(follow), self.conditions.window)
            }
            Machine(problem) => {
                let MachineProblem { subject, start: usual, until, .. } = &**problem;
                let model = subject.model()?;
                let window = self.conditions.about(&model);
                let follow = move |start: Option<State>| {
                    follow_by_series(&model, start.map_or(*usual, |it| (it.q, it.v)), *until)
                };
                (Box::new(follow), window)
            }
        };
        if measure == Measure::Outcome {
            self.motion(&follow(None))
        } else {
            self.settling(&window, |start| follow(Some(start)))
        }
    }

    fn cycles_of(&mut self, parameters: &Parameters) -> Result<(), Reason> {
        let found = cycles_and_closings(parameters, self.limits)?;
        self.cost += found.0.cost;
        self.cycles(&found.0.cycles);
        self.known = Some(found);
        Ok(())
    }

    fn basin_of(&mut self, parameters: &Parameters) -> Result<(), Reason> {
        let conditions = self.conditions;
        // What is beyond the edge does not matter here.
        let inner = if let Some((_, closings)) = &self.known {
            closings.first().copied()
        } else {
            let mut equation = Equation::new(parameters, STEP, self.limits);
            let inner = first_closings(&mut equation, 1);
            self.cost += equation.cost();
            inner?.first().copied()
        };
        // It has to be followed as far as the window or the kicks reach only if these matter.
        let reach = |measure, reach| if self.asks(measure) { reach } else { 0.0 };
        let reach = reach(Measure::Stability, conditions.reach())
            .max(reach(Measure::Lost, conditions.kicks.reach()));
        let portrait = Portrait::around(parameters, inner.as_slice(), reach, self.limits)?;
        self.cost += portrait.cost;
        self.around_rest(&portrait);
        Ok(())
    }

    fn proof_of(&mut self, parameters: &Parameters) -> Result<(), Reason> {
        if self.known.is_none() {
            self.cycles_of(parameters)?;
        }
        let Some((found, _)) = &self.known else { return Ok(()) };
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
    fn portray(&mut self, problem: &MachineProblem) -> Result<(), Reason> {
        let portrait = problem.subject.portrait()?;
        self.cost.steps += portrait.cost.steps;
        self.cycles(&portrait.cycles);
        self.around_rest(&portrait);
        let incomplete = portrait.incomplete();
        self.portrait = Some(portrait);
        incomplete.map_or(Ok(()), Err)
    }
}
