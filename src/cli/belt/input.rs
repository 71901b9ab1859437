//! Reading the options of `hopfscope belt`: values with units, ranges, windows.

use crate::cli::input::{sides, stepped};
use crate::machine::varied::Varied;
use crate::oscillator::belt::Dimension;
use crate::scene::machine::file::FARTHEST_START;
use crate::scene::machine::unit::{Measured, Toleranced, measured, toleranced};
use crate::study::design::Kick;

/// What `--set` can set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Name {
    /// A number of the machine.
    Number(Varied),
    /// Displacement at the start, in m.
    Displacement,
    /// Velocity at the start, in m/s.
    Velocity,
}

/// A number and the values that it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeInUnits {
    pub varied: Varied,
    /// The first and the last value, in SI units.
    pub ends: (f64, f64),
    /// Number of values.
    pub count: usize,
}

/// The start of a motion; what is not given is left as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartOverride {
    /// Displacement, in m.
    pub x: Option<f64>,
    /// Velocity, in m/s.
    pub v: Option<f64>,
}

/// A window of the phase plane, in m and m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowInUnits {
    /// Displacements, in m.
    pub x: (f64, f64),
    /// Velocities, in m/s.
    pub v: (f64, f64),
}

/// A value with a unit converted to SI units and checked against the range of the number.
fn value_of(varied: Varied, read: &Measured) -> Result<f64, String> {
    varied.check(read.as_a(varied.dimension(), varied.unit())?)
}

/// `NAME=VALUE`, the value with or without a unit.
pub fn assignment(text: &str) -> Result<(Name, Toleranced), String> {
    let form = "expected NAME=VALUE, such as \"v0=0.2 m/s\"";
    let (name, value) = text.split_once('=').ok_or(form)?;
    let read = toleranced(value)?;
    if let Some(varied) = Varied::named(name.trim()) {
        value_of(varied, &read.middle).map_err(|error| format!("{name}: {error}"))?;
        return Ok((Name::Number(varied), read));
    }
    let (name, dimension, unit) = match name.trim() {
        "x" => (Name::Displacement, Dimension::LENGTH, "m"),
        "v" => (Name::Velocity, Dimension::VELOCITY, "m/s"),
        other => {
            let names = Varied::names();
            return Err(format!("there is no quantity {other:?}; there are {names}, x, v"));
        }
    };
    let value = read.middle.as_a(dimension, unit)?;
    if read.half_width > 0.0 {
        Err(format!("{text:?}: a start has no tolerance"))
    } else if value.abs() <= FARTHEST_START {
        Ok((name, read))
    } else {
        Err(format!(
            "{text:?} is outside its range; allowed: {:?} .. {FARTHEST_START:?}",
            -FARTHEST_START
        ))
    }
}

/// A force, 0 or more.
pub fn disturbance(text: &str) -> Result<f64, String> {
    let force = measured(text)?.as_a(Dimension::FORCE, "N")?;
    if force >= 0.0 { Ok(force) } else { Err(format!("{text:?} is negative")) }
}

/// `x=..,v=..`, or one of them.
pub fn start(text: &str) -> Result<StartOverride, String> {
    let mut start = StartOverride::default();
    for part in text.split(',') {
        match assignment(part)? {
            (Name::Displacement, x) => start.x = Some(x.middle.value),
            (Name::Velocity, v) => start.v = Some(v.middle.value),
            (Name::Number(_), _) => {
                return Err(format!("{part:?} is not a start; expected x=.. and v=.."));
            }
        }
    }
    Ok(start)
}

/// `XMIN:XMAX,VMIN:VMAX`.
pub fn window(text: &str) -> Result<WindowInUnits, String> {
    let form =
        format!("{text:?} is not a window; expected XMIN:XMAX,VMIN:VMAX, such as -2mm:2mm,0:1");
    let read = |dimension, unit| {
        move |text: &str| measured(text).and_then(|read| read.as_a(dimension, unit))
    };
    let [x, v] =
        sides(text, &form, [&read(Dimension::LENGTH, "m"), &read(Dimension::VELOCITY, "m/s")])?;
    Ok(WindowInUnits { x, v })
}

