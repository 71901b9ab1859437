//! What a record does not contain: a mass or stiffness, and how large its unit of length is.

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

/// Units of length and their values in metres.
pub const LENGTHS: [(&str, f64); 8] = [
    ("m", 1.0),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("cm", 1e-2),
    ("nm", 1e-9),
    ("in", 0.0254),
    ("inch", 0.0254),
    ("km", 1e3),
];

/// The value of a unit of length in metres; `None` if it is unknown.
#[must_use]
pub fn length_in_metres(unit: &str) -> Option<f64> {
    let plain = unit.replace(['\u{b5}', '\u{3bc}'], "u");
    LENGTHS.iter().find(|(name, _)| *name == plain).map(|(_, metres)| *metres)
}
