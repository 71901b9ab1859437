//! The motion of a machine by the whole model, in the units of the paper's oscillator.

use std::sync::Arc;

use super::kind::{Question, of_motion};
use super::resources::Resources;
use super::whole::{self, Course};
use crate::flow::{Problem, Reason, Trajectory};
use crate::model::Belt;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub belt: Arc<Belt>,
    /// Start, end time and tolerance; its parameters are those of the cubic expansion.
    pub problem: Problem,
}

impl Question for Inputs {
    type Found = (Trajectory, Course);

    fn answer(&self, means: &Resources) -> Result<Self::Found, Reason> {
        let between = u32::try_from(means.fineness.samples_per_step).unwrap_or(u32::MAX);
        whole::motion(&self.belt, &self.problem, between)
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(&self.problem)
    }
}
