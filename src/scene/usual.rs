//! Defaults of a scene, where its file sets nothing else.

/// Relative error of an integration step: ten digits, at a few percent of the cost of drawing.
pub const TOLERANCE: f64 = 1e-10;

/// End time: about ten periods of the undamped oscillator.
pub const UNTIL: f64 = 60.0;
