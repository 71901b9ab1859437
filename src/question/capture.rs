//! The borders of the bands of capture.

use super::kind::{Question, numbers};
use super::means::Means;
use crate::flow::{Cost, Reason};
use crate::oscillator::{Parameters, State};
use crate::study::capture::bands;

#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    pub parameters: Parameters,
    /// Clearance up to which borders are followed.
    pub reach: f64,
    /// Bands at most.
    pub most: usize,
}

/// The borders between bands of capture, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Borders {
    /// In each half plane, innermost first.
    pub curves: Vec<Vec<State>>,
    /// What they cost.
    pub cost: Cost,
}

impl Question for Asked {
    type Found = Borders;

    fn answer(&self, means: &Means) -> Result<Borders, Reason> {
        let found = bands(&self.parameters, self.reach, self.most, means.limits)?;
        let curves = found.curves(means.fineness.points_per_step);
        Ok(Borders { curves, cost: found.cost })
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [self.reach, 0.0, 0.0, 0.0])
    }
}
