//! The mass on the belt.

use serde::{Deserialize, Serialize};

use super::friction::FrictionLaw;

/// A mass on a moving belt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Belt {
    /// Mass m, in kg.
    pub mass: f64,
    /// Stiffness c, in N/m.
    pub stiffness: f64,
    /// Linear damping d1, in N s/m.
    pub damping: f64,
    /// Cubic damping d3, in N s^3/m^3.
    pub cubic_damping: f64,
    /// Force F onto the belt, in N.
    pub normal_force: f64,
    /// Intensity R of the friction element, in N.
    pub friction: f64,
    /// Belt speed v0, in m/s.
    pub belt_speed: f64,
    /// Coefficient of friction between mass and belt.
    pub law: FrictionLaw,
    /// Coefficient up to which the belt holds the mass; that of the law at rest where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_coefficient: Option<f64>,
    /// Force up to which the friction element holds the mass, in N; R where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_guide: Option<f64>,
}

impl Belt {
    /// The force on the mass at displacement `x` (from the static one) and velocity `v`, in N and SI units,
    /// without the friction element; `None` where the friction law does not reach.
    #[must_use]
    pub fn force(&self, x: f64, v: f64) -> Option<f64> {
        let drag = self.law.mu(self.belt_speed - v)? - self.law.mu(self.belt_speed)?;
        let damping = v * (self.damping + v * v * self.cubic_damping);
        Some(self.normal_force * drag - damping - self.stiffness * x)
    }
}
