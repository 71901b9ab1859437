//! Starts of a machine that are certainly safe or certainly lost, by the whole model.

use std::sync::Arc;

use super::kind::Question;
use super::resources::Resources;
use super::zones::{Zones, of_machine};
use crate::flow::Reason;
use crate::model::{Belt, Tolerances};

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The machine.
    pub belt: Arc<Belt>,
    /// Tolerances of its numbers, and the bound on the disturbance.
    pub tolerances: Tolerances,
}

impl Question for Inputs {
    type Found = Zones;

    fn answer(&self, means: &Resources) -> Result<Zones, Reason> {
        of_machine(&self.belt, &self.tolerances, means.fineness.points_per_step)
    }

    fn numbers(&self) -> [f64; 8] {
        [self.belt.belt_speed, self.tolerances.disturbance, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
