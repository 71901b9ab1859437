//! Numbers with units, as engineers write them: `2 kg`, `800 N/m`, `15 mm`, `40 N s^3/m^3`.
//!
//! A unit is a product and quotient of grams, metres, seconds, newtons and hertz with the usual prefixes, and of in
//! (inch), sec, min, h and kgf. It may contain `^` and parentheses; a blank, `*` or `·` means a product. `N/m s`, which
//! can be read in two ways, is refused. A number without a unit is in SI units.

use crate::numerics::{Interval, powi};

/// Exponents of kilogram, metre and second.
pub type Dimension = [i8; 3];

/// The dimension of a pure number.
const NONE: Dimension = [0; 3];

/// The dimension of a length.
pub const LENGTH: Dimension = [0, 1, 0];

/// The dimension of a time.
pub const TIME: Dimension = [0, 0, 1];

/// The dimension of an impulse, in N s.
pub const IMPULSE: Dimension = [1, 1, -1];

/// The dimension of an SI unit, such as `N s/m`; that of a pure number for the empty text.
pub fn dimension_of(unit: &str) -> Dimension {
    read_unit(unit).map_or(NONE, |(_, dimension)| dimension)
}

/// A number and its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DimensionalNumber {
    /// The number in SI units.
    pub value: f64,
    /// The dimension; `None` where no unit was written.
    pub dimension: Option<Dimension>,
}

impl DimensionalNumber {
    /// The value in this SI unit, in which it is where no unit was written.
    ///
    /// # Errors
    /// What is wrong with the unit that was written, to follow the text of the number.
    pub fn in_unit(&self, unit: &str) -> Result<f64, String> {
        if self.dimension.is_none_or(|written| written == dimension_of(unit)) {
            Ok(self.value)
        } else if unit.is_empty() {
            Err("has a unit; it takes none".to_owned())
        } else {
            Err(format!("has the wrong unit; it takes one such as {unit}"))
        }
    }
}

/// Reads a number with or without a unit, in this SI unit.
///
/// # Errors
/// One line that says what could not be read, or which unit is expected.
pub fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    measured(text)?.in_unit(unit).map_err(|refused| format!("{text:?} {refused}"))
}

/// The value of a unit in SI units; `None` if it is not one of this dimension.
pub fn in_si(unit: &str, dimension: Dimension) -> Option<f64> {
    read_unit(unit).ok().filter(|(_, found)| *found == dimension).map(|(value, _)| value)
}

/// A unit without prefixes, with its value in SI units.
struct UnitRow {
    name: &'static str,
    value: f64,
    dimension: Dimension,
    takes_prefixes: bool,
}

const fn unit(name: &'static str, value: f64, dimension: Dimension) -> UnitRow {
    UnitRow { name, value, dimension, takes_prefixes: true }
}

/// A unit that takes no prefixes.
const fn bare(name: &'static str, value: f64, dimension: Dimension) -> UnitRow {
    UnitRow { takes_prefixes: false, ..unit(name, value, dimension) }
}

const UNITS: [UnitRow; 12] = [
    unit("g", 1e-3, [1, 0, 0]),
    unit("m", 1.0, LENGTH),
    unit("s", 1.0, TIME),
    unit("N", 1.0, [1, 1, -2]),
    unit("Ns", 1.0, IMPULSE),
    unit("Hz", 1.0, [0, 0, -1]),
    // The weight of a kilogram under standard gravity.
    bare("kgf", 9.806_65, [1, 1, -2]),
    bare("in", 0.0254, LENGTH),
    bare("inch", 0.0254, LENGTH),
    bare("sec", 1.0, TIME),
    bare("min", 60.0, TIME),
    bare("h", 3600.0, TIME),
];

/// Prefixes of units, none first.
const PREFIXES: [(&str, f64); 11] = [
    ("", 1.0),
    ("G", 1e9),
    ("M", 1e6),
    ("k", 1e3),
    ("d", 1e-1),
    ("c", 1e-2),
    ("m", 1e-3),
    ("u", 1e-6),
    ("\u{b5}", 1e-6),
    ("\u{3bc}", 1e-6),
    ("n", 1e-9),
];

/// Largest exponent allowed in a unit.
const LARGEST_POWER: i8 = 9;

