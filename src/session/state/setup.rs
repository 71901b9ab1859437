//! The motions on show, the speed of the belt and what is not known exactly, which change together.

use crate::flow::Problem;
use crate::scene::{ScaledMachine, Scene};
use crate::session::state::doubt::Doubt;
use crate::session::state::starts::Starts;

/// What a change changes: the motions, the speed of the belt that their units are those of, and what is not known
/// exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The present motion: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Where the motions beside it start.
    pub others: Starts,
    /// Speed of the belt, in m/s; `None` where the scene is of no machine.
    pub belt_speed: Option<f64>,
    /// Half widths of the parameters, and the disturbance.
    pub doubt: Doubt,
}

impl Setup {
    /// What a scene opens with.
    pub fn of_scene(scene: &Scene) -> Self {
        let scaled = scene.machine.as_deref();
        let speed = |scaled: &ScaledMachine| scaled.machine.belt.belt_speed;
        let doubt =
            scaled.map_or_else(Doubt::default, |scaled| Doubt::of_machine(&scaled.running()));
        Setup { belt_speed: scaled.map(speed), doubt, ..Setup::alone(scene.problem) }
    }

    /// One motion of no machine, known exactly.
    pub fn alone(problem: Problem) -> Self {
        Setup { problem, others: Starts::default(), belt_speed: None, doubt: Doubt::default() }
    }
}
