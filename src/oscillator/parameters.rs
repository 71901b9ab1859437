//! The numbers that define a motion: four parameters and two initial values.
//!
//! [`PARAMETERS`] is the one table of them. The parameter pane, the command line, scene files, scans
//! and error messages all read names, meanings, ranges and steps from it.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::numerics::decimal::shortest;
use crate::numerics::scaling::times_power;

/// The parameters of equation (4): damping, asymmetry, cubic damping, friction. All dimensionless, and each 0 or
/// within 1e-150 .. 1e150 in magnitude ([`PARAMETERS`]): beyond that, nothing is promised.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Effective linear damping D; negative means self-excited, `abs(D) < 1` oscillatory.
    #[serde(rename = "D")]
    pub d: f64,
    /// Asymmetric (quadratic) damping D2.
    #[serde(rename = "D2")]
    pub d2: f64,
    /// Cubic damping D3.
    #[serde(rename = "D3")]
    pub d3: f64,
    /// Intensity r of the dry friction, not negative.
    pub r: f64,
}

/// A point of the phase plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Displacement, dimensionless.
    pub q: f64,
    /// Velocity `dq/dtau`, dimensionless.
    pub v: f64,
}

impl State {
    /// The point reflected in the origin.
    #[must_use]
    pub fn mirrored(self) -> Self {
        State { q: -self.q, v: -self.v }
    }
}

impl Parameters {
    /// The parameters for which mirrored motions are motions: `D2` changes its sign.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Parameters { d2: -self.d2, ..self }
    }

    /// The parameters for which motions `2^k` times as large are motions (scaling symmetry of equation 4).
    #[must_use]
    pub fn times_power(self, k: i32) -> Self {
        Parameters {
            d: self.d,
            d2: times_power(self.d2, -k),
            d3: times_power(times_power(self.d3, -k), -k),
            r: times_power(self.r, k),
        }
    }

    /// Whether the motion is linear on each side of `v = 0`, so that closed forms hold.
    #[must_use]
    pub fn is_piecewise_linear(&self) -> bool {
        self.d2 == 0.0 && self.d3 == 0.0
    }

    /// Frequency of the linear oscillation, `sqrt(1 - D^2)`, where `abs(D) < 1`.
    #[must_use]
    pub fn omega(&self) -> Option<f64> {
        (self.d.abs() < 1.0).then(|| ((1.0 - self.d) * (1.0 + self.d)).sqrt())
    }
}

/// The name of one of the six numbers that define a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Symbol {
    /// Effective linear damping.
    D,
    /// Asymmetric damping.
    D2,
    /// Cubic damping.
    D3,
    /// Friction intensity.
    #[serde(rename = "r")]
    R,
    /// Initial displacement.
    #[serde(rename = "q0")]
    Q0,
    /// Initial velocity.
    #[serde(rename = "v0")]
    V0,
}

/// One row of [`PARAMETERS`].
#[derive(Clone, Copy, Debug)]
pub struct ParameterSpec {
    /// Which number this row describes.
    pub symbol: Symbol,
    /// The name in scene files, on the command line and on the screen.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Value of the plain oscillator.
    pub default: f64,
    /// First step of the keys that change it.
    pub step: f64,
}

impl ParameterSpec {
    /// Accepts a value of this number.
    ///
    /// # Errors
    /// [`OutOfRange`] if the value is not finite, outside `min ..= max`, or closer to 0 than 1e-150 without being 0.
    pub fn check(&self, value: f64) -> Result<f64, OutOfRange> {
        let is_large_enough = value == 0.0 || value.abs() >= 1.0 / FAR;
        if is_large_enough && (self.min..=self.max).contains(&value) {
            Ok(value)
        } else {
            Err(OutOfRange { name: self.name, value, min: self.min, max: self.max })
        }
    }
}

/// A value that a parameter cannot take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// Name of the parameter.
    pub name: &'static str,
    /// The value refused.
    pub value: f64,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, value, min, max } = self;
        let is_small = (*min..=*max).contains(value);
        let value = shortest(*value);
        if is_small {
            let least = shortest(1.0 / FAR);
            return write!(
                out,
                "{name} = {value} is too close to 0; allowed: 0, or {least} and more in magnitude"
            );
        }
        write!(out, "{name} = {value} is outside its range {min:?} .. {max:?}")
    }
}

impl std::error::Error for OutOfRange {}

/// Largest magnitude of a number; the least, besides 0, is its reciprocal. Between them products of a few numbers
/// neither over- nor underflow.
const FAR: f64 = 1e150;

