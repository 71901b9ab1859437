//! The scenes of what is opened from a file of the user: a machine, or a recorded motion.

use super::file::parse;
use super::machine::ScaledMachine;
use super::misread::built_in;
use super::scene::Scene;
use super::views::Layer;
use crate::fit::{Signal, length_in_metres};
use crate::flow::Problem;
use crate::question::Recording;

/// A scene of a file of the program, to be completed.
fn template(text: &str) -> Scene {
    built_in(&[("template", text)], parse).remove(0)
}

impl ScaledMachine {
    /// A scene of the machine: the mass on its belt and the phase plane.
    pub fn scene(self) -> Scene {
        Scene {
            name: self.machine.name.clone(),
            title: self.machine.title.clone(),
            watch: self.machine.watch.clone(),
            terms: self.terms(),
            problem: self.problem(),
            machine: Some(Box::new(self)),
            ..template(include_str!("../../assets/templates/machine.toml"))
        }
    }
}

impl Recording {
    /// A scene of the record: decrements, time series, phase plane and the distribution of the margin, with the
    /// motion that the fit will find.
    pub fn scene(self) -> Scene {
        let mut scene = template(include_str!("../../assets/templates/record.toml"));
        let (shown, seen) = match self.record.signal {
            Signal::Displacement => (Layer::Position, "Dots are what was measured,"),
            Signal::Velocity => (Layer::Velocity, "Dots are the velocities measured,"),
            Signal::Acceleration => {
                (Layer::Position, "The accelerations measured are seen in the residuals only;")
            }
        };
        let unit = self.record.unit.as_deref();
        let reduced =
            format!("lengths are in {} and times in 1/omega0", unit.unwrap_or("the file's unit"));
        let units = match unit.and_then(length_in_metres) {
            Some(_) if !self.record.t.is_empty() => {
                format!("axes are in units of length and seconds; with units off {reduced}")
            }
            _ => reduced,
        };
        scene.layers.insert(shown);
        Scene {
            name: self.name.clone(),
            title: format!("{}, {}", self.name, scene.title),
            watch: format!("{seen} {}", scene.watch.replace("{units}", &units)),
            problem: Problem::default(),
            recording: Some(self),
            ..scene
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::machine::library::machines;

    #[test]
    fn a_machine_is_opened_with_its_own_words_and_numbers() {
        for machine in machines() {
            let scaled = ScaledMachine::new(machine.clone()).unwrap();
            let scene = scaled.clone().scene();
            assert_eq!((&scene.title, &scene.watch), (&machine.title, &machine.watch));
            assert_eq!((scene.problem, &scene.terms), (scaled.problem(), &scaled.terms()));
        }
    }
}
