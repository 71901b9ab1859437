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

/// The law that replaces the sign of `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SignLaw {
    /// `tanh(v/epsilon)`.
    Tanh(f64),
    /// The sign itself, 0 at 0.
    Sign,
}

/// The field of the whole phase plane with friction by a [`SignLaw`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothField {
    /// Damping and restoring force.
    pub smooth: HalfPlane,
    /// Intensity of the friction.
    pub r: f64,
    law: SignLaw,
}

impl SmoothField {
    /// The field for these parameters.
    pub fn new(parameters: &Parameters, law: SignLaw) -> Self {
        SmoothField { smooth: HalfPlane::new(parameters, Side::Upper), r: parameters.r, law }
    }
}

impl Field for SmoothField {
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        let sign = match self.law {
            SignLaw::Tanh(epsilon) => tanh(v / epsilon),
            SignLaw::Sign if v == 0.0 => 0.0,
            SignLaw::Sign => v.signum(),
        };
        self.smooth.acceleration(x, v) - self.r * sign
    }

    fn divergence(&self, v: f64) -> f64 {
        let slope = match self.law {
            SignLaw::Tanh(epsilon) => {
                let tanh = tanh(v / epsilon);
                (1.0 - tanh) * (1.0 + tanh) / epsilon
            }
            SignLaw::Sign => 0.0,
        };
        self.smooth.divergence(v) - self.r * slope
    }

    fn magnitude(&self, x: f64, v: f64) -> f64 {
        self.smooth.magnitude(x, v) + self.r
    }
}

impl PlaneField for SmoothField {
    fn in_units(&self, k: i32) -> Self {
        let law = match self.law {
            SignLaw::Tanh(epsilon) => SignLaw::Tanh(times_power(epsilon, -k)),
            SignLaw::Sign => SignLaw::Sign,
        };
        SmoothField { smooth: self.smooth.in_units(k), r: times_power(self.r, -k), law }
    }

    fn frictionless(&self) -> HalfPlane {
        self.smooth
    }
}
