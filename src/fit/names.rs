//! The names of the numbers that a fit estimates.

use serde::{Deserialize, Serialize};

use super::observation::{self, UNKNOWNS};
use crate::model::{KNOBS, Knob, unknown};

/// One row of [`NAMES`].
#[derive(Clone, Copy, Debug)]
pub struct NameSpec {
    /// The number.
    pub knob: Knob,
    /// The name on the command line and in documents.
    pub name: &'static str,
    /// Its place among the unknowns.
    pub place: usize,
    /// Power of the unit of length in its unit.
    pub length: i32,
    /// Power of the second in its unit.
    pub time: i32,
}

impl NameSpec {
    /// Its unit: powers of the record's unit of length and of the second.
    pub fn unit(&self, length: &str) -> String {
        let length = if length.is_empty() { "unit" } else { length };
        let power = |name: &str, power: i32| match power {
            0 => String::new(),
            1 => name.to_owned(),
            -1 => format!("1/{name}"),
            _ => format!("1/{name}^{}", -power),
        };
        power(length, self.length) + &power("s", self.time)
    }
}

const fn row(knob: Knob, place: usize, length: i32, time: i32) -> NameSpec {
    NameSpec { knob, name: KNOBS[knob as usize].name, place, length, time }
}

/// The numbers that are estimated from a record, except those of its start.
pub const NAMES: [NameSpec; 6] = [
    row(Knob::Omega0, observation::OMEGA0, 0, -1),
    row(Knob::Offset, observation::OFFSET, 1, 0),
    row(Knob::D, observation::D, 0, 0),
    row(Knob::D2, observation::D2, -1, 0),
    row(Knob::D3, observation::D3, -2, 0),
    row(Knob::R, observation::R, 1, 0),
];

/// The row with this name.
pub fn named(name: &str) -> Option<&'static NameSpec> {
    NAMES.iter().find(|row| row.name == name)
}

/// The rows with these names, separated by commas.
///
/// # Errors
/// One line that lists the known names.
pub fn listed(text: &str) -> Result<Vec<&'static NameSpec>, String> {
    text.split(',').map(known).collect()
}

fn known(text: &str) -> Result<&'static NameSpec, String> {
    named(text.trim()).ok_or_else(|| unknown(text, &NAMES.map(|row| row.name)))
}

/// A number to be held and its value, from `NAME=VALUE`.
///
/// # Errors
/// One line that says what is allowed.
pub fn assigned(text: &str) -> Result<(&'static NameSpec, f64), String> {
    let (key, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as D3=0")?;
    let row = known(key)?;
    Ok((row, row.knob.parse(value)?))
}

/// Which numbers a fit estimates, and which it holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SavedChoice", into = "SavedChoice")]
pub struct Choice {
    /// Numbers to estimate; `None` for all that are not held.
    pub free: Option<Vec<&'static NameSpec>>,
    /// Numbers to hold, with their values.
    pub held: Vec<(&'static NameSpec, f64)>,
}

/// A [`Choice`] by names, as it is saved.
#[derive(Serialize, Deserialize)]
struct SavedChoice {
    free: Option<Vec<String>>,
    held: Vec<(String, f64)>,
}

impl From<Choice> for SavedChoice {
    fn from(Choice { free, held }: Choice) -> Self {
        let name = |row: &NameSpec| row.name.to_owned();
        SavedChoice {
            free: free.map(|rows| rows.into_iter().map(name).collect()),
            held: held.into_iter().map(|(row, value)| (name(row), value)).collect(),
        }
    }
}

impl TryFrom<SavedChoice> for Choice {
    type Error = String;

    fn try_from(SavedChoice { free, held }: SavedChoice) -> Result<Self, String> {
        let free = free.map(|names| names.iter().map(|name| known(name)).collect()).transpose()?;
        let held = held.iter().map(|(name, value)| assigned(&format!("{name}={value}")));
        Ok(Choice { free, held: held.collect::<Result<_, _>>()? })
    }
}

impl PartialEq for NameSpec {
    fn eq(&self, other: &Self) -> bool {
        self.place == other.place
    }
}

impl Choice {
    /// The value at which a number is held; `None` if it is free. Damping and friction that are neither free
    /// nor set are held at zero. `omega0` and the offset are free unless set, since every record depends on
    /// them.
    pub fn held(&self, row: &NameSpec) -> Option<f64> {
        if let Some((_, value)) = self.held.iter().find(|(held, _)| *held == row) {
            return Some(*value);
        }
        let needed = row.place < observation::D;
        (!needed && !self.is_wanted(row)).then_some(0.0)
    }

    /// Whether an estimate of this number is asked for.
    pub fn is_wanted(&self, row: &NameSpec) -> bool {
        let held = self.held.iter().any(|(held, _)| *held == row);
        !held && self.free.as_ref().is_none_or(|free| free.contains(&row))
    }

    /// The values at which unknowns are held; `None` for the free ones.
    pub fn unknowns(&self) -> [Option<f64>; UNKNOWNS] {
        let mut held = [None; UNKNOWNS];
        (held[observation::SLOPE], held[observation::BEND]) = (Some(0.0), Some(0.0));
        for row in &NAMES {
            held[row.place] = self.held(row);
        }
        held
    }
}
