//! The numbers of a machine that can be set and varied: its quantities, static friction, and those of its
//! friction law.

use super::modal::Modal;
use crate::numerics::decimal::shortest;
use crate::oscillator::Belt;
use crate::oscillator::belt::{Dimension, FrictionLaw, QUANTITIES, Quantity};

/// A number of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    Quantity(Quantity),
    /// The coefficient of static friction of the belt.
    StaticCoefficient,
    /// The static friction of the guide.
    StaticGuide,
    /// A number of the friction law, by its row in `LAW_NUMBERS`.
    Law(usize),
    /// A coefficient of a polynomial law.
    Coefficient(usize),
    /// The frequency of a vibration mode.
    Frequency,
    /// The mass of a vibration mode.
    ModalMass,
    /// A coefficient of the damping ratio of a vibration mode.
    Ratio(usize),
}

/// Names of the numbers of friction laws, with their dimensions and units.
const LAW_NUMBERS: [(&str, Dimension, &str); 6] = [
    ("mu", Dimension::ONE, ""),
    ("rest", Dimension::ONE, ""),
    ("kinetic", Dimension::ONE, ""),
    ("velocity", Dimension::VELOCITY, "m/s"),
    ("exponent", Dimension::ONE, ""),
    ("viscous", Dimension::new(0, -1, 1), "s/m"),
];

/// Names of the coefficients of a polynomial law.
const COEFFICIENTS: [&str; 6] = ["mu0", "mu1", "mu2", "mu3", "mu4", "mu5"];

/// Names of the coefficients of a damping ratio, in powers of the velocity.
const RATIOS: [&str; 6] = ["ratio0", "ratio1", "ratio2", "ratio3", "ratio4", "ratio5"];

const COEFFICIENT_UNITS: [&str; 6] = ["", "s/m", "s^2/m^2", "s^3/m^3", "s^4/m^4", "s^5/m^5"];

impl Varied {
    /// All of them, in the order in which they are listed.
    pub fn all() -> impl Iterator<Item = Self> {
        let quantities = QUANTITIES.iter().map(|row| Varied::Quantity(row.quantity));
        quantities
            .chain([Varied::StaticCoefficient, Varied::StaticGuide])
            .chain((0..LAW_NUMBERS.len()).map(Varied::Law))
            .chain((0..COEFFICIENTS.len()).map(Varied::Coefficient))
            .chain([Varied::Frequency, Varied::ModalMass])
            .chain((0..RATIOS.len()).map(Varied::Ratio))
    }

