//! A machine set up to be looked at: with its dimensionless form, and as a scene.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{Machine, Running};
use crate::flow::Problem;
use crate::oscillator::belt::{BeltError, Reduced};
use crate::oscillator::{State, Symbol};
use crate::scene::scene::TOLERANCE;
use crate::scene::{Arrangement, Axes, Exhibit, Layer, Scene, View};

/// A machine with its dimensionless form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Machine", into = "Machine")]
pub struct Rig {
    /// The machine.
    pub machine: Machine,
    /// Its dimensionless form.
    pub reduced: Reduced,
}

impl TryFrom<Machine> for Rig {
    type Error = BeltError;

    fn try_from(machine: Machine) -> Result<Self, BeltError> {
        Rig::new(machine)
    }
}

impl From<Rig> for Machine {
    fn from(rig: Rig) -> Self {
        rig.machine
    }
}

impl Rig {
    /// Reduces a machine.
    ///
    /// # Errors
    /// [`BeltError`] where it has no dimensionless form.
    pub fn new(machine: Machine) -> Result<Self, BeltError> {
        let reduced = machine.reduce()?;
        Ok(Rig { machine, reduced })
    }

    /// The motion of the machine.
    #[must_use]
    pub fn problem(&self) -> Problem {
        Problem {
            parameters: self.reduced.parameters,
            initial: self.running().start(),
            until: self.machine.until / self.reduced.units.time,
            tolerance: TOLERANCE,
            ..Problem::default()
        }
    }

    /// The terms of the model that it has.
    #[must_use]
    pub fn terms(&self) -> BTreeSet<Symbol> {
        let parameters = &self.reduced.parameters;
        let has = |symbol: &Symbol| symbol.get(parameters, &State { q: 0.0, v: 0.0 }) != 0.0;
        let varied = [Symbol::D2, Symbol::D3].into_iter().filter(has);
        [Symbol::D, Symbol::R].into_iter().chain(varied).collect()
    }

    /// The machine at its own speed of the belt.
    #[must_use]
    pub fn running(&self) -> Running<'_> {
        let Rig { machine, reduced } = self;
        Running { machine, speed: machine.belt.belt_speed, reduced: *reduced }
    }

    /// A scene of the machine: the mass on its belt beside the phase plane, and the cycles over D below.
    #[must_use]
    pub fn scene(self) -> Scene {
        let layers = [
            Layer::Mass,
            Layer::Belt,
            Layer::Trajectory,
            Layer::Sticking,
            Layer::Cycles,
            Layer::Basin,
            Layer::Branch,
            Layer::Special,
        ];
        let exhibit = |view| Exhibit { view, axes: Axes::default(), window: None, family: None };
        Scene {
            name: self.machine.name.clone(),
            title: self.machine.title.clone(),
            look: self.machine.look.clone(),
            press: "{play-motion} plays the motion and holds it, {motion-pace} changes the pace; {step-up} on D adds damping, on r friction."
                .to_owned(),
            terms: self.terms(),
            problem: self.problem(),
            steps: BTreeMap::new(),
            layers: layers.into_iter().collect(),
            plots: [View::Phase, View::Belt].map(exhibit).to_vec(),
            families: Vec::new(),
            arrangement: Arrangement::Rows,
            machine: Some(Box::new(self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::machine::library::machines;

    #[test]
    fn a_machine_written_down_comes_back_as_it_was() {
        for machine in machines() {
            let rig = Rig::new(machine.clone()).unwrap();
            let text = serde_json::to_string(&rig).unwrap();
            assert_eq!(serde_json::from_str::<Rig>(&text).unwrap(), rig, "{}", machine.name);
            let broken = text.replacen("\"mass\":", "\"mass\":-", 1);
            assert!(serde_json::from_str::<Rig>(&broken).is_err());
        }
    }
}
