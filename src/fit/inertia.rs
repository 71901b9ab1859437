//! What a record does not contain: a mass or stiffness.

use serde::{Deserialize, Serialize};

use crate::numerics::elementary::powi;

/// The mass or stiffness, which a record does not contain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inertia {
    /// Mass in kg.
    Mass(f64),
    /// Stiffness in N/m.
    Stiffness(f64),
}

impl Inertia {
    /// The mass times a power of `omega0`.
    #[must_use]
    pub fn times(self, omega0: f64, power: i32) -> f64 {
        match self {
            Inertia::Mass(mass) => mass * powi(omega0, power),
            Inertia::Stiffness(stiffness) => stiffness * powi(omega0, power - 2),
        }
    }
}
