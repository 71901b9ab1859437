//! Starts of a machine that are certainly safe or certainly lost, by the whole model.

use std::sync::Arc;

use super::kind::Question;
use super::means::Means;
use super::zones::{Zones, of_machine};
use crate::flow::Reason;
use crate::machine::Tolerances;
use crate::oscillator::Belt;

#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The machine.
    pub belt: Arc<Belt>,
    /// Tolerances of its numbers, and the bound on the disturbance.
    pub tolerances: Tolerances,
}

impl Question for Asked {
    type Found = Zones;

    fn answer(&self, means: &Means) -> Result<Zones, Reason> {
        of_machine(&self.belt, &self.tolerances, means.fineness.points_per_step)
    }

    fn numbers(&self) -> [f64; 8] {
        [self.belt.belt_speed, self.tolerances.disturbance, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}
