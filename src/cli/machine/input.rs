//! Reading what is said about a machine: values with units, starts, windows.

use crate::cli::input::{Over, named, over_of, sides};
use crate::model::unit::{Dimension, WithTolerance, measured, quantity};
use crate::model::{Group, Knob, MachineProblem};
use crate::portrait::basin::Window;
use crate::portrait::design::Kick;
use crate::portrait::kicks::RandomKick;

/// The start of a motion; what is not given is left as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartOverride {
    /// Displacement, in m.
    pub x: Option<f64>,
    /// Velocity, in m/s.
    pub v: Option<f64>,
}

/// `NAME=VALUE`, the value with or without a unit.
pub fn assignment(text: &str) -> Result<(Knob, WithTolerance), String> {
    let (knob, value) =
        named(text, MachineProblem::GROUPS, "expected NAME=VALUE, such as \"v0=0.2 m/s\"")?;
    let read = knob.parse_toleranced(value)?;
    if read.half_width > 0.0 && knob.spec().group == Group::Course {
        return Err(format!("{text:?}: a start has no tolerance"));
    }
    Ok((knob, read))
}

/// A force, 0 or more.
pub fn disturbance(text: &str) -> Result<f64, String> {
    Knob::DisturbingForce.parse(text)
}

/// `x=..,v=..`, or one of them.
pub fn start(text: &str) -> Result<StartOverride, String> {
    let mut start = StartOverride::default();
    for part in text.split(',') {
        match assignment(part)? {
            (Knob::X, x) => start.x = Some(x.middle.value),
            (Knob::V, v) => start.v = Some(v.middle.value),
            _ => return Err(format!("{part:?} is not a start; expected x=.. and v=..")),
        }
    }
    Ok(start)
}

/// `XMIN:XMAX,VMIN:VMAX`, in m and m/s.
pub fn window(text: &str) -> Result<Window, String> {
    let form =
        format!("{text:?} is not a window; expected XMIN:XMAX,VMIN:VMAX, such as -2mm:2mm,0:1");
    let read = |unit| move |text: &str| quantity(text, unit);
    let [q, v] = sides(text, &form, [&read("m"), &read("m/s")])?;
    Ok(Window { q, v })
}

/// Random kicks, in m and m/s.
pub fn kicks(text: &str) -> Result<RandomKick, String> {
    RandomKick::read(text, ["m", "m/s"])
}

/// `NAME=FROM:TO:COUNT`.
pub fn range(text: &str) -> Result<Over, String> {
    over_of(text, Group::SOURCE, "such as \"v0=0.1 m/s:0.5 m/s:21\"", 100_000)
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

    #[test]
    fn assignments_take_units_and_refuse_others() {
        for (text, name, value, half_width) in [
            ("m=250 g", Knob::Mass, 0.25, 0.0),
            ("v0=0.2", Knob::BeltSpeed, 0.2, 0.0),
            ("R=1 N+-0.2 N", Knob::Friction, 1.0, 0.2),
            ("x=-2mm", Knob::X, -0.002, 0.0),
        ] {
            let (found, read) = assignment(text).unwrap();
            assert_eq!((found, read.middle.value, read.half_width), (name, value, half_width));
        }
        for (text, words) in [
            ("m", "expected NAME=VALUE"),
            ("M=1", "there are m, c, d1, d3, F, R, v0, mu_s, R_static"),
            ("m=2 N", "m = 2 N has the wrong unit; it takes one such as kg"),
            ("R=-1", "R = -1 N is outside its range 0 .."),
            ("x=1e9", "x = 1000000000 m is outside its range -1e6 .. 1e6 m"),
            ("v=two", "\"two\" is not a number"),
            ("x=1 mm+-1 mm", "a start has no tolerance"),
        ] {
            let refused = assignment(text).unwrap_err();
            assert!(refused.contains(words), "{text}: {refused}");
        }
    }

    #[test]
    fn sweeps_and_margins_are_read() {
        let expected = Over { knob: Knob::BeltSpeed, ends: (0.1, 0.5), count: 5 };
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
