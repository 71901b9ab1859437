//! One point of a scan of a machine: each computation that its measures need, once, by the whole model.

use std::collections::BTreeSet;

use super::point::{Portrayed, Settling, chain, part};
use super::table::{Conditions, Measure, MeasureNeed, Value, needs_of};
use crate::flow::machine::motion::turns;
use crate::flow::{Cost, Fate, Limits, MachineMotion, Reason};
use crate::model::{MachineProblem, State};
use crate::portrait::basin::Window;
use crate::portrait::design::{FrictionNeeded, friction_of_guide};
use crate::portrait::guarantee::machine::guaranteed;
use crate::portrait::kicks::repeated::{Repeated, part_lost, repeated_by};
use crate::portrait::{Margin, Portrait};

/// What was computed at a point of a machine; `None` for what no measure needed.
#[derive(Clone, Debug, Default)]
pub struct MachinePoint {
    motion: Option<MachineMotion>,
    portrait: Option<Portrait>,
    guaranteed: Option<Margin>,
    needed: Option<FrictionNeeded>,
    repeated: Option<Repeated>,
    settling: Option<Settling>,
    pub cost: Cost,
    /// Why cells are empty, a sentence for each computation.
    pub reasons: Vec<String>,
}

impl MachinePoint {
    /// Computes what these measures need. Fails with [`Reason::Interrupted`], and no other.
    pub fn of(
        problem: &MachineProblem,
        measures: &[Measure],
        conditions: &Conditions,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let mut point = MachinePoint::default();
        // Cycles and edge are one computation.
        let one = |need| if need == MeasureNeed::Edge { MeasureNeed::Cycles } else { need };
        let mut needs: BTreeSet<_> = needs_of(measures).into_iter().map(one).collect();
        if needs.contains(&MeasureNeed::Chain) {
            needs.insert(MeasureNeed::Cycles);
        }
        for need in needs {
            if (limits.interrupted)() {
                return Err(Reason::Interrupted);
            }
            if let Err(trouble) = point.compute(need, problem, conditions) {
                point.reasons.push(format!("{}: {trouble}", need.name()));
            }
        }
        Ok(point)
    }

    fn compute(
        &mut self,
        need: MeasureNeed,
        MachineProblem { subject, tolerances, start, until }: &MachineProblem,
        conditions: &Conditions,
    ) -> Result<(), Reason> {
        match need {
            MeasureNeed::Motion => {
                let motion = MachineMotion::new(&subject.model()?, start.0, start.1, *until);
                let outcome = motion.outcome;
                self.motion = Some(motion);
                if let Fate::Unknown(stop) = outcome {
                    return Err(stop);
                }
            }
            MeasureNeed::Guarantee => {
                let Some(belt) = subject.of_belt() else { return Ok(()) };
                match guaranteed(belt, tolerances)? {
                    Ok(margin) => self.guaranteed = Some(margin),
                    Err(uncertain) => self.reasons.push(format!("guaranteed: {uncertain}")),
                }
            }
            MeasureNeed::Design => {
                let Some((kick, wanted)) = conditions.wanted else { return Ok(()) };
                self.needed = friction_of_guide(subject, tolerances, kick, wanted)?;
                if self.needed.is_none() {
                    self.reasons.push("design: no friction was found to suffice".to_owned());
                }
            }
            MeasureNeed::Settling => {
                let model = subject.model()?;
                let cost = &mut self.cost;
                let found = Settling::of(&conditions.about(&model), |State { q, v }| {
                    let motion = MachineMotion::new(&model, q, v, *until);
                    *cost += motion.cost;
                    match motion.outcome {
                        Fate::Rest => Ok(Some(motion.end.t)),
                        Fate::Unknown(stop) => Err(stop),
                        _ => Ok(None),
                    }
                });
                self.settling = Some(found?);
            }
            MeasureNeed::Chain => {
                let Some(portrait) = &self.portrait else { return Ok(()) };
                // Without friction there is no set of places to rest.
                if portrait.model.guide_static > 0.0 {
                    match repeated_by(portrait, &conditions.kicks) {
                        Ok(found) => self.repeated = Some(found),
                        Err(reason) => self.reasons.push(format!("{}: {reason}", need.name())),
                    }
                }
            }
            _ => {
                let portrait = subject.portrait()?;
                self.cost.steps += portrait.steps;
                let incomplete = portrait.incomplete();
                self.portrait = Some(portrait);
                if let Some(stop) = incomplete {
                    return Err(stop);
                }
            }
        }
        Ok(())
    }

    /// The cells of these measures, in their order.
    pub fn values(&self, measures: &[Measure], conditions: &Conditions) -> Vec<Value> {
        measures.iter().flat_map(|measure| self.columns(*measure, conditions)).collect()
    }

    fn columns(&self, measure: Measure, conditions: &Conditions) -> Vec<Value> {
        let portrait = self.portrait.as_ref();
        let portrayed = Portrayed {
            cycles: portrait.map(|portrait| &portrait.cycles[..]),
            margin: portrait.map(|portrait| portrait.margin),
            border: portrait.map(|portrait| portrait.border),
            guaranteed: self.guaranteed,
            needed: self.needed,
            settling: self.settling.as_ref(),
        };
        match measure {
            Measure::Outcome => self.outcome().to_vec(),
            Measure::Rest => match &self.motion {
                Some(MachineMotion { outcome: Fate::Rest, end, .. }) => {
                    vec![end.x.into(), end.t.into()]
                }
                _ => vec![Value::Nothing; 2],
            },
            Measure::Stability => {
                let share = portrait.and_then(|portrait| {
                    let Window { q, v } = conditions.about(&portrait.model);
                    portrait.rest_share(q, v)
                });
                vec![share.into(), Value::Nothing]
            }
            Measure::Lost => {
                let share = portrait.and_then(|it| part_lost(it, &conditions.kicks).ok());
                part(share)
            }
            Measure::Area => vec![portrait.and_then(Portrait::area).into()],
            Measure::Integrity => {
                let radius = portrait.and_then(Portrait::inner_radius);
                vec![radius.into(), portrait.and_then(Portrait::integrity).into()]
            }
            Measure::Repeated => chain(self.repeated.as_ref()),
            _ => portrayed.columns(measure),
        }
    }

    fn outcome(&self) -> [Value; 3] {
        let Some(motion) = &self.motion else { return [Value::Nothing; 3] };
        let word = Value::Word(motion.outcome.word());
        if matches!(motion.outcome, Fate::Unknown(_)) {
            return [word, Value::Nothing, Value::Nothing];
        }
        [word, motion.end.t.into(), Value::Count(turns(&motion.legs).count())]
    }
}
