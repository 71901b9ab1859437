//! The motions on show and the speed of the belt, which change together.

use crate::flow::Problem;
use crate::scene::{Rig, Scene};
use crate::session::state::starts::Starts;

/// What a change changes: the motions, and the speed of the belt that their units are those of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The present motion: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Where the motions beside it start.
    pub others: Starts,
    /// Speed of the belt, in m/s; `None` where the scene is of no machine.
    pub belt_speed: Option<f64>,
}

impl Stand {
    /// What a scene opens with.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        let speed = |rig: &Rig| rig.machine.belt.belt_speed;
        let belt_speed = scene.machine.as_deref().map(speed);
        Stand { belt_speed, ..Stand::alone(scene.problem) }
    }

    /// One motion of no machine.
    #[must_use]
    pub fn alone(problem: Problem) -> Self {
        Stand { problem, others: Starts::default(), belt_speed: None }
    }
}