    /// The one with this name, compared exactly.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|varied| varied.name() == name)
    }

    /// The names of all of them.
    pub fn names() -> String {
        Self::all().map(Self::name).collect::<Vec<_>>().join(", ")
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Varied::Quantity(quantity) => quantity.spec().name,
            Varied::StaticCoefficient => "mu_s",
            Varied::StaticGuide => "R_static",
            Varied::Law(row) => LAW_NUMBERS[row].0,
            Varied::Coefficient(power) => COEFFICIENTS[power],
            Varied::Frequency => "frequency",
            Varied::ModalMass => "modal_mass",
            Varied::Ratio(power) => RATIOS[power],
        }
    }

    /// Its SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Varied::Quantity(quantity) => quantity.spec().unit,
            Varied::StaticCoefficient => "",
            Varied::StaticGuide => "N",
            Varied::Law(row) => LAW_NUMBERS[row].2,
            Varied::Coefficient(power) | Varied::Ratio(power) => COEFFICIENT_UNITS[power],
            Varied::Frequency => "Hz",
            Varied::ModalMass => "kg",
        }
    }

    pub fn dimension(self) -> Dimension {
        match self {
            Varied::Quantity(quantity) => quantity.spec().dimension,
            Varied::StaticCoefficient => Dimension::ONE,
            Varied::StaticGuide => Dimension::FORCE,
            Varied::Law(row) => LAW_NUMBERS[row].1,
            Varied::Frequency => Dimension::new(0, 0, -1),
            Varied::ModalMass => Quantity::Mass.spec().dimension,
            Varied::Coefficient(power) | Varied::Ratio(power) => {
                let power = i8::try_from(power).unwrap_or(i8::MAX);
                Dimension::ONE.times(Dimension::new(0, -1, 1), power).unwrap_or(Dimension::ONE)
            }
        }
    }

    /// Accepts a value in SI units. Fails with one line that says what is allowed.
    pub fn check(self, value: f64) -> Result<f64, String> {
        let any = (-1e12, 1e12);
        let (min, max) = match self {
            Varied::Quantity(quantity) => {
                return quantity.check(value).map_err(|outside| outside.to_string());
            }
            Varied::StaticCoefficient | Varied::StaticGuide => (0.0, 1e12),
            Varied::Frequency => (1e-9, 1e12),
            Varied::ModalMass => (Quantity::Mass.spec().min, Quantity::Mass.spec().max),
            Varied::Law(3) => (1e-12, 1e12),
            Varied::Law(4) => (0.1, 10.0),
            Varied::Law(_) | Varied::Coefficient(_) | Varied::Ratio(_) => any,
        };
        let (name, unit) = (self.name(), self.unit());
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            let value = shortest(value);
            Err(format!("{name} = {value} {unit} is outside its range {min:?} .. {max:?} {unit}"))
        }
    }

    /// The place of the number in a machine.
    fn place(self, belt: &mut Belt) -> Option<&mut f64> {
        match (self, &mut belt.law) {
            (Varied::Law(0), FrictionLaw::Constant { mu }) => Some(mu),
            (
                Varied::Law(row @ 1..=5),
                FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous },
            ) => Some([rest, kinetic, velocity, exponent, viscous].into_iter().nth(row - 1)?),
            (Varied::Coefficient(power), FrictionLaw::Polynomial { coefficients }) => {
                coefficients.get_mut(power)
            }
            _ => None,
        }
    }

    /// Its value in a machine; static friction that is not given is that of the law at rest, and R.
    pub fn get(self, belt: &Belt) -> Option<f64> {
        match self {
            Varied::Quantity(quantity) => Some(belt.get(quantity)),
            Varied::StaticCoefficient => belt.static_coefficient.or_else(|| belt.law.mu(0.0)),
            Varied::StaticGuide => Some(belt.static_guide.unwrap_or(belt.friction)),
            Varied::Law(_) | Varied::Coefficient(_) => self.place(&mut belt.clone()).copied(),
            Varied::Frequency | Varied::ModalMass | Varied::Ratio(_) => None,
        }
    }

    /// Gives it a value in SI units. Fails with one line, if the machine's law has no such number.
    pub fn set(self, belt: &mut Belt, value: f64) -> Result<(), String> {
        match self {
            Varied::Quantity(quantity) => belt.set(quantity, value),
            Varied::StaticCoefficient => belt.static_coefficient = Some(value),
            Varied::StaticGuide => belt.static_guide = Some(value),
            Varied::Law(_) | Varied::Coefficient(_) => {
                let law = belt.law.name();
                let missing =
                    || format!("the friction law ({law}) of this machine has no {}", self.name());
                *self.place(belt).ok_or_else(missing)? = value;
            }
            Varied::Frequency | Varied::ModalMass | Varied::Ratio(_) => {
                return Err(format!(
                    "a mass on a belt has no {}; a vibration mode has",
                    self.name()
                ));
            }
        }
        Ok(())
    }

    /// Gives it a value in SI units, in a vibration mode. Fails with one line, if a mode has no such number.
    pub fn set_of_mode(self, mode: &mut Modal, value: f64) -> Result<(), String> {
        let powers = mode.damping_ratio.len();
        let place = match self {
            Varied::Frequency => Some(&mut mode.frequency),
            Varied::ModalMass => Some(&mut mode.mass),
            Varied::Quantity(Quantity::Friction) => Some(&mut mode.friction),
            Varied::StaticGuide => {
                mode.static_guide = Some(value);
                return Ok(());
            }
            Varied::Ratio(power) => mode.damping_ratio.get_mut(power),
            _ => None,
        };
        let refused = || {
            let ratios = RATIOS[..powers.min(RATIOS.len())].join(", ");
            let name = self.name();
            format!("this mode has no {name}; it has frequency, modal_mass, R, R_static, {ratios}")
        };
        *place.ok_or_else(refused)? = value;
        Ok(())
    }
}
