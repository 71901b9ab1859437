//! The setting of a machine: the speed of its belt, and the numbers that differ from its file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Machine;
use crate::oscillator::belt::{Outside, QUANTITIES, Quantity};

/// The speed of a belt and the other numbers of a machine that were changed, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Setting {
    /// Speed v0 of the belt.
    pub speed: f64,
    /// The other numbers, in the order of [`QUANTITIES`]; `None` where the file's value holds.
    others: [Option<f64>; QUANTITIES.len() - 1],
}

/// A setting as it is saved: a speed alone, or all changed numbers by name.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Speed(f64),
    Numbers(BTreeMap<String, f64>),
}

impl From<Setting> for Written {
    fn from(setting: Setting) -> Self {
        if !setting.differs() {
            return Written::Speed(setting.speed);
        }
        let numbers = QUANTITIES
            .iter()
            .filter_map(|row| Some((row.name.to_owned(), setting.get(row.quantity)?)));
        Written::Numbers(numbers.collect())
    }
}

impl TryFrom<Written> for Setting {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let numbers = match written {
            Written::Speed(speed) => return Ok(Setting::of_speed(speed)),
            Written::Numbers(numbers) => numbers,
        };
        let speed = numbers.get("v0").ok_or("a machine without the speed v0 of its belt")?;
        let mut setting = Setting::of_speed(*speed);
        for (name, value) in &numbers {
            let quantity = Quantity::named(name).ok_or_else(|| format!("no number {name:?}"))?;
            setting = setting.with(quantity, *value);
        }
        Ok(setting)
    }
}

impl Setting {
    /// The setting with this belt speed and all other numbers from the file.
    pub fn of_speed(speed: f64) -> Self {
        Setting { speed, others: [None; QUANTITIES.len() - 1] }
    }

    /// A number that is set; `None` where the file's value holds.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::BeltSpeed => Some(self.speed),
            other => self.others[other as usize],
        }
    }

    /// This setting with another value of one number.
    pub fn with(mut self, quantity: Quantity, value: f64) -> Self {
        match quantity {
            Quantity::BeltSpeed => self.speed = value,
            other => self.others[other as usize] = Some(value),
        }
        self
    }

    /// Whether numbers other than the speed are set.
    pub fn differs(&self) -> bool {
        self.others.iter().any(Option::is_some)
    }

    /// Checks all numbers against their ranges. Fails with the first one that is outside.
    pub fn checked(self) -> Result<Self, Outside> {
        for row in &QUANTITIES {
            self.get(row.quantity).map_or(Ok(0.0), |value| row.quantity.check(value))?;
        }
        Ok(self)
    }

    /// A machine with these numbers. The static friction of its guide is raised to the sliding friction where
    /// it would be less.
    pub fn on(&self, machine: &Machine) -> Machine {
        let mut set = machine.clone();
        for row in &QUANTITIES {
            if let Some(value) = self.get(row.quantity) {
                set.belt.set(row.quantity, value);
            }
        }
        let moving = set.belt.friction;
        set.belt.static_guide = set.belt.static_guide.map(|at_rest| at_rest.max(moving));
        set
    }
}
