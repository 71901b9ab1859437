//! First-order harmonic balance (equations 37 to 54).

use serde::Serialize;

/// A stationary amplitude of the first-order harmonic approximation `q = A0 + A cos(tau)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Harmonic {
    /// Amplitude A, a positive root of equation (42).
    pub amplitude: f64,
    /// Mean A0 (equation 40).
    pub mean: f64,
    /// Whether the averaged equation (41, corrected) attracts to it.
    pub stable: bool,
}
