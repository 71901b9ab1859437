//! What some measures depend on beside the parameters and the start.

use crate::model::{Knob, ParameterBox, Parameters};
use crate::portrait::basin::Window;
use crate::portrait::design::oscillator::Kick;
use crate::portrait::kicks::RandomKick;

/// The window of starts, the tolerances, the disturbance and the kicks.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Starts whose part or times are measured.
    pub window: Window,
    /// Half widths of parameters, each given once.
    pub half_widths: Vec<(Knob, f64)>,
    /// Bound on the disturbance.
    pub disturbance: f64,
    /// Kicks of which a fraction is lost.
    pub kicks: RandomKick,
    /// Whether the window of a machine counts displacements from the relaxed spring.
    pub elongation: bool,
    /// The margin for which the friction is sought.
    pub wanted: Option<(Kick, f64)>,
}

impl From<Window> for Conditions {
    fn from(window: Window) -> Self {
        let kicks = RandomKick::default();
        Conditions {
            window,
            half_widths: Vec::new(),
            disturbance: 0.0,
            kicks,
            elongation: false,
            wanted: None,
        }
    }
}

impl Conditions {
    /// The box of parameters around these; friction is never negative.
    pub fn around(&self, parameters: &Parameters) -> ParameterBox {
        let mut known = ParameterBox::from(parameters);
        for &(symbol, half_width) in &self.half_widths {
            known.widen(symbol, half_width);
        }
        known
    }

    /// How far the edge of the basin matters.
    pub fn reach(&self) -> f64 {
        self.window.q.0.abs().max(self.window.q.1.abs())
    }
}
