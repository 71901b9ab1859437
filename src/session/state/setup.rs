//! The motions on show, the numbers of the machine and what is not known exactly, which change together.

use crate::flow::Problem;
use crate::scene::{ScaledMachine, Scene, Setting};
use crate::session::state::doubt::Doubt;
use crate::session::state::starts::Starts;

/// What a change changes: the motions, the machine that their units are those of, and what is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The present motion: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Where the motions beside it start.
    pub others: Starts,
    /// What the machine is set to; `None` where the scene is of none.
    pub setting: Option<Setting>,
    /// Half widths of the parameters, and the disturbance.
    pub doubt: Doubt,
}

impl Setup {
    /// What a scene opens with.
    pub fn of_scene(scene: &Scene) -> Self {
        let scaled = scene.machine.as_deref();
        let setting = |scaled: &ScaledMachine| Setting::of_speed(scaled.machine.belt.belt_speed);
        let doubt =
            scaled.map_or_else(Doubt::default, |scaled| Doubt::of_machine(&scaled.running()));
        Setup { setting: scaled.map(setting), doubt, ..Setup::alone(scene.problem) }
    }

    /// One motion of no machine, known exactly.
    pub fn alone(problem: Problem) -> Self {
        Setup { problem, others: Starts::default(), setting: None, doubt: Doubt::default() }
    }
}
