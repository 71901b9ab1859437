//! Dry friction made into a field, so that common integrators can run across `v = 0`: for comparison.
//!
//! Two habits: the sign becomes `tanh(v/epsilon)`, smooth but stiff, at rate `r/epsilon` near `v = 0`, and
//! nowhere zero inside the sticking set, so that nothing ever rests; or the sign is kept, and what should
//! rest chatters across `v = 0` in steps that no longer have the order of their method.

use super::step::Field;
use crate::numerics::elementary::tanh;
use crate::oscillator::{HalfPlane, Parameters, Side};

/// What stands for the sign of `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SignLaw {
    /// `tanh(v/epsilon)`.
    Tanh(f64),
    /// The sign itself, 0 at 0.
    Sign,
}

/// The field of the whole phase plane with friction by such a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularized {
    /// Damping and restoring force.
    smooth: HalfPlane,
    r: f64,
    law: SignLaw,
}

impl Regularized {
    /// The field of these parameters.
    pub fn new(parameters: &Parameters, law: SignLaw) -> Self {
        Regularized { smooth: HalfPlane::new(parameters, Side::Upper), r: parameters.r, law }
    }
}

impl Field for Regularized {
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
