//! The whole model of a vibration mode that has no belt.

use super::model::{Model, NoModel};
use crate::oscillator::Modal;

impl Modal {
    /// Its whole model.
    ///
    /// # Errors
    /// [`NoModel`] where the static friction or the numbers allow none.
    pub fn model(&self) -> Result<Model, NoModel> {
        let omega_0 = std::f64::consts::TAU * self.frequency;
        let at_rest = self.static_guide.unwrap_or(self.friction);
        Model::of_mode(omega_0, self.mass, &self.damping_ratio, self.friction, at_rest)
    }
}
