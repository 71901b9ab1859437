//! Parameters that are known to lie between two numbers.

use super::knob::Knob;
use super::{KnobSpec, Parameters};
pub use crate::numerics::Interval;

/// The parameters of equation (4), each in an interval of its own.
pub type ParameterBox = Parameters<Interval>;

impl From<&Parameters> for ParameterBox {
    /// The parameters as the doubles that they are.
    fn from(parameters: &Parameters) -> Self {
        parameters.map(Interval::point)
    }
}

impl ParameterBox {
    /// Replaces the interval of one parameter.
    ///
    /// # Errors
    /// What is wrong: an end outside the range of the parameter, or a number that is not a parameter.
    pub fn set(&mut self, symbol: Knob, interval: Interval) -> Result<(), String> {
        for end in [interval.lower(), interval.upper()] {
            symbol.check(end)?;
        }
        *self.part(symbol).ok_or_else(|| {
            format!("{symbol} is the start of a motion; only D, D2, D3, r have intervals")
        })? = interval;
        Ok(())
    }

    /// The box that reaches from the parameters by these half widths to both sides, within their ranges. Its ends, unlike
    /// a parameter, may be arbitrarily close to 0. The start of a motion has no interval.
    pub fn around(
        parameters: &Parameters,
        half_widths: impl IntoIterator<Item = (Knob, f64)>,
    ) -> Self {
        let mut known = ParameterBox::from(parameters);
        for (symbol, half_width) in half_widths {
            let KnobSpec { min, max, .. } = *symbol.spec();
            if let Some(part) = known.part(symbol) {
                let [lower, upper] =
                    [part.lower(), part.upper()].map(|end| Interval::around(end, half_width));
                *part = Interval::new(lower.lower().max(min), upper.upper().min(max));
            }
        }
        known
    }

    /// The parameters halfway.
    pub fn middle(&self) -> Parameters {
        self.map(Interval::middle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_interval_of_a_parameter_is_refused() {
        let mut known = ParameterBox::from(&Parameters::default());
        let refused = known.set(Knob::R, Interval::around(0.1, 0.2)).unwrap_err();
        assert!(refused.contains("r = -0.1") && refused.contains("0 .."), "{refused}");
        assert!(known.set(Knob::Q0, Interval::point(1.0)).is_err());
        assert_eq!(known, ParameterBox::from(&Parameters::default()));
    }
}
