//! The motion on show and the speed of the belt, which change together.

use crate::flow::Problem;
use crate::scene::{Rig, Scene};

/// What a change changes: a motion, and the speed of the belt that its units are those of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Speed of the belt, in m/s; `None` where the scene is of no machine.
    pub belt_speed: Option<f64>,
}

impl Stand {
    /// What a scene opens with.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        let speed = |rig: &Rig| rig.machine.belt.belt_speed;
        Stand { problem: scene.problem, belt_speed: scene.machine.as_deref().map(speed) }
    }

    /// A motion of no machine.
    #[must_use]
    pub fn alone(problem: Problem) -> Self {
        Stand { problem, belt_speed: None }
    }
}
