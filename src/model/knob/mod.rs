//! Numbers that can be set: reading, checking, writing and refusing their values, in one way and in the same words.

mod table;

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error};
use serde::{Serialize, Serializer};

use super::{Belt, DimensionalNumber, Parameters, State, TolerancedNumber, measured, toleranced};
use crate::numerics::{Interval, brief, in_unit, most_similar, shortest};
use table::Access;
pub use table::{Group, KNOBS, Knob, KnobSpec};

/// A value that a number cannot take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeError {
    /// Which number.
    pub knob: Knob,
    /// The value refused, in SI units.
    pub value: f64,
}

impl fmt::Display for RangeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RangeError { knob, value } = *self;
        let KnobSpec { min, max, least, unit, .. } = *knob.spec();
        if (min..=max).contains(&value) {
            let (value, least) = (knob.print(value), in_unit(&brief(least), unit));
            return write!(
                out,
                "{knob} = {value} is too close to 0; allowed: 0, or {least} and more in magnitude"
            );
        }
        write!(out, "{knob} = {} is outside its range {}", knob.print(value), knob.range())?;
        if knob == Knob::BeltSpeed && value == 0.0 {
            // At v0 = 0 both switching lines are one, and the pull of the belt is only bounded.
            write!(
                out,
                "; a belt at rest only brakes, and holds the mass wherever abs(c X) <= R + F mu_s"
            )?;
        }
        Ok(())
    }
}

impl std::error::Error for RangeError {}

impl From<RangeError> for String {
    /// The refusal in one line.
    fn from(refused: RangeError) -> Self {
        refused.to_string()
    }
}

impl Parameters {
    /// One of the parameters; not a number if the knob is none of them.
    #[must_use]
    pub fn value(mut self, knob: Knob) -> f64 {
        self.part(knob).map_or(f64::NAN, |part| *part)
    }
}

impl<N> Parameters<N> {
    /// One of the parameters; `None` if the knob is none of them.
    pub fn part(&mut self, knob: Knob) -> Option<&mut N> {
        match knob {
            Knob::D => Some(&mut self.d),
            Knob::D2 => Some(&mut self.d2),
            Knob::D3 => Some(&mut self.d3),
            Knob::R => Some(&mut self.r),
            _ => None,
        }
    }

    /// The same with another value of one of them; a knob that is none of them changes nothing.
    pub fn with(mut self, knob: Knob, value: N) -> Self {
        if let Some(part) = self.part(knob) {
            *part = value;
        }
        self
    }
}

impl Knob {
    /// The number of these groups with this name, compared exactly.
    ///
    /// # Errors
    /// One line with the number that was probably meant, and the names of all.
    pub fn named(name: &str, groups: &[Group]) -> Result<Self, String> {
        let mut all = KNOBS.iter().filter(|row| groups.contains(&row.group));
        let known: Vec<&str> = all.clone().map(|row| row.name).collect();
        let found = all.find(|row| row.name == name).map(|row| row.knob);
        found.ok_or_else(|| unknown(name, &known))
    }

    /// Accepts a value, in SI units.
    ///
    /// # Errors
    /// [`RangeError`] if it is not a number, outside the range of the table, or closer to 0 than it allows without
    /// being 0.
    pub fn check(self, value: f64) -> Result<f64, RangeError> {
        let KnobSpec { min, max, least, .. } = *self.spec();
        let is_large_enough = value == 0.0 || value.abs() >= least;
        let is_allowed = is_large_enough && (min..=max).contains(&value);
        if is_allowed {
            Ok(value)
        } else {
            Err(RangeError { knob: self, value })
        }
    }

