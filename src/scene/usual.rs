//! What a scene has where its file does not say otherwise.

/// Relative error of a step of a scene: ten digits, at a few percent of the
/// cost of drawing them.
pub const TOLERANCE: f64 = 1e-10;

/// End time of a scene: about ten periods of the undamped oscillator.
pub const UNTIL: f64 = 60.0;
