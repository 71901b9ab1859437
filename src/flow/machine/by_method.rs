//! A motion by any of the methods that can follow a machine.

use super::arc::LostMotion;
use super::ledger::MachineLedger;
use super::motion::{Leg, MachineMotion, MachineState, turns};
use super::series::ORDER;
use super::stepped::{SteppedMethod, traced};
use crate::flow::{Cost, Fate, Method};
use crate::model::Model;

/// A motion by any of the methods that can follow a machine.
#[derive(Clone, Debug)]
pub struct MethodMotion {
    pub method: Method,
    /// The error of a step, relative to the state.
    pub tolerance: f64,
    /// Its legs in their order.
    pub legs: Vec<Leg>,
    /// Where it ends, or how far it was followed.
    pub end: MachineState,
    /// How it ends.
    pub outcome: Fate<LostMotion>,
    /// Where the energy comes from and goes; `None` by a method that does not count it.
    pub ledger: Option<MachineLedger>,
    pub cost: Cost,
}

impl MethodMotion {
    /// Follows a motion from displacement and velocity (m, m/s) for `until` seconds, by Taylor series where no other
    /// method is asked for.
    #[must_use]
    pub fn new(
        model: &Model,
        (way, tolerance): (Option<SteppedMethod>, f64),
        (x, v): (f64, f64),
        until: f64,
    ) -> Self {
        if let Some(way) = way {
            let found = traced(model, way, tolerance, (x, v), until);
            let end = found.samples.last().copied().unwrap_or(MachineState { t: 0.0, x, v });
            return MethodMotion {
                method: way.method(),
                tolerance,
                legs: found.legs,
                end,
                outcome: found.outcome,
                ledger: None,
                cost: Cost {
                    evaluations: found.evaluations,
                    steps: found.steps,
                    ..Cost::default()
                },
            };
        }
        let mut model = model.clone();
        model.tolerance = tolerance;
        let found = MachineMotion::new(&model, x, v, until);
        let steps = found.curve.pieces.len() as u64;
        MethodMotion {
            method: Method::Taylor,
            tolerance,
            legs: found.legs,
            end: found.end,
            outcome: found.outcome,
            ledger: Some(found.ledger),
            cost: Cost { evaluations: steps * ORDER as u64, steps, ..Cost::default() },
        }
    }

    /// Times and displacements of its standstills and of its end.
    pub fn places(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        turns(&self.legs).map(|leg| (leg.t, leg.x)).chain([(self.end.t, self.end.x)])
    }
}
