//! The physical quantities of a mass on a belt, and the dimensions in which they are measured.
//!
//! [`QUANTITIES`] is the one table of them: machine files, the command line, sweeps, the screen and error
//! messages read names, meanings, units and ranges from it.

use std::fmt;

use serde::Serialize;

use crate::numerics::decimal::shortest;

/// Exponents of kilogram, metre and second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub kg: i8,
    /// Exponent of the metre.
    pub m: i8,
    /// Exponent of the second.
    pub s: i8,
}

impl Dimension {
    /// A pure number.
    pub const ONE: Self = Self::new(0, 0, 0);
    /// A length.
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// A time.
    pub const TIME: Self = Self::new(0, 0, 1);
    /// A velocity.
    pub const VELOCITY: Self = Self::new(0, 1, -1);
    /// An impulse (momentum), in N s.
    pub const IMPULSE: Self = Self::new(1, 1, -1);
    /// A force, in N.
    pub const FORCE: Self = Self::new(1, 1, -2);

    /// From the exponents.
    #[must_use]
    pub const fn new(kg: i8, m: i8, s: i8) -> Self {
        Dimension { kg, m, s }
    }

    /// The dimension of a product with a power of another one; `None` beyond all sense.
    #[must_use]
    pub fn times(self, other: Self, power: i8) -> Option<Self> {
        let sum = |own: i8, other: i8| own.checked_add(other.checked_mul(power)?);
        Some(Dimension {
            kg: sum(self.kg, other.kg)?,
            m: sum(self.m, other.m)?,
            s: sum(self.s, other.s)?,
        })
    }
}

/// A physical quantity of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Quantity {
    /// Mass.
    #[serde(rename = "m")]
    Mass,
    /// Stiffness of the spring.
    #[serde(rename = "c")]
    Stiffness,
    /// Linear damping.
    #[serde(rename = "d1")]
    Damping,
    /// Cubic damping.
    #[serde(rename = "d3")]
    CubicDamping,
    /// Force that presses the mass onto the belt.
    #[serde(rename = "F")]
    NormalForce,
    /// Intensity of the friction element.
    #[serde(rename = "R")]
    Friction,
    /// Speed of the belt.
    #[serde(rename = "v0")]
    BeltSpeed,
}

/// One row of [`QUANTITIES`].
#[derive(Clone, Copy, Debug)]
pub struct QuantitySpec {
    /// Which quantity.
    pub quantity: Quantity,
    /// The name in files and on the command line.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// Smallest allowed value, in SI units.
    pub min: f64,
    /// Largest allowed value, in SI units.
    pub max: f64,
    /// The value where a file says nothing; `None` where it must.
    pub default: Option<f64>,
}

/// Smallest positive value, in SI units, that is still taken for a quantity of a machine.
const LEAST: f64 = 1e-12;

/// Largest value.
const MOST: f64 = 1e12;

/// The quantities, in the order in which they are shown.
pub const QUANTITIES: [QuantitySpec; 7] = [
    QuantitySpec {
        quantity: Quantity::Mass,
        name: "m",
        meaning: "mass",
        unit: "kg",
        dimension: Dimension::new(1, 0, 0),
        min: LEAST,
        max: MOST,
        default: None,
    },
    QuantitySpec {
        quantity: Quantity::Stiffness,
        name: "c",
        meaning: "stiffness of the spring",
        unit: "N/m",
        dimension: Dimension::new(1, 0, -2),
        min: LEAST,
        max: MOST,
        default: None,
    },
    QuantitySpec {
        quantity: Quantity::Damping,
        name: "d1",
        meaning: "linear damping",
        unit: "N s/m",
        dimension: Dimension::new(1, 0, -1),
        min: -MOST,
        max: MOST,
        default: Some(0.0),
    },
    QuantitySpec {
        quantity: Quantity::CubicDamping,
        name: "d3",
        meaning: "cubic damping",
        unit: "N s^3/m^3",
        dimension: Dimension::new(1, -2, 1),
        min: -MOST,
        max: MOST,
        default: Some(0.0),
    },
    QuantitySpec {
        quantity: Quantity::NormalForce,
        name: "F",
        meaning: "force onto the belt",
        unit: "N",
        dimension: Dimension::FORCE,
        min: LEAST,
        max: MOST,
        default: None,
    },
    QuantitySpec {
        quantity: Quantity::Friction,
        name: "R",
        meaning: "friction element",
        unit: "N",
        dimension: Dimension::FORCE,
        min: 0.0,
        max: MOST,
        default: Some(0.0),
    },
    QuantitySpec {
        quantity: Quantity::BeltSpeed,
        name: "v0",
        meaning: "belt speed",
        unit: "m/s",
        dimension: Dimension::VELOCITY,
        min: LEAST,
        max: MOST,
        default: None,
    },
];

impl Quantity {
    /// The row of [`QUANTITIES`] that describes this quantity.
    #[must_use]
    pub fn spec(self) -> &'static QuantitySpec {
        &QUANTITIES[self as usize]
    }

    /// The quantity with this name, compared exactly.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        QUANTITIES.iter().find(|row| row.name == name).map(|row| row.quantity)
    }

    /// Accepts a value in SI units.
    ///
    /// # Errors
    /// [`Outside`] if it is not a number or outside of the range of the table.
    pub fn check(self, value: f64) -> Result<f64, Outside> {
        let QuantitySpec { min, max, .. } = *self.spec();
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            Err(Outside { quantity: self, value })
        }
    }
}

/// A value that a quantity cannot take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// The quantity.
    pub quantity: Quantity,
    /// The value refused, in SI units.
    pub value: f64,
}

impl fmt::Display for Outside {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let QuantitySpec { name, unit, min, max, .. } = self.quantity.spec();
        let value = shortest(self.value);
        write!(out, "{name} = {value} {unit} is outside its range {min:?} .. {max:?} {unit}")?;
        if self.quantity == Quantity::BeltSpeed && self.value == 0.0 {
            // At v0 = 0 both switching lines are one, and the pull of the belt is only bounded.
            write!(
                out,
                "; a belt at rest only brakes, and holds the mass wherever abs(c X) <= R + F mu_s"
            )?;
        }
        Ok(())
    }
}

impl std::error::Error for Outside {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_stands_at_its_own_row_under_its_name() {
        for row in &QUANTITIES {
            assert_eq!(row.quantity.spec().name, row.name);
            assert_eq!(Quantity::named(row.name), Some(row.quantity));
            assert_eq!(serde_json::to_value(row.quantity).unwrap(), row.name);
            assert!(row.default.is_none_or(|value| row.quantity.check(value) == Ok(value)));
        }
    }

    #[test]
    fn a_value_out_of_range_is_refused_with_the_range() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refused = Quantity::Mass.check(value).unwrap_err().to_string();
            assert!(
                refused.contains("kg is outside its range 1e-12 .. 1000000000000.0 kg"),
                "{refused}"
            );
        }
        // Nobody counts three hundred zeros.
        let refused = Quantity::Mass.check(1e300).unwrap_err().to_string();
        assert!(refused.starts_with("m = 1e300 kg is"), "{refused}");
    }
}