/// `NAME=FROM:TO:COUNT`.
pub fn range(text: &str) -> Result<RangeInUnits, String> {
    /// Maximum number of points of a sweep.
    const MOST: usize = 100_000;
    let form = "expected NAME=FROM:TO:COUNT, such as \"v0=0.1 m/s:0.5 m/s:21\"";
    let (name, range) = text.split_once('=').ok_or(form)?;
    let unknown = || format!("there is no quantity {name:?}; there are {}", Varied::names());
    let varied = Varied::named(name.trim()).ok_or_else(unknown)?;
    let (ends, count) = stepped(range, form, MOST, |from, to| {
        let (from, to) = (measured(from)?, measured(to)?);
        if from.dimension.is_some() != to.dimension.is_some() {
            return Err(format!("{range:?}: FROM and TO both take a unit, or none (SI units)"));
        }
        Ok((value_of(varied, &from)?, value_of(varied, &to)?))
    })?;
    Ok(RangeInUnits { varied, ends, count })
}

/// A margin: the unit decides whether it is a displacement or an impulse.
pub fn margin(text: &str) -> Result<(Kick, f64), String> {
    let read = measured(text)?;
    let kick = match read.dimension {
        Some(Dimension::LENGTH) => Kick::Displacement,
        Some(Dimension::IMPULSE) => Kick::Impulse,
        _ => {
            return Err(format!(
                "{text:?} is not a margin; expected a displacement, such as \"2 mm\", or an impulse, such as \
                 \"0.1 N s\""
            ));
        }
    };
    if read.value > 0.0 { Ok((kick, read.value)) } else { Err(format!("{text:?} is not positive")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oscillator::belt::Quantity;

    #[test]
    fn assignments_take_units_and_refuse_others() {
        for (text, name, value, half_width) in [
            ("m=250 g", Name::Number(Varied::Quantity(Quantity::Mass)), 0.25, 0.0),
            ("v0=0.2", Name::Number(Varied::Quantity(Quantity::BeltSpeed)), 0.2, 0.0),
            ("R=1 N+-0.2 N", Name::Number(Varied::Quantity(Quantity::Friction)), 1.0, 0.2),
            ("x=-2mm", Name::Displacement, -0.002, 0.0),
        ] {
            let (found, read) = assignment(text).unwrap();
            assert_eq!((found, read.middle.value, read.half_width), (name, value, half_width));
        }
        for (text, words) in [
            ("m", "expected NAME=VALUE"),
            ("M=1", "there are m, c, d1, d3, F, R, v0, mu_s, R_static"),
            ("m=2 N", "m: has another dimension; it takes a unit such as kg"),
            ("R=-1", "R = -1 N is outside its range 0.0 .."),
            ("x=1e9", "allowed: -1000000.0 .. 1000000.0"),
            ("v=two", "\"two\" does not begin with a number"),
            ("x=1 mm+-1 mm", "a start has no tolerance"),
        ] {
            let refused = assignment(text).unwrap_err();
            assert!(refused.contains(words), "{text}: {refused}");
        }
    }

    #[test]
    fn sweeps_and_margins_are_read() {
        let expected = RangeInUnits {
            varied: Varied::Quantity(Quantity::BeltSpeed),
            ends: (0.1, 0.5),
            count: 5,
        };
        assert_eq!(range("v0=10 cm/s:50 cm/s:5"), Ok(expected));
        for text in ["v0", "v0=1:2", "v0=1 m/s:2:5", "v0=1:2:1", "v9=1:2:3", "v0=0:1:3", "v0=1:1:3"]
        {
            assert!(range(text).is_err(), "{text}");
        }
        assert_eq!(margin("2 mm"), Ok((Kick::Displacement, 0.002)));
        assert_eq!(margin("0.5 N s"), Ok((Kick::Impulse, 0.5)));
        assert_eq!(margin("0.5 kg m/s"), Ok((Kick::Impulse, 0.5)));
        for text in ["2", "2 kg", "-2 mm", "0 mm", ""] {
            assert!(margin(text).is_err(), "{text}");
        }
    }
}
