//! Parameters that are known to lie between two numbers.
//!
//! An interval is written `VALUE+-HALFWIDTH` (a tolerance), `LOW..HIGH` (both ends included), or as a plain
//! number.

use std::str::FromStr;

use serde::Serialize;

use super::parameters::{Parameters, Symbol};
pub use crate::numerics::Interval;

impl FromStr for Interval {
    type Err = String;

    /// Reads `VALUE+-HALFWIDTH`, `LOW..HIGH` or a number.
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| match f64::from_str(text.trim()) {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(format!("{text:?} is not a finite number")),
            Err(_) => Err(format!("{text:?} is not a number, VALUE+-HALFWIDTH or LOW..HIGH")),
        };
        if let Some((value, half_width)) = text.split_once("+-") {
            let (value, half_width) = (number(value)?, number(half_width)?);
            if half_width < 0.0 {
                return Err(format!("the half width {half_width:?} is negative"));
            }
            return Ok(Self::around(value, half_width));
        }
        if let Some((low, high)) = text.split_once("..") {
            let (low, high) = (number(low)?, number(high)?);
            if low > high {
                return Err(format!("{low:?} is above {high:?}"));
            }
            return Ok(Interval::new(low, high));
        }
        number(text).map(Self::point)
    }
}

/// The parameters of equation (4), each in an interval of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ParameterBox {
    /// Linear damping D.
    #[serde(rename = "D")]
    pub d: Interval,
    /// Asymmetric damping D2.
    #[serde(rename = "D2")]
    pub d2: Interval,
    /// Cubic damping D3.
    #[serde(rename = "D3")]
    pub d3: Interval,
    /// Dry friction r.
    pub r: Interval,
}

impl From<&Parameters> for ParameterBox {
    /// The parameters as the doubles that they are.
    fn from(parameters: &Parameters) -> Self {
        let Parameters { d, d2, d3, r } = *parameters;
        let [d, d2, d3, r] = [d, d2, d3, r].map(Interval::point);
        ParameterBox { d, d2, d3, r }
    }
}

impl ParameterBox {
    /// Replaces the interval of one parameter.
    ///
    /// # Errors
    /// What is wrong: an end outside the range of the parameter, or a number that is not a parameter.
    pub fn set(&mut self, symbol: Symbol, interval: Interval) -> Result<(), String> {
        for end in [interval.lower(), interval.upper()] {
            symbol.spec().check(end).map_err(|refused| refused.to_string())?;
        }
        *match symbol {
            Symbol::D => &mut self.d,
            Symbol::D2 => &mut self.d2,
            Symbol::D3 => &mut self.d3,
            Symbol::R => &mut self.r,
            Symbol::Q0 | Symbol::V0 => {
                return Err(format!(
                    "{symbol} is the start of a motion; only D, D2, D3, r have intervals"
                ));
            }
        } = interval;
        Ok(())
    }

    /// The parameters halfway.
    #[must_use]
    pub fn middle(&self) -> Parameters {
        let [d, d2, d3, r] = [self.d, self.d2, self.d3, self.r].map(Interval::middle);
        Parameters { d, d2, d3, r }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_read_with_their_ends_outwards() {
        let read = |text: &str| text.parse::<Interval>().unwrap();
        let r = read("0.10+-0.01");
        assert_eq!(r.lower(), 0.09);
        assert!(r.upper() >= 0.11 && r.upper() < 0.110_000_000_000_001);
        assert_eq!(read("-0.3..-0.28"), Interval::new(-0.3, -0.28));
        assert_eq!(read("1e-3"), Interval::point(1e-3));
        assert_eq!(read("2+-0"), Interval::point(2.0));
        assert_eq!(read("-1+-1e-3").middle(), -1.0);
    }

    #[test]
    fn what_is_no_interval_is_refused() {
        for (text, words) in [
            ("1..", "not a number"),
            ("2..1", "2.0 is above 1.0"),
            ("1+-x", "not a number"),
            ("1+--2", "half width -2.0 is negative"),
            ("inf..1", "not a finite number"),
            ("", "not a number"),
        ] {
            let refused = text.parse::<Interval>().unwrap_err();
            assert!(refused.contains(words), "{text}: {refused}");
        }
        let mut known = ParameterBox::from(&Parameters::default());
        let refused = known.set(Symbol::R, Interval::around(0.1, 0.2)).unwrap_err();
        assert!(refused.contains("r = -0.1") && refused.contains("0.0 .."), "{refused}");
        assert!(known.set(Symbol::Q0, Interval::point(1.0)).is_err());
        assert_eq!(known, ParameterBox::from(&Parameters::default()));
    }
}