/// Reads a number with or without a unit.
///
/// # Errors
/// One line that says what could not be read.
pub fn measured(text: &str) -> Result<DimensionalNumber, String> {
    let text = text.trim();
    // Documents have a minus sign of their own.
    let plain = text.replace('\u{2212}', "-");
    let (number, unit) = plain.split_at(number_end(&plain));
    let unit = unit.trim();
    let begins_a_unit = |first: char| first.is_alphabetic() || matches!(first, '1' | '(' | '/');
    let is_sound = unit.is_empty() || unit.starts_with(begins_a_unit);
    let value = number.parse().ok().filter(|_| is_sound);
    let value: f64 = value.ok_or_else(|| format!("{text:?} is not a number"))?;
    let unit = if unit.is_empty() {
        None
    } else {
        Some(read_unit(unit)?)
    };
    let (value, dimension) =
        unit.map_or((value, None), |(factor, dimension)| (value * factor, Some(dimension)));
    if value.is_finite() {
        Ok(DimensionalNumber { value, dimension })
    } else {
        Err(format!("{text:?} is not a finite number"))
    }
}

/// A number and its tolerance, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TolerancedNumber {
    /// The number in the middle.
    pub middle: DimensionalNumber,
    /// Half the difference between both ends.
    pub half_width: f64,
    /// Where the number lies; both ends are rounded outwards where they are not those that were written.
    pub ends: Interval,
}

/// Reads two numbers of a text that have one unit, or none; 0 has that of the other one.
///
/// # Errors
/// One line that says what could not be read, or that the units differ.
pub fn in_one_unit(text: &str, one: &str, other: &str) -> Result<(DimensionalNumber, f64), String> {
    let (mut one, mut other) = (measured(one)?, measured(other)?);
    let written = (one.dimension, other.dimension);
    for (zero, beside) in [(&mut one, written.1), (&mut other, written.0)] {
        if zero.value == 0.0 {
            zero.dimension = zero.dimension.or(beside);
        }
    }
    let unlike = || format!("{text:?}: both numbers take the same unit, or none (SI units)");
    (one.dimension == other.dimension).then_some((one, other.value)).ok_or_else(unlike)
}

/// Reads a number that is exact or has a tolerance: `1 N +- 0.2 N`, `1 N +- 5 %`, `0.8 N .. 1.2 N`, `0 .. 1.2 N`.
///
/// # Errors
/// One line that says what could not be read.
pub fn toleranced(text: &str) -> Result<TolerancedNumber, String> {
    let text = &text.replace('\u{b1}', "+-");
    let around = |middle: DimensionalNumber, half_width: f64| {
        (middle, half_width, Interval::around(middle.value, half_width.max(0.0)))
    };
    let (middle, half_width, ends) = if let Some((value, half)) = text.split_once("+-") {
        let (middle, half_width) = match half.trim().strip_suffix('%') {
            Some(percent) => {
                let middle = measured(value)?;
                (middle, 0.01 * measured(percent)?.value * middle.value.abs())
            }
            None => in_one_unit(text, value, half)?,
        };
        around(middle, half_width)
    } else if let Some((low, high)) = text.split_once("..") {
        let (low, high) = in_one_unit(text, low, high)?;
        let middle = DimensionalNumber { value: 0.5 * low.value + 0.5 * high, ..low };
        (middle, 0.5 * high - 0.5 * low.value, Interval::new(low.value, high))
    } else {
        around(measured(text)?, 0.0)
    };
    if half_width >= 0.0 {
        Ok(TolerancedNumber { middle, half_width, ends })
    } else {
        Err(format!("{text:?}: an uncertainty is 0 or more, and LOW .. HIGH ascend"))
    }
}

/// Length in bytes of the number at the start of a text: of its signs and digits as many as are one number.
fn number_end(text: &str) -> usize {
    let belongs = |char: char| char.is_ascii_digit() || matches!(char, '+' | '-' | '.' | 'e' | 'E');
    let longest = text.find(|char| !belongs(char)).unwrap_or(text.len());
    (1..=longest).rev().find(|end| text[..*end].parse::<f64>().is_ok()).unwrap_or(0)
}

/// What is wrong with a text that is no unit.
const WRONG: &str = "is not a unit; units are made of g, m, s, N, Hz with prefixes, and of in (inch), sec, min, h, kgf, such as N s/m";

/// The value in SI units and the dimension of a unit.
type SizedUnit = (f64, Dimension);

