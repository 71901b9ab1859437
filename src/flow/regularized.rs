//! Dry friction turned into a field, so that common integrators can run across `v = 0`; for comparison.
//!
//! There are two common practices. One replaces the sign by `tanh(v/epsilon)`. The field is then smooth but
//! stiff, with rate `r/epsilon` near `v = 0`, and vanishes nowhere else in the sticking set, so that nothing
//! else ever rests. The other keeps the sign. What should rest then chatters across `v = 0`, and the steps lose
//! the order of their method.

use super::step::{Field, PlaneField};
use crate::model::{HalfPlane, Parameters, Side};
use crate::numerics::elementary::tanh;
use crate::numerics::scaling::times_power;

/// The field of the whole phase plane with friction as a function of the velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothField {
    /// Damping and restoring force.
    pub smooth: HalfPlane,
    /// Intensity of the friction.
    pub r: f64,
    /// The velocity over which `tanh(v/epsilon)` smoothes the sign of `v`; `None`: the sign itself, 0 at 0.
    epsilon: Option<f64>,
}

impl SmoothField {
    /// The field for these parameters.
    pub fn new(parameters: &Parameters, epsilon: Option<f64>) -> Self {
        let smooth = HalfPlane::new(parameters, Side::Upper);
        SmoothField { smooth, r: parameters.r, epsilon }
    }
}

impl Field for SmoothField {
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        let sign = match self.epsilon {
            Some(epsilon) => tanh(v / epsilon),
            None if v == 0.0 => 0.0,
            None => v.signum(),
        };
        self.smooth.acceleration(x, v) - self.r * sign
    }

    fn divergence(&self, v: f64) -> f64 {
        let slope = self.epsilon.map_or(0.0, |epsilon| {
            let tanh = tanh(v / epsilon);
            (1.0 - tanh) * (1.0 + tanh) / epsilon
        });
        self.smooth.divergence(v) - self.r * slope
    }

    fn magnitude(&self, x: f64, v: f64) -> f64 {
        self.smooth.magnitude(x, v) + self.r
    }
}

impl PlaneField for SmoothField {
    fn in_units(&self, k: i32) -> Self {
        SmoothField {
            smooth: self.smooth.in_units(k),
            r: times_power(self.r, -k),
            epsilon: self.epsilon.map(|epsilon| times_power(epsilon, -k)),
        }
    }

    fn frictionless(&self) -> HalfPlane {
        self.smooth
    }
}
