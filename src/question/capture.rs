//! The borders of the bands of capture.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::flow::{Cost, Reason};
use crate::model::{Parameters, State};
use crate::portrait::basin::capture::bands;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
    /// Largest clearance to which borders are followed.
    pub reach: f64,
    /// Maximum number of bands.
    pub most: usize,
}

/// The borders between bands of capture, as curves to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Borders {
    /// The curves of `v > 0` and then those of `v < 0`, innermost first in each.
    pub curves: Vec<Vec<State>>,
    /// Cost of computing them.
    pub cost: Cost,
}

impl Question for Inputs {
    type Found = Borders;

    fn answer(&self, means: &Resources) -> Result<Borders, Reason> {
        let found = bands(&self.parameters, self.reach, self.most, means.limits)?;
        let curves = found.curves(means.fineness.points_per_step);
        Ok(Borders { curves, cost: found.cost })
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [self.reach, 0.0, 0.0, 0.0])
    }
}