/// Reads a unit.
fn read_unit(text: &str) -> Result<SizedUnit, String> {
    let mut reader = UnitReader { rest: text };
    let unit =
        reader.product().and_then(|unit| reader.rest.is_empty().then_some(unit).ok_or(WRONG));
    unit.map_err(|why| format!("{text:?} {why}"))
}

/// The dimension of a product with a power of another one. Fails beyond all sense.
fn times(mut one: Dimension, by: Dimension, power: i8) -> Result<Dimension, &'static str> {
    for (exponent, other) in one.iter_mut().zip(by) {
        let sum = other.checked_mul(power).and_then(|other| exponent.checked_add(other));
        *exponent = sum.ok_or(WRONG)?;
    }
    Ok(one)
}

/// The unread rest of a unit.
struct UnitReader<'a> {
    rest: &'a str,
}

impl UnitReader<'_> {
    /// Consumes this character and the blanks after it, if it comes next.
    fn take(&mut self, char: char) -> bool {
        let taken = self.rest.strip_prefix(char);
        self.rest = taken.unwrap_or(self.rest).trim_start();
        taken.is_some()
    }

    /// Reads factors up to the end or a closing parenthesis; `/` divides by the next factor only.
    fn product(&mut self) -> Result<SizedUnit, &'static str> {
        let (mut size, mut exponents) = self.factor()?;
        let mut dividing = false;
        while !self.rest.is_empty() && !self.rest.starts_with(')') {
            let divides = self.take('/');
            // A factor after a quotient and a blank could belong to the numerator or to the denominator.
            if !(divides || self.take('*') || self.take('\u{b7}')) && dividing {
                return Err("can be read in two ways; write parentheses, such as N/(m s)");
            }
            dividing = divides;
            let (value, dimension) = self.factor()?;
            let power = if dividing { -1 } else { 1 };
            size *= powi(value, i32::from(power));
            exponents = times(exponents, dimension, power)?;
        }
        Ok((size, exponents))
    }

    /// Reads a unit name, `1` or a parenthesis, with its power.
    fn factor(&mut self) -> Result<SizedUnit, &'static str> {
        let (value, dimension) = if self.take('(') {
            let inner = self.product()?;
            if !self.take(')') {
                return Err(WRONG);
            }
            inner
        } else if self.take('1') {
            (1.0, NONE)
        } else {
            self.name()?
        };
        let power = self.power()?;
        let dimension = times(NONE, dimension, power)?;
        Ok((powi(value, i32::from(power)), dimension))
    }

    fn name(&mut self) -> Result<SizedUnit, &'static str> {
        let end = self.rest.find(|char: char| !char.is_alphabetic()).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        let split = |(prefix, scale): &(&str, f64)| {
            let base = name.strip_prefix(prefix)?;
            let is_it =
                |row: &&UnitRow| row.name == base && (prefix.is_empty() || row.takes_prefixes);
            let UnitRow { value, dimension, .. } = UNITS.iter().find(is_it)?;
            Some((scale * value, *dimension))
        };
        let found = PREFIXES.iter().find_map(split).ok_or(WRONG)?;
        self.rest = rest.trim_start();
        Ok(found)
    }

    /// Reads `^3`, `^-1`, `\u{b2}` or `\u{b3}`; 1 where no power is written.
    fn power(&mut self) -> Result<i8, &'static str> {
        for (char, power) in [('\u{b2}', 2), ('\u{b3}', 3)] {
            if self.take(char) {
                return Ok(power);
            }
        }
        if !self.take('^') {
            return Ok(1);
        }
        let end = self.rest.find(|char: char| !(char.is_ascii_digit() || char == '-'));
        let (digits, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        let power: i8 = digits.parse().map_err(|_| WRONG)?;
        if power.abs() > LARGEST_POWER {
            return Err(WRONG);
        }
        self.rest = rest.trim_start();
        Ok(power)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn units_are_read_as_engineers_write_them() {
        let stiffness = [1, 0, -2];
        let damping = [1, 0, -1];
        let cubic = [1, -2, 1];
        for (text, value, dimension) in [
            ("2 kg", 2.0, [1, 0, 0]),
            ("250g", 0.25, [1, 0, 0]),
            ("800 N/m", 800.0, stiffness),
            ("0.8 kN/m", 800.0, stiffness),
            ("1.2e3 N / mm", 1.2e6, stiffness),
            ("3 N s/m", 3.0, damping),
            ("3 Ns/m", 3.0, damping),
            ("3 kg/s", 3.0, damping),
            ("3 N/(m/s)", 3.0, damping),
            ("3 N*s*m^-1", 3.0, damping),
            ("40 N s^3/m^3", 40.0, cubic),
            ("40 N/(m/s)^3", 40.0, cubic),
            ("40 N\u{b7}s\u{b3}/m\u{b3}", 40.0, cubic),
            ("-15 cm/s", -0.15, [0, 1, -1]),
            ("30 m/min", 0.5, [0, 1, -1]),
            ("3.6 km/h", 1.0, [0, 1, -1]),
            ("2 ms", 0.002, TIME),
            ("2 m s", 2.0, [0, 1, 1]),
            ("5 1/s", 5.0, [0, 0, -1]),
            ("5 Hz", 5.0, [0, 0, -1]),
            ("5 kHz", 5e3, [0, 0, -1]),
            ("5 mHz", 5e-3, [0, 0, -1]),
            ("2 kgf", 19.6133, [1, 1, -2]),
            ("2 kgf/mm", 19613.3, stiffness),
            ("7 \u{b5}m", 7e-6, LENGTH),
            ("7 um", 7e-6, LENGTH),
        ] {
            let found = measured(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(found.dimension, Some(dimension), "{text}");
            assert!((found.value / value - 1.0).abs() < 1e-14, "{text}: {}", found.value);
        }
        assert_eq!(measured(" 2.5e-1 "), Ok(DimensionalNumber { value: 0.25, dimension: None }));
        assert_eq!(measured("\u{2212}2 m"), measured("-2 m"));
    }

    #[test]
    fn what_is_no_unit_is_refused_in_one_line() {
        for text in [
            "",
            "kg",
            "2 kilo",
            "2 N/",
            "2 N/m s",
            "2 (N",
            "2 N)",
            "2 m^",
            "2 m^99",
            "2 mmin",
            "2 kkgf",
            "2 rad/s",
            "1e999 m",
            "nan m",
            "inf",
            "2 /s",
            "--2 m",
            "2 m^1.5",
            "0x10 m",
            "2 ^2",
            "2 m^127 m^127",
            "2,5",
        ] {
            let error = measured(text).expect_err(text);
            assert!(!error.contains('\n') && error.len() > 10, "{text}: {error}");
        }
    }

    #[test]
    fn tolerances_are_read_in_three_forms() {
        for (text, middle, half_width) in [
            ("1 N +- 0.2 N", 1.0, 0.2),
            ("1 N+-200 mN", 1.0, 0.2),
            ("-4 N +- 5 %", -4.0, 0.2),
            ("0 +- 200 mN", 0.0, 0.2),
            ("0.8 N .. 1.2 N", 1.0, 0.2),
            ("0.8..1.2", 1.0, 0.2),
            ("1 N", 1.0, 0.0),
        ] {
            let found = toleranced(text).unwrap();
            let off = [found.middle.value - middle, found.half_width - half_width];
            assert!(off.iter().all(|off| off.abs() < 1e-15), "{text}: {found:?}");
        }
        for text in ["1 N +- 0.2", "1 N +- 1 mm", "1 N +- -1 N", "2 N .. 1 N", "1 +-", "1 +- x %"] {
            let refused = toleranced(text).unwrap_err();
            assert!(!refused.contains('\n'), "{text}: {refused}");
        }
    }

    #[test]
    fn a_wrong_dimension_names_the_right_unit() {
        assert_eq!(quantity("2 mm", "m"), Ok(0.002));
        let refused = quantity("2 mm", "N s").unwrap_err();
        assert_eq!(refused, "\"2 mm\" has the wrong unit; it takes one such as N s");
        assert_eq!(quantity("2", "N s"), Ok(2.0));
        assert!(quantity("2 mm", "").unwrap_err().contains("has a unit; it takes none"));
    }

    proptest! {
        #[test]
        fn no_text_breaks_the_reader(text in "[-+0-9. eENkmgs/^*()\u{b5}\u{b3}]{0,16}") {
            if let Ok(found) = measured(&text) {
                prop_assert!(found.value.is_finite());
            }
        }

        #[test]
        fn every_number_comes_back(value: f64) {
            prop_assume!(value.is_finite());
            prop_assert_eq!(measured(&format!("{value:?} m")).unwrap().value, value);
        }
    }
}
