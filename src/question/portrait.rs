//! All cycles of a machine and the border of its basin.

use std::sync::Arc;

use super::kind::{Question, numbers};
use super::resources::Resources;
use super::whole::{self, WholeCycles};
use crate::flow::Reason;
use crate::model::{Belt, Parameters};
use crate::portrait::Cycles;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// The machine.
    pub belt: Arc<Belt>,
    /// Its cubic expansion.
    pub parameters: Parameters,
    /// Whether to draw the cycles of the expansion instead of those of the whole model.
    pub cubic: bool,
}

impl Question for Inputs {
    type Found = (Cycles, Option<WholeCycles>);

    fn answer(&self, means: &Resources) -> Result<Self::Found, Reason> {
        let points = means.fineness.points_per_step;
        whole::portrait(&self.belt, &self.parameters, self.cubic, points, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [0.0; 4])
    }
}
