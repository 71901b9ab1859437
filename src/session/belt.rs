//! The belt of the machine on show: its speed, and whether the numbers on show are those of the machine.
//!
//! A speed of the belt stands for all of D, D2, D3 and r. Whoever changes one of these by hand leaves the
//! belt: the numbers are then those of no belt speed, until the speed is given again.

use super::state::Session;
use crate::flow::Problem;
use crate::scene::{Rig, Running, Scene};

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

impl Session {
    /// The motion on show and the speed of the belt.
    #[must_use]
    pub fn stand(&self) -> Stand {
        Stand { problem: self.problem, belt_speed: self.belt_speed }
    }

    /// The machine of the scene at the present speed of its belt.
    #[must_use]
    pub fn running(&self) -> Option<Running<'_>> {
        let rig = self.scene.machine.as_ref()?;
        let present = self.belt_speed.and_then(|speed| Running::at(&rig.machine, speed).ok());
        Some(present.unwrap_or_else(|| rig.running()))
    }

    /// Whether the numbers on show are those of the machine at the speed of its belt; `None` without one.
    #[must_use]
    pub fn is_on_the_belt(&self) -> Option<bool> {
        Some(self.running()?.carries(&self.problem.parameters))
    }

    /// A motion with the belt at another speed.
    ///
    /// # Errors
    /// One line, where there is no belt or no machine at that speed.
    pub(super) fn at_belt_speed(&self, problem: Problem, speed: f64) -> Result<Stand, String> {
        let running = self.running().ok_or("the scene is of no machine: it has no belt")?;
        let other = Running::at(running.machine, speed)?;
        let problem = running.brought_to(&other, problem);
        Ok(Stand { problem, belt_speed: Some(speed) })
    }

    /// Makes this what is on show, with a speed of the belt if and only if there is one.
    pub(super) fn set_stand(&mut self, stand: Stand) {
        let Stand { problem, belt_speed } = stand;
        let rig = self.scene.machine.as_ref();
        let can_run =
            |speed: &f64| rig.is_some_and(|rig| Running::at(&rig.machine, *speed).is_ok());
        let own = rig.map(|rig| rig.machine.belt.belt_speed);
        let present = self.belt_speed.filter(can_run);
        (self.belt_speed, self.problem) = (belt_speed.filter(can_run).or(present).or(own), problem);
    }
}
