//! The closed form of the piecewise linear oscillator as a stepper: one step is a whole half swing.

use super::{Cost, Powers, Step, StepPoint, Stepper, powers_over};
use crate::closed_form::LinearFlow;
use crate::model::{HalfPlane, Reason, Result};
use crate::numerics::truncated;

/// Maximum number of pieces into which a step is cut for drawing and for quadrature. A piece is one unit of
/// time long.
const MOST_PIECES: f64 = 4096.0;

/// The stepper. It applies to fields with `D2 = D3 = 0` and is exact to rounding for every D.
#[derive(Clone, Debug)]
pub struct ExactStepper {
    linear: LinearFlow,
    start: StepPoint,
    duration: f64,
    cost: Cost,
}

impl ExactStepper {
    /// A stepper that has taken no step yet.
    pub fn new() -> Self {
        ExactStepper {
            linear: LinearFlow::new(0.0),
            start: StepPoint { x: 0.0, v: 0.0 },
            duration: 0.0,
            cost: Cost::default(),
        }
    }
}

impl Stepper for ExactStepper {
    fn begin(&mut self, field: &HalfPlane) {
        self.linear = LinearFlow::new(field.d);
    }

    fn advance(&mut self, from: StepPoint, longest: f64, arrives: bool) -> Result<Step> {
        self.cost.evaluations += 1;
        self.start = from;
        let arrival = arrives.then(|| self.linear.first_standstill(from.x, from.v)).flatten();
        let arrival = arrival.filter(|arrival| arrival.time <= longest);
        self.duration = arrival.map_or(longest, |arrival| arrival.time);
        let end = arrival.map(|arrival| StepPoint { x: arrival.x, v: 0.0 });
        let step = Step {
            duration: self.duration,
            end: end.unwrap_or_else(|| self.at(longest)),
            crossed: arrival.is_some(),
        };
        if step.end.size().is_finite() {
            Ok(step)
        } else {
            Err(Reason::OutOfRange)
        }
    }

    fn at(&self, time: f64) -> StepPoint {
        let (x, v) = self.linear.state(self.start.x, self.start.v, time);
        StepPoint { x, v }
    }

    fn powers(&self) -> Powers {
        powers_over(self.duration, self.pieces(), |time| self.at(time).v)
    }

    fn pieces(&self) -> usize {
        truncated(self.duration.clamp(1.0, MOST_PIECES).ceil())
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}
