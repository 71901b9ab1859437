//! The numbers of a vibration mode that has no belt.

/// A vibration mode: what feeds and damps it is a polynomial in its velocity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mode {
    /// Natural frequency, in cycles a second.
    pub frequency: f64,
    /// Modal mass, in kg.
    pub mass: f64,
    /// Damping ratio: coefficients of 1, v, v^2, .. in SI units.
    pub damping_ratio: Vec<f64>,
    /// Friction of the guide while it moves, in N.
    pub friction: f64,
    /// The same at rest; `None`: the same.
    pub static_guide: Option<f64>,
}
