//! A number that goes through values, evenly or by equal ratios.

use std::fmt;

use crate::model::{Group, Knob, measured};
use crate::numerics::{log10, pow, real};

/// How the values of a [`Sweep`] are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// By equal differences.
    Even,
    /// By equal ratios.
    Logarithmic,
}

/// A parameter and the values through which it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Which parameter.
    pub symbol: Knob,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// How many values.
    pub count: usize,
    /// How they are spaced.
    pub spacing: Spacing,
}

/// Fewest and most values of a [`Sweep`].
pub const COUNTS: std::ops::RangeInclusive<usize> = 2..=1_000_000;

/// How a sweep is written.
const FORM: &str = "expected NAME=FROM:TO:COUNT, such as D=-0.95:0:400, or NAME=log:FROM:TO:COUNT";

impl Sweep {
    /// A sweep that makes sense.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn new(
        symbol: Knob,
        (from, to): (f64, f64),
        count: usize,
        spacing: Spacing,
    ) -> Result<Self, String> {
        for value in [from, to] {
            symbol.check(value).map_err(|refused| refused.to_string())?;
        }
        if from == to {
            return Err(format!("{symbol}: FROM and TO are both {from:?}"));
        }
        if !COUNTS.contains(&count) {
            return Err(format!("COUNT = {count} is not a whole number in 2 .. 1000000"));
        }
        let one_sign = (from > 0.0 && to > 0.0) || (from < 0.0 && to < 0.0);
        if spacing == Spacing::Logarithmic && !one_sign {
            return Err(format!(
                "{symbol}: log from {from:?} to {to:?}; both must have one sign and not be 0"
            ));
        }
        Ok(Sweep { symbol, from, to, count, spacing })
    }

    /// Reads `NAME=FROM:TO:COUNT` or `NAME=log:FROM:TO:COUNT`, with a number of these groups; both ends with a unit
    /// or none.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn read(text: &str, groups: &[Group]) -> Result<Self, String> {
        Sweep::read_as(FORM, text, groups)
    }

    /// The same of what was given in another form, which a refusal names.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_as(form: &str, text: &str, groups: &[Group]) -> Result<Self, String> {
        let (name, range) = text.split_once('=').ok_or(form)?;
        let symbol = Knob::named(name.trim(), groups)?;
        let (spacing, range) = match range.trim().strip_prefix("log:") {
            Some(range) => (Spacing::Logarithmic, range),
            None => (Spacing::Even, range),
        };
        let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
            return Err(form.to_owned());
        };
        let whole = || format!("COUNT = {count} is not a whole number in 2 .. 1000000");
        let count = count.parse().map_err(|_| whole())?;
        Sweep::new(symbol, ends(symbol, range, [from, to])?, count, spacing)
    }

    /// The value this far, from 0 to 1, on the way from the first to the last.
    pub fn at(&self, part: f64) -> f64 {
        self.between(part, 1.0 - part)
    }

    /// Value number `index`.
    pub fn value(&self, index: usize) -> f64 {
        let last = self.count - 1;
        let value = self.between(real(index), real(last.saturating_sub(index)));
        let rounding = 4.0 * f64::EPSILON * self.from.abs().max(self.to.abs());
        match self.spacing {
            // Where the ends have few digits the values between have few: -0.4, not -0.39999999999999997.
            Spacing::Even if (1..last).contains(&index) => few_digits(value, rounding),
            _ => value,
        }
    }

    /// The value that divides the way in this ratio; the first and the last exactly.
    fn between(&self, done: f64, left: f64) -> f64 {
        if left <= 0.0 || done <= 0.0 {
            return if left <= 0.0 { self.to } else { self.from };
        }
        let mean = |from: f64, to: f64| (from * left + to * done) / (left + done);
        match self.spacing {
            Spacing::Even => mean(self.from, self.to),
            Spacing::Logarithmic => {
                let exponent = mean(log10(self.from.abs()), log10(self.to.abs()));
                pow(10.0, exponent).copysign(self.from)
            }
        }
    }
}

/// The number of at most fifteen digits that is within this distance of a value, or the value where there is none.
pub fn few_digits(value: f64, within: f64) -> f64 {
    let short = format!("{value:.14e}").parse().unwrap_or(value);
    if (short - value).abs() <= within {
        short
    } else {
        value
    }
}

impl fmt::Display for Sweep {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sweep { symbol, from, to, count, spacing } = self;
        let log = if *spacing == Spacing::Logarithmic { "log:" } else { "" };
        write!(out, "{symbol}={log}{from:?}:{to:?}:{count}")
    }
}

/// Both ends of a range of a number, with a unit each or none; `range` is the text that they were read from.
///
/// # Errors
/// One line that says what is wrong.
pub fn ends(knob: Knob, range: &str, [from, to]: [&str; 2]) -> Result<(f64, f64), String> {
    let ends = (knob.parse(from)?, knob.parse(to)?);
    let has_unit = |text: &str| measured(text).is_ok_and(|read| read.dimension.is_some());
    if has_unit(from) != has_unit(to) {
        return Err(format!("{range:?}: FROM and TO both take a unit, or none (SI units)"));
    }
    Ok(ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(text: &str) -> Result<Sweep, String> {
        Sweep::read(text, &[Group::Motion])
    }

    #[test]
    fn a_sweep_keeps_its_direction_its_ends_and_round_numbers() {
        let down = sweep("D=0:-0.5:6").unwrap();
        let values: Vec<f64> = (0..6).map(|index| down.value(index)).collect();
        assert_eq!(values, [0.0, -0.1, -0.2, -0.3, -0.4, -0.5]);
        let up = sweep("D=-0.6:-0.1:6").unwrap();
        let values: Vec<f64> = (0..6).map(|index| up.value(index)).collect();
        assert_eq!(values, [-0.6, -0.5, -0.4, -0.3, -0.2, -0.1]);
        let decades = sweep("r=log:1e-3:1:4").unwrap();
        let values: Vec<f64> = (0..4).map(|index| decades.value(index)).collect();
        assert_eq!(values, [0.001, 0.01, 0.1, 1.0]);
        let negative = sweep("D=log:-0.01:-1:3").unwrap();
        assert_eq!(negative.value(1), -0.1);
        for text in ["D=0.0:-0.5:6", "r=log:0.001:1.0:4"] {
            assert_eq!(sweep(text).unwrap().to_string(), text);
        }
    }

    #[test]
    fn sweeps_that_make_no_sense_are_refused_in_one_line_with_what_is_allowed() {
        for (text, expected) in [
            ("D", "NAME=FROM:TO:COUNT"),
            ("D=0:1", "NAME=FROM:TO:COUNT"),
            ("x=0:1:3", "no number \"x\"; there are D, D2, D3, r, q0, v0"),
            ("D=a:1:3", "\"a\" is not a number; D takes -1e6 .. 1e6"),
            ("D=NaN:1:3", "\"NaN\" is not a number; D takes"),
            ("r=-1:1:3", "r = -1 is outside its range 0 .. 1e150"),
            ("D=0:0:3", "both 0.0"),
            ("D=0:1:1", "COUNT = 1 is not a whole number in 2 .. 1000000"),
            ("D=0:1:-4", "COUNT = -4 is not"),
            ("D=log:0:1:3", "one sign"),
            ("D=log:-1:1:3", "one sign"),
        ] {
            let refused = sweep(text).unwrap_err();
            assert!(refused.contains(expected) && !refused.contains('\n'), "{text}: {refused}");
        }
    }
}
