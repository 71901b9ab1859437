//! The setting of a machine: the speed of its belt, and the numbers that differ from its file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Machine;
use crate::oscillator::{Group, Knob, OutOfRange};

/// The speed of a belt and the other numbers of a machine that were changed, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Setting {
    /// Speed v0 of the belt.
    pub speed: f64,
    /// The other numbers, in the order of the table; `None` where the file's value holds.
    others: [Option<f64>; Group::Machine.count()],
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
        let set = |knob: Knob| Some((knob.to_string(), setting.get(knob)?));
        Written::Numbers(Group::Machine.knobs().filter_map(set).collect())
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
            setting = setting.with(Knob::named(name, &[Group::Machine])?, *value);
        }
        Ok(setting)
    }
}

impl Setting {
    /// The setting with this belt speed and all other numbers from the file.
    pub fn of_speed(speed: f64) -> Self {
        Setting { speed, others: [None; Group::Machine.count()] }
    }

    /// A number that is set; `None` where the file's value holds.
    pub fn get(&self, knob: Knob) -> Option<f64> {
        match knob {
            Knob::BeltSpeed => Some(self.speed),
            other => self.others[other.place()],
        }
    }

    /// This setting with another value of one number.
    pub fn with(mut self, knob: Knob, value: f64) -> Self {
        match knob {
            Knob::BeltSpeed => self.speed = value,
            other => self.others[other.place()] = Some(value),
        }
        self
    }

    /// Whether numbers other than the speed are set.
    pub fn differs(&self) -> bool {
        self.others.iter().any(Option::is_some)
    }

    /// Checks all numbers against their ranges. Fails with the first one that is outside.
    pub fn checked(self) -> Result<Self, OutOfRange> {
        for knob in Group::Machine.knobs() {
            self.get(knob).map_or(Ok(0.0), |value| knob.check(value))?;
        }
        Ok(self)
    }

    /// A machine with these numbers. The static friction of its guide is raised to the sliding friction where
    /// it would be less.
    pub fn on(&self, machine: &Machine) -> Machine {
        let mut set = machine.clone();
        for knob in Group::Machine.knobs() {
            if let Some(value) = self.get(knob) {
                // A belt has all numbers of this group.
                let _ = knob.set_in_belt(&mut set.belt, value);
            }
        }
        let moving = set.belt.friction;
        set.belt.static_guide = set.belt.static_guide.map(|at_rest| at_rest.max(moving));
        set
    }
}
