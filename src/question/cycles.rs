//! All cycles at given parameters, with their curves and the edge of the basin.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::flow::Reason;
use crate::model::Parameters;
use crate::portrait::Cycles;
use crate::portrait::basin::cycle::cycles_drawn;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
}

impl Question for Inputs {
    type Found = Cycles;

    fn answer(&self, means: &Resources) -> Result<Cycles, Reason> {
        cycles_drawn(&self.parameters, means.fineness.points_per_step, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [0.0; 4])
    }
}
