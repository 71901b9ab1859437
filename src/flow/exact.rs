//! The closed form of the piecewise linear oscillator as a stepper: one step is a whole half swing.

use super::motion::Cost;
use super::step::{Powers, Step, StepPoint, Stepper};
use crate::closed_form::linear::Linear;
use crate::model::{HalfPlane, Reason};
use crate::numerics::count::truncated;

/// Maximum number of pieces into which a step is cut for drawing and for quadrature. A piece is one unit of
/// time long.
const MOST_PIECES: f64 = 4096.0;

/// The stepper. It applies to fields with `D2 = D3 = 0` and is exact to rounding for every D.
#[derive(Clone, Debug)]
pub struct Exact {
    field: HalfPlane,
    linear: Linear,
    start: StepPoint,
    duration: f64,
    cost: Cost,
}

/// A step, unless it leaves the range of numbers.
fn finite(step: Step) -> Result<Step, Reason> {
    if step.end.size().is_finite() { Ok(step) } else { Err(Reason::OutOfRange) }
}

impl Exact {
    /// A stepper that has taken no step yet.
    pub fn new() -> Self {
        Exact {
            field: HalfPlane { d: 0.0, d2: 0.0, d3: 0.0 },
            linear: Linear::new(0.0),
            start: StepPoint { x: 0.0, v: 0.0 },
            duration: 0.0,
            cost: Cost::default(),
        }
    }

    /// The largest v in the last step, if the acceleration changes sign there.
    ///
    /// Velocity and acceleration obey the same equation as displacement and velocity.
    pub fn fastest(&self) -> Option<f64> {
        let StepPoint { x, v } = self.start;
        let acceleration = self.field.acceleration(x, v);
        let top = self.linear.first_standstill(v, acceleration)?;
        (acceleration > 0.0 && top.time <= self.duration).then_some(top.x)
    }
}

impl Stepper for Exact {
    fn begin(&mut self, field: &HalfPlane) {
        (self.field, self.linear) = (*field, Linear::new(field.d));
    }

    fn advance(&mut self, from: StepPoint, longest: f64) -> Result<Step, Reason> {
        let arrival = self.linear.first_standstill(from.x, from.v);
        let Some(arrival) = arrival.filter(|arrival| arrival.time <= longest) else {
            return self.pass(from, longest);
        };
        (self.start, self.duration) = (from, arrival.time);
        self.cost.evaluations += 1;
        let end = StepPoint { x: arrival.x, v: 0.0 };
        finite(Step { duration: arrival.time, end, crossed: true })
    }

    fn pass(&mut self, from: StepPoint, longest: f64) -> Result<Step, Reason> {
        (self.start, self.duration) = (from, longest);
        self.cost.evaluations += 1;
        finite(Step { duration: longest, end: self.at(longest), crossed: false })
    }

    fn at(&self, time: f64) -> StepPoint {
        let (x, v) = self.linear.state(self.start.x, self.start.v, time);
        StepPoint { x, v }
    }

    fn powers(&self) -> Powers {
        Powers::over(self.duration, self.pieces(), |time| self.at(time).v)
    }

    fn pieces(&self) -> usize {
        truncated(self.duration.clamp(1.0, MOST_PIECES).ceil())
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}
