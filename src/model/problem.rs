//! One motion of a machine or a mode, and how exactly its numbers are known.

use super::subject::Subject;
use super::tolerance::Tolerances;
use crate::model::{Group, Knob};

/// One motion of a machine or a mode, and how exactly its numbers are known.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineProblem {
    /// What moves.
    pub subject: Subject,
    /// How exactly its numbers are known, and what disturbs it.
    pub tolerances: Tolerances,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    /// How long the motion is followed, in s.
    pub until: f64,
}

impl MachineProblem {
    /// What can be set: the machine or the mode, and its motion.
    pub const GROUPS: &[Group] = &[Group::Machine, Group::Law, Group::Mode, Group::Course];

    /// Gives a number a value in SI units.
    ///
    /// # Errors
    /// One line, if there is no such number.
    pub fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        *match knob {
            Knob::X => &mut self.start.0,
            Knob::V => &mut self.start.1,
            Knob::Duration => &mut self.until,
            Knob::DisturbingForce => &mut self.tolerances.disturbance,
            _ => return self.subject.set(knob, value),
        } = value;
        Ok(())
    }
}