    /// Reads a value with or without its unit: `0.2`, `20 cm/s`.
    ///
    /// # Errors
    /// One line that says what is wrong, and what is allowed.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let read = measured(text).map_err(|why| self.unread(text, why))?;
        self.accept(text, read)
    }

    /// Reads a value that may have a tolerance: `1 N +- 0.2 N`, `0.8 N .. 1.2 N`, `0.1+-5 %`.
    ///
    /// # Errors
    /// One line that says what is wrong, and what is allowed.
    pub fn parse_toleranced(self, text: &str) -> Result<TolerancedNumber, String> {
        let read = toleranced(text).map_err(|why| self.unread(text, why))?;
        let value = self.accept(text, read.middle)?;
        let middle = DimensionalNumber { value, ..read.middle };
        if read.half_width == 0.0 {
            return Ok(TolerancedNumber { middle, ends: Interval::point(value), ..read });
        }
        for end in [value - read.half_width, value + read.half_width] {
            self.check(end)?;
        }
        let KnobSpec { min, max, .. } = *self.spec();
        let ends = Interval::new(read.ends.lower().max(min), read.ends.upper().min(max));
        for end in [ends.lower(), ends.upper()] {
            self.check(end)?;
        }
        Ok(TolerancedNumber { middle, ends, ..read })
    }

    /// A measured value in the unit and the range of this number; zero has one sign.
    fn accept(self, text: &str, read: DimensionalNumber) -> Result<f64, String> {
        let value = read.in_unit(self.spec().unit);
        let value = value.map_err(|refused| format!("{self} = {} {refused}", text.trim()))?;
        Ok(self.check(value + 0.0)?)
    }

    fn unread(self, text: &str, why: String) -> String {
        // Where there is no unit, letters behind a number are no attempt at one.
        let text = text.trim();
        let plain = self.spec().unit.is_empty() && !text.contains("+-") && !text.contains("..");
        let why = if plain && text.parse::<f64>().is_err() {
            format!("{text:?} is not a number")
        } else {
            why
        };
        format!("{why}; {self} takes {}", self.range())
    }

    /// A value with its unit, such that it can be typed in again.
    #[must_use]
    pub fn print(self, value: f64) -> String {
        in_unit(&shortest(value), self.spec().unit)
    }

    /// What it can be: `0 .. 1e12 N`.
    #[must_use]
    pub fn range(self) -> String {
        let KnobSpec { min, max, unit, .. } = *self.spec();
        in_unit(&format!("{} .. {}", brief(min), brief(max)), unit)
    }

    /// That it can be stepped no further.
    #[must_use]
    pub fn at_end(self, value: f64) -> String {
        let KnobSpec { symbol, max, unit, .. } = *self.spec();
        let end = if value < max { "minimum" } else { "maximum" };
        format!("{symbol} is at its {end}, {}", in_unit(&brief(value), unit))
    }

    /// The value where nothing is said; 0 where something must be.
    #[must_use]
    pub fn usual(self) -> f64 {
        self.spec().default.unwrap_or(0.0)
    }

    /// Reads a number of a mass on a belt; `None` if it has none. Static friction that is not given is that of the law
    /// at rest, and R.
    #[must_use]
    pub fn of_belt(self, belt: &Belt) -> Option<f64> {
        (self.spec().belt?.get)(belt)
    }

    /// Writes a number of a mass on a belt, in SI units.
    ///
    /// # Errors
    /// One line if it has no such number.
    pub fn set_in_belt(self, belt: &mut Belt, value: f64) -> Result<(), String> {
        self.write(belt, |row| row.belt, value)
    }

    /// Writes a number of what has it at this place, in SI units. Fails with one line that names the numbers that it has.
    pub(super) fn write<T>(
        self,
        it: &mut T,
        at: fn(&KnobSpec) -> Option<&'static Access<T>>,
        value: f64,
    ) -> Result<(), String> {
        if let Some(place) = at(self.spec()).and_then(|access| (access.place)(it)) {
            *place = value;
            return Ok(());
        }
        let has = |row: &&KnobSpec| at(row).and_then(|access| (access.get)(it)).is_some();
        let all: Vec<_> = KNOBS.iter().filter(has).map(|row| row.name).collect();
        Err(format!("no {self} here; there are {}", all.join(", ")))
    }
}

/// That there is no such number, and which was probably meant.
pub fn unknown(name: &str, known: &[&str]) -> String {
    // A single letter resembles too much.
    let alike = |meant: &&&str| name.chars().count() > 1 || name.eq_ignore_ascii_case(meant);
    let meant = most_similar(name, known).filter(alike);
    let meant = meant.map_or_else(String::new, |meant| format!("did you mean {meant}? "));
    format!("no number {name:?}; {meant}there are {}", known.join(", "))
}

impl fmt::Display for Knob {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.spec().name)
    }
}

impl Serialize for Knob {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.spec().name)
    }
}

impl<'de> Deserialize<'de> for Knob {
    /// Reads the name of a number of a motion, which are those that scenes and sessions name.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Knob::named(&name, &[Group::Motion]).map_err(D::Error::custom)
    }
}

impl Default for Parameters {
    fn default() -> Self {
        Knob::PARAMETERS.map(Knob::usual).into()
    }
}

impl Default for State {
    fn default() -> Self {
        let [.., q, v] = Knob::MOTION.map(Knob::usual);
        State { q, v }
    }
}

#[cfg(test)]
mod tests;
