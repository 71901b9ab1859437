//! The setting of a machine: the speed of its belt, and the numbers that differ from its file, those of its friction
//! law included.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Machine, ScaledMachine};
use crate::model::{Group, Knob, Model, OutOfRange};

/// The speed of a belt and the other numbers of a machine that were changed, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Setting(BTreeMap<Knob, f64>);

/// A setting as it is saved: a speed alone, or all changed numbers by name.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Speed(f64),
    Numbers(BTreeMap<String, f64>),
}

impl From<Setting> for Written {
    fn from(setting: Setting) -> Self {
        let numbers = setting.0;
        match numbers.get(&Knob::BeltSpeed) {
            Some(speed) if numbers.len() == 1 => Written::Speed(*speed),
            _ => {
                let named = numbers.into_iter().map(|(knob, value)| (knob.to_string(), value));
                Written::Numbers(named.collect())
            }
        }
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
            setting = setting.with(Knob::named(name, &[Group::Machine, Group::Law])?, *value);
        }
        Ok(setting)
    }
}

impl Setting {
    /// The setting with this belt speed and all other numbers from the file.
    pub fn of_speed(speed: f64) -> Self {
        Setting(BTreeMap::from([(Knob::BeltSpeed, speed)]))
    }

    /// A number that is set; `None` where the file's value holds.
    pub fn get(&self, knob: Knob) -> Option<f64> {
        self.0.get(&knob).copied()
    }

    /// This setting with another value of one number.
    pub fn with(mut self, knob: Knob, value: f64) -> Self {
        self.0.insert(knob, value);
        self
    }

    /// Checks all numbers against their ranges. Fails with the first one that is outside.
    pub fn checked(&self) -> Result<(), OutOfRange> {
        self.0.iter().try_for_each(|(knob, value)| knob.check(*value).map(drop))
    }

    /// A machine with these numbers. The static friction of its guide, where it is not set, is raised to the sliding
    /// friction where it would be less. Fails with one line if the machine lacks a number, or is none with it.
    pub fn on(&self, machine: &Machine) -> Result<ScaledMachine, String> {
        let mut set = machine.clone();
        for (knob, value) in &self.0 {
            knob.set_in_belt(&mut set.belt, *value)?;
        }
        if self.get(Knob::StaticGuide).is_none() {
            let moving = set.belt.friction;
            set.belt.static_guide = set.belt.static_guide.map(|at_rest| at_rest.max(moving));
        }
        Model::new(&set.belt).map_err(|refused| refused.to_string())?;
        ScaledMachine::new(set).map_err(|refused| refused.to_string())
    }
}
