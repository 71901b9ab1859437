//! The motions on show, the numbers of the machine and what is not known exactly: they change together.

use crate::flow::Problem;
use crate::model::Knob;
use crate::scene::{ScaledMachine, Scene, Setting};
use crate::session::state::starts::Starts;
use crate::session::state::uncertainty::Uncertainty;

/// Everything that a change of a number can affect: the motions, the machine that determines their units, and
/// what is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The present motion: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Starts of the other motions.
    pub others: Starts,
    /// The setting of the machine; `None` if the scene has no machine.
    pub setting: Option<Setting>,
    /// Half widths of the parameters, held numbers, and the disturbance.
    pub doubt: Uncertainty,
}

impl Setup {
    /// The setup with which a scene opens.
    pub fn of_scene(scene: &Scene) -> Self {
        let scaled = scene.machine.as_deref();
        let setting = |scaled: &ScaledMachine| Setting::of_speed(scaled.machine.belt.belt_speed);
        let doubt = scaled
            .map_or_else(Uncertainty::default, |scaled| Uncertainty::of_machine(&scaled.running()));
        Setup { setting: scaled.map(setting), doubt, ..Setup::alone(scene.problem) }
    }

    /// A number; `None` for one of a machine that is as in its file.
    pub fn get(&self, knob: Knob) -> Option<f64> {
        match knob {
            Knob::Disturbance => Some(self.doubt.disturbance),
            _ if knob.is_of_machine() => self.setting?.get(knob),
            _ => Some(self.problem.get(knob)),
        }
    }

    /// A single motion without a machine, known exactly.
    pub fn alone(problem: Problem) -> Self {
        Setup { problem, others: Starts::default(), setting: None, doubt: Uncertainty::default() }
    }
}