/// The six numbers that define a motion, in the order in which they are shown.
pub const PARAMETERS: [ParameterSpec; 6] = [
    ParameterSpec {
        symbol: Symbol::D,
        name: "D",
        meaning: "linear damping",
        min: -1e6,
        max: 1e6,
        default: -0.1,
        step: 0.01,
    },
    ParameterSpec {
        symbol: Symbol::D2,
        name: "D2",
        meaning: "asymmetric damping",
        min: -FAR,
        max: FAR,
        default: 0.0,
        step: 0.05,
    },
    ParameterSpec {
        symbol: Symbol::D3,
        name: "D3",
        meaning: "cubic damping",
        min: -FAR,
        max: FAR,
        default: 0.0,
        step: 0.05,
    },
    ParameterSpec {
        symbol: Symbol::R,
        name: "r",
        meaning: "dry friction",
        min: 0.0,
        max: FAR,
        default: 0.1,
        step: 0.01,
    },
    ParameterSpec {
        symbol: Symbol::Q0,
        name: "q0",
        meaning: "initial displacement",
        min: -FAR,
        max: FAR,
        default: 1.0,
        step: 0.05,
    },
    ParameterSpec {
        symbol: Symbol::V0,
        name: "v0",
        meaning: "initial velocity",
        min: -FAR,
        max: FAR,
        default: 0.0,
        step: 0.05,
    },
];

impl Symbol {
    /// The row of [`PARAMETERS`] that describes this number.
    #[must_use]
    pub fn spec(self) -> &'static ParameterSpec {
        &PARAMETERS[self as usize]
    }

    /// The symbol with this name, compared exactly.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        PARAMETERS.iter().find(|row| row.name == name).map(|row| row.symbol)
    }

    /// Reads this number out of parameters and initial state.
    #[must_use]
    pub fn get(self, parameters: &Parameters, initial: &State) -> f64 {
        match self {
            Symbol::D => parameters.d,
            Symbol::D2 => parameters.d2,
            Symbol::D3 => parameters.d3,
            Symbol::R => parameters.r,
            Symbol::Q0 => initial.q,
            Symbol::V0 => initial.v,
        }
    }

    /// Writes this number into parameters or initial state.
    pub fn set(self, parameters: &mut Parameters, initial: &mut State, value: f64) {
        match self {
            Symbol::D => parameters.d = value,
            Symbol::D2 => parameters.d2 = value,
            Symbol::D3 => parameters.d3 = value,
            Symbol::R => parameters.r = value,
            Symbol::Q0 => initial.q = value,
            Symbol::V0 => initial.v = value,
        }
    }
}

impl fmt::Display for Symbol {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.spec().name)
    }
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters {
            d: Symbol::D.spec().default,
            d2: Symbol::D2.spec().default,
            d3: Symbol::D3.spec().default,
            r: Symbol::R.spec().default,
        }
    }
}

impl Default for State {
    fn default() -> Self {
        State { q: Symbol::Q0.spec().default, v: Symbol::V0.spec().default }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_symbol_stands_at_its_own_row() {
        for row in &PARAMETERS {
            assert_eq!(row.symbol.spec().name, row.name);
            assert_eq!(Symbol::named(row.name), Some(row.symbol));
            assert_eq!(row.check(row.default), Ok(row.default));
        }
    }

    #[test]
    fn what_is_set_is_read_back() {
        let (mut parameters, mut initial) = (Parameters::default(), State::default());
        for (index, row) in PARAMETERS.iter().enumerate() {
            let value = 0.5 + f64::from(u8::try_from(index).unwrap());
            row.symbol.set(&mut parameters, &mut initial, value);
            assert_eq!(row.symbol.get(&parameters, &initial), value);
        }
    }

    #[test]
    fn numbers_that_are_none_are_refused_with_the_range() {
        for value in [f64::NAN, f64::INFINITY, -1.0] {
            let refused = Symbol::R.spec().check(value).unwrap_err().to_string();
            assert!(refused.starts_with("r = ") && refused.contains("0.0 .. 1e150"), "{refused}");
        }
        let refused = Symbol::D2.spec().check(-1e-151).unwrap_err().to_string();
        assert_eq!(
            refused,
            "D2 = -1e-151 is too close to 0; allowed: 0, or 1e-150 and more in magnitude"
        );
        assert_eq!(Symbol::D2.spec().check(-1e-150), Ok(-1e-150));
    }
}
