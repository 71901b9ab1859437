//! The uncertainty of the parameters, the parameters held in a fit, and the disturbance.

use serde::{Deserialize, Serialize};

use crate::model::{Belt, Knob, ParameterBox, Parameters, Tolerances};
use crate::scene::Running;

/// The largest deviations of the parameters from their values, and the bound on a force that varies in any way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Uncertainty {
    /// Half widths of D, D2, D3 and r.
    pub half_widths: [f64; 4],
    /// Bound w on the disturbance, in the unit of r.
    pub disturbance: f64,
    /// Which of D, D2, D3, r, q0 and v0 are held at their values in a fit.
    #[serde(default)]
    pub held: [bool; 6],
}

/// The parameters that correspond to one number of a machine each.
pub const ON_A_MACHINE: [(Knob, Knob); 3] =
    [(Knob::D, Knob::Damping), (Knob::D3, Knob::CubicDamping), (Knob::R, Knob::Friction)];

/// The parameter that corresponds to a number of a machine, if one does.
pub fn symbol_of(quantity: Knob) -> Option<Knob> {
    ON_A_MACHINE.iter().find(|row| row.1 == quantity).map(|row| row.0)
}

impl Uncertainty {
    /// Whether nothing is uncertain, disturbed or held.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether everything is known exactly and there is no disturbance.
    pub fn is_certain(&self) -> bool {
        self.disturbance == 0.0 && self.half_widths == [0.0; 4]
    }

    /// Whether a number is held by hand.
    pub fn holds(&self, symbol: Knob) -> bool {
        self.held[symbol as usize]
    }

    /// Whether any number is held by hand.
    pub fn holds_any(&self) -> bool {
        self.held.contains(&true)
    }

    /// Checks that no number is negative or infinite. Fails with one line that names the number.
    pub fn checked(self) -> Result<Self, String> {
        let mut all = self.half_widths.into_iter().chain([self.disturbance]);
        match all.find(|it| !(it.is_finite() && *it >= 0.0)) {
            Some(value) => {
                Err(format!("doubt: {value:?}; half widths and disturbance are 0 or more"))
            }
            None => Ok(self),
        }
    }

    /// The half width of a number; 0 for a number that has none.
    pub fn half_width(&self, symbol: Knob) -> f64 {
        Knob::PARAMETERS
            .iter()
            .position(|it| *it == symbol)
            .map_or(0.0, |place| self.half_widths[place])
    }

    /// This doubt with another half width of a parameter. Fails with one line if `symbol` is none.
    pub fn with_half_width(mut self, symbol: Knob, half: f64) -> Result<Self, String> {
        let place = Knob::PARAMETERS
            .iter()
            .position(|it| *it == symbol)
            .ok_or_else(|| format!("{symbol} has no half width; only D, D2, D3 and r have one"))?;
        self.half_widths[place] = half;
        Ok(self)
    }

    /// The intervals of the parameters, limited to their ranges.
    pub fn known(&self, parameters: &Parameters) -> ParameterBox {
        let mut known = ParameterBox::from(parameters);
        for (symbol, half_width) in Knob::PARAMETERS.into_iter().zip(self.half_widths) {
            known.widen(symbol, half_width);
        }
        known
    }

    /// The tolerances from a machine's file, in the units of its oscillator.
    pub fn of_machine(running: &Running) -> Self {
        let Tolerances { half_widths, disturbance } = &running.machine.tolerances;
        let mut doubt = Uncertainty::default();
        for (symbol, quantity) in ON_A_MACHINE {
            let half = half_widths.get(quantity.spec().name).copied().unwrap_or(0.0);
            let half = half / running.scale(symbol);
            doubt = doubt.with_half_width(symbol, half).unwrap_or(doubt);
        }
        Uncertainty { disturbance: disturbance / running.reduced.units.force, ..doubt }
    }

    /// The tolerances of the machine on show that correspond to this; those of its other numbers are from its
    /// file. Fails with one line if D2, which no single part of the machine determines, has a half width.
    pub fn on_machine(&self, running: &Running, belt: &Belt) -> Result<Tolerances, String> {
        if self.half_width(Knob::D2) > 0.0 {
            return Err("no part of the machine sets D2 alone: it has no half width".to_owned());
        }
        let mut half_widths = running.machine.tolerances.half_widths.clone();
        for (symbol, quantity) in ON_A_MACHINE {
            let value = quantity.of_belt(belt).unwrap_or(0.0);
            let half = self.half_width(symbol) * running.scale(symbol);
            // Friction and dampers are never negative, so a half width is limited.
            let half = half.min((value - quantity.spec().min).abs());
            half_widths.insert(quantity.spec().name.to_owned(), half);
        }
        Ok(Tolerances { half_widths, disturbance: self.disturbance * running.reduced.units.force })
    }

    /// Converts this to the units of the machine at another speed of its belt.
    pub fn brought_to(self, from: &Running, to: &Running) -> Self {
        if self == Self::of_machine(from) {
            return Self::of_machine(to);
        }
        let mut moved = self;
        for (symbol, _) in ON_A_MACHINE {
            let half = self.half_width(symbol) * (from.scale(symbol) / to.scale(symbol));
            moved = moved.with_half_width(symbol, half).unwrap_or(moved);
        }
        let force = from.reduced.units.force / to.reduced.units.force;
        Uncertainty { disturbance: self.disturbance * force, ..moved }
    }
}
