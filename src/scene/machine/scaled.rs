//! A machine with its dimensionless form.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::description::Machine;
use super::running::Running;
use crate::flow::Problem;
use crate::model::belt::{BeltError, ReducedBelt};
use crate::model::{Knob, State};

/// A machine with its dimensionless form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Machine", into = "Machine")]
pub struct ScaledMachine {
    pub machine: Machine,
    pub reduced: ReducedBelt,
}

impl TryFrom<Machine> for ScaledMachine {
    type Error = BeltError;

    fn try_from(machine: Machine) -> Result<Self, BeltError> {
        ScaledMachine::new(machine)
    }
}

impl From<ScaledMachine> for Machine {
    fn from(scaled: ScaledMachine) -> Self {
        scaled.machine
    }
}

impl ScaledMachine {
    /// Computes the dimensionless form of a machine. Fails with [`BeltError`] where there is none.
    pub fn new(machine: Machine) -> Result<Self, BeltError> {
        let reduced = machine.reduce()?;
        Ok(ScaledMachine { machine, reduced })
    }

    /// The motion of the machine at its own belt speed.
    pub fn problem(&self) -> Problem {
        Problem {
            parameters: self.reduced.parameters,
            initial: self.running().start(),
            until: self.machine.until / self.reduced.units.time,
            ..Problem::default()
        }
    }

    /// The terms of the model that the machine needs: D and r always, D2 and D3 where they are not zero.
    pub fn terms(&self) -> BTreeSet<Knob> {
        let parameters = &self.reduced.parameters;
        let has = |symbol: &Knob| symbol.get(parameters, &State { q: 0.0, v: 0.0 }) != 0.0;
        let varied = [Knob::D2, Knob::D3].into_iter().filter(has);
        [Knob::D, Knob::R].into_iter().chain(varied).collect()
    }

    /// The machine with its belt at its own speed.
    pub fn running(&self) -> Running<'_> {
        let ScaledMachine { machine, reduced } = self;
        Running { machine, speed: machine.belt.belt_speed, reduced: *reduced }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::machine::library::machines;

    #[test]
    fn a_machine_written_down_comes_back_as_it_was() {
        for machine in machines() {
            let scaled = ScaledMachine::new(machine.clone()).unwrap();
            let text = serde_json::to_string(&scaled).unwrap();
            assert_eq!(
                serde_json::from_str::<ScaledMachine>(&text).unwrap(),
                scaled,
                "{}",
                machine.name
            );
            let broken = text.replacen("\"mass\":", "\"mass\":-", 1);
            assert!(serde_json::from_str::<ScaledMachine>(&broken).is_err());
        }
    }
}
