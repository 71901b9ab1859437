//! Reading the values of options. Every error names the value and what is allowed.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Command;

use super::Result;
use crate::figure::FigureForm;
use crate::flow::{METHODS, Method, Subject};
use crate::model::{Group, IMPULSE, Knob, LENGTH, TolerancedNumber, measured};
use crate::portrait::{Kick, RandomKick, StartWindow};
use crate::scan::{Spacing, Sweep};
use crate::words::one_of;

/// The numbers by which options are read whose values depend on what a command is about.
pub struct Numbers {
    /// Displacement and velocity.
    pub state: [Knob; 2],
    /// The end of a motion.
    pub until: Knob,
    /// The bound on a disturbing force.
    pub disturbance: Knob,
    /// What can be set.
    pub set: &'static [Group],
    /// What a branch or a border goes over.
    pub over: &'static [Group],
    /// Reads a margin.
    pub margin: fn(&str) -> Result<(Kick, f64), String>,
}

/// Those of the oscillator of the paper.
pub const OSCILLATOR: Numbers = Numbers {
    state: [Knob::Q0, Knob::V0],
    until: Knob::Until,
    disturbance: Knob::Disturbance,
    set: &[Group::Motion],
    over: &[Group::Motion],
    margin,
};

/// Those of a machine.
pub const MACHINE: Numbers = Numbers {
    state: [Knob::X, Knob::V],
    until: Knob::Duration,
    disturbance: Knob::DisturbingForce,
    set: Subject::GROUPS,
    over: Group::SOURCE,
    margin: physical_margin,
};

impl Numbers {
    /// `QMIN:QMAX,VMIN:VMAX`.
    pub fn window(&self, text: &str) -> Result<StartWindow, String> {
        const FORM: &str =
            "expected QMIN:QMAX,VMIN:VMAX, such as -6:6,-6:6, or of a machine -2mm:2mm,0:1";
        let (q, v) = text.split_once(',').ok_or(FORM)?;
        let side = |part: &str, knob: Knob| {
            let (low, high) = part.split_once(':').ok_or(FORM)?;
            let (low, high) = (knob.parse(low)?, knob.parse(high)?);
            let above = || format!("{part:?}: {low:?} is not below {high:?}");
            (low < high).then_some((low, high)).ok_or_else(above)
        };
        Ok(StartWindow { q: side(q, self.state[0])?, v: side(v, self.state[1])? })
    }

    /// Random kicks.
    pub fn kicks(&self, text: &str) -> Result<RandomKick, String> {
        RandomKick::read(text, self.state.map(|knob| knob.spec().unit))
    }

    /// `NAME=FROM:TO:COUNT`.
    pub fn over(&self, text: &str) -> Result<Sweep, String> {
        let over = Sweep::read(text, self.over)?;
        if over.spacing == Spacing::Logarithmic {
            return Err("the values are evenly spaced, without log:".to_owned());
        }
        Ok(over)
    }

    /// `NAME=FROM:TO` or `NAME=log:FROM:TO`, through so many values.
    pub fn range(&self, text: &str, count: usize) -> Result<Sweep, String> {
        const FORM: &str = "expected NAME=FROM:TO, such as D=-0.95:0, or NAME=log:FROM:TO";
        Sweep::read_as(FORM, &format!("{text}:{count}"), self.over)
    }

    /// The same of a number that glides while a motion goes on.
    pub fn glide(&self, text: &str, count: usize) -> Result<Sweep, String> {
        let sweep = self.range(text, count)?;
        if matches!(sweep.symbol, Knob::Q0 | Knob::V0) {
            return Err(format!("{}: a start does not glide", sweep.symbol));
        }
        Ok(sweep)
    }

    /// `NAME=VALUE`, `NAME=VALUE+-HALFWIDTH` or `NAME=LOW..HIGH`.
    pub fn assignment(&self, text: &str) -> Result<(Knob, TolerancedNumber), String> {
        let form =
            "expected NAME=VALUE, such as D=-0.3, r=0.10+-0.01, or of a machine \"v0=0.2 m/s\"";
        let (name, value) = text.split_once('=').ok_or(form)?;
        let knob = Knob::named(name.trim(), self.set)?;
        let read = knob.parse_toleranced(value)?;
        if read.half_width > 0.0 && knob.spec().group == Group::Course {
            return Err(format!("{text:?}: a start has no uncertainty"));
        }
        Ok((knob, read))
    }
}

/// Reads the text of an option whose numbers depend on what the command is about.
pub fn read<T>(
    option: &str,
    text: &str,
    read: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T> {
    read(text).map_err(|why| format!("invalid value '{text}' for '{option}': {why}").into())
}

/// Reads the text of an option if it is given.
pub fn given<T>(
    option: &str,
    text: Option<&String>,
    of_text: impl FnOnce(&str) -> Result<T, String>,
) -> Result<Option<T>> {
    text.map(|text| read(option, text, of_text)).transpose()
}

/// Reads a number if it is given.
pub fn number(option: &str, text: Option<&String>, knob: Knob) -> Result<Option<f64>> {
    given(option, text, |text| knob.parse(text))
}

/// A whole number within a range.
pub fn whole(text: &str, range: RangeInclusive<usize>) -> Result<usize, String> {
    let (least, most) = (range.start(), range.end());
    let number = text.trim().parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("{text:?} is not a whole number in {least} .. {most}"))
}

/// A number in this unit within a range.
pub fn within(text: &str, unit: &str, range: RangeInclusive<f64>) -> Result<f64, String> {
    let (least, most) = (range.start(), range.end());
    let number = text.trim().parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("{text:?} is not a number in {least} .. {most} {unit}"))
}

/// Two numbers of the same type with a separator between them.
pub fn pair<T: FromStr>(text: &str, separator: char) -> Option<(T, T)> {
    let (one, other) = text.split_once(separator)?;
    Some((one.parse().ok()?, other.parse().ok()?))
}

/// The relative error of a step.
pub fn tolerance(text: &str) -> Result<f64, String> {
    Knob::Tolerance.parse(text)
}

/// `NAME=HALFWIDTH` of D, D2, D3 or r.
pub fn half_width(text: &str) -> Result<(Knob, f64), String> {
    let refused =
        || format!("{text:?}: D, D2, D3 and r have half widths, of 0 or more, such as r=0.01");
    let (name, value) = text.split_once('=').ok_or_else(refused)?;
    let knob = Knob::named(name.trim(), OSCILLATOR.set);
    let knob = knob.map_err(|why| format!("{why}; {}", refused()))?;
    let half_width = Some(knob.parse(value)?);
    let half_width = half_width.filter(|it| knob.is_parameter() && *it >= 0.0);
    Ok((knob, half_width.ok_or_else(refused)?))
}

/// The half widths of D, D2, D3 and r. Fails if one of them is given twice.
pub fn half_widths(given: &[(Knob, f64)]) -> Result<[f64; 4]> {
    let mut all = [None; 4];
    for (knob, half_width) in given {
        if all[knob.place()].replace(*half_width).is_some() {
            return Err(format!("{knob} has two half widths").into());
        }
    }
    Ok(all.map(Option::unwrap_or_default))
}

/// A margin of the oscillator: `q=DISPLACEMENT` or `v=IMPULSE`.
fn margin(text: &str) -> Result<(Kick, f64), String> {
    let form = || format!("{text:?} is not a margin; expected q=DISPLACEMENT or v=IMPULSE");
    let (name, size) = text.split_once('=').ok_or_else(form)?;
    let (kick, knob) = match name.trim() {
        "q" => (Kick::Displacement, Knob::Q0),
        "v" => (Kick::Impulse, Knob::V0),
        _ => return Err(form()),
    };
    let size = knob.parse(size)?;
    if size > 0.0 {
        Ok((kick, size))
    } else {
        Err(format!("{text:?} is not positive"))
    }
}

/// A margin of a machine: the unit decides whether it is a displacement or an impulse.
pub fn physical_margin(text: &str) -> Result<(Kick, f64), String> {
    const EXPECTED: &str =
        "expected a displacement, such as \"2 mm\", or an impulse, such as \"0.1 N s\"";
    let read = measured(text)?;
    let kick = match read.dimension {
        Some(LENGTH) => Kick::Displacement,
        Some(IMPULSE) => Kick::Impulse,
        _ => return Err(format!("{text:?} is not a margin; {EXPECTED}")),
    };
    if read.value > 0.0 {
        Ok((kick, read.value))
    } else {
        Err(format!("{text:?} is not positive"))
    }
}

/// The options whose values may begin with a minus, with blanks between them.
pub const SIGNED: &str =
    "along design disturbance epsilon half-width kicks over sample set start step tol until window";

/// A command whose numbers may be negative: a minus begins no option there.
pub fn signed(command: Command) -> Command {
    command.mut_args(|option| {
        let is_signed = SIGNED.split(' ').any(|name| option.get_long() == Some(name));
        option.allow_hyphen_values(is_signed)
    })
}

/// The window where none is given.
pub const WINDOW: StartWindow = StartWindow { q: (-3.0, 3.0), v: (-3.0, 3.0) };

/// `WxH` of this kind, such as the one given.
fn rectangle<T: FromStr + PartialOrd + Display>(
    text: &str,
    (kind, such): (&str, &str),
    [least, most]: [T; 2],
) -> Result<(T, T), String> {
    let allowed = least..=most;
    let sides =
        pair(text, 'x').filter(|(one, other)| allowed.contains(one) && allowed.contains(other));
    let (least, most) = allowed.into_inner();
    sides.ok_or_else(|| {
        format!("{text:?} is not a {kind}; expected WxH, such as {such}, {least} .. {most} each")
    })
}

/// `WxH` starts.
pub fn grid(text: &str) -> Result<(usize, usize), String> {
    rectangle(text, ("grid", "320x384"), [1, 100_000])
}

/// `WxH` in cells.
pub fn size(text: &str) -> Result<(u16, u16), String> {
    rectangle(text, ("size", "120x40"), [1, 1000])
}

pub fn method(name: &str) -> Result<Method, String> {
    one_of("method", name, METHODS.iter().map(|row| (row.name, row.method)))
}

/// The file of a figure, and the form given by its extension.
pub fn figure_file(text: &str) -> Result<(PathBuf, FigureForm), String> {
    let path = PathBuf::from(text);
    FigureForm::of_file(&path).map(|form| (path, form))
}

/// The file of something that ends in this way.
pub fn file(text: &str, kind: &str, ending: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending)) {
        Ok(path)
    } else {
        Err(format!("{kind} ends in .{ending}"))
    }
}

/// A part of `x=..,v=..`.
pub fn start(text: &str) -> Result<(Knob, TolerancedNumber), String> {
    let start = MACHINE.assignment(text)?;
    match start.0 {
        Knob::X | Knob::V => Ok(start),
        _ => Err(format!("{text:?} is not a start; expected x=.. and v=..")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Interval;

    #[test]
    fn numbers_and_intervals_are_read_and_refused_with_the_range() {
        let assigned = |text| OSCILLATOR.assignment(text).map(|(knob, read)| (knob, read.ends));
        assert_eq!(assigned("q0= 1e150"), Ok((Knob::Q0, Interval::point(1e150))));
        assert_eq!(assigned("D=-0.3..-0.28"), Ok((Knob::D, Interval::new(-0.3, -0.28))));
        let refused = assigned("r=0.1+-0.2").unwrap_err();
        assert_eq!(refused, "r = -0.1 is outside its range 0 .. 1e150");
        assert_eq!(half_width("r=0.01"), Ok((Knob::R, 0.01)));
        for text in ["q0=1", "D=-1", "D"] {
            assert!(half_width(text).unwrap_err().to_lowercase().contains("half"), "{text}");
        }
    }

    #[test]
    fn ranges_are_read_in_either_direction() {
        let read =
            |text| OSCILLATOR.over(text).map(|over| (over.symbol, over.from, over.to, over.count));
        assert_eq!(read("D=-0.95:0:400"), Ok((Knob::D, -0.95, 0.0, 400)));
        assert_eq!(read("D=0:-0.95:400"), Ok((Knob::D, 0.0, -0.95, 400)));
        for text in [
            "D",
            "D=1",
            "D=0:1",
            "D=0:1:1",
            "D=0:1:x",
            "D=0:0:5",
            "D=0:inf:5",
            "D=0:1:2:3",
            "r=log:1:2:3",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_have_two_sides() {
        assert_eq!(size("120x40"), Ok((120, 40)));
        for text in ["120", "0x1", "120x", "1x1001", "-1x5", "ax4"] {
            assert!(size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn the_ending_of_a_file_says_in_which_form() {
        assert_eq!(figure_file("a/fig.SVG").unwrap().1, FigureForm::Svg);
        assert_eq!(figure_file("fig.json").unwrap().1, FigureForm::Json);
        assert_eq!(figure_file("fig.png").unwrap().1, FigureForm::Png);
        assert_eq!(figure_file("fig.pdf").unwrap().1, FigureForm::Pdf);
        for wrong in ["fig", "fig.eps", ".svg", ""] {
            assert!(figure_file(wrong).is_err(), "{wrong}");
        }
        assert!(file("a/Page.HTML", "a page", "html").is_ok());
        for wrong in ["page", "page.htm", ".html", ""] {
            assert!(file(wrong, "a page", "html").is_err(), "{wrong}");
        }
    }

    #[test]
    fn assignments_take_units_and_refuse_others() {
        for (text, name, value, half_width) in [
            ("m=250 g", Knob::Mass, 0.25, 0.0),
            ("v0=0.2", Knob::BeltSpeed, 0.2, 0.0),
            ("R=1 N+-0.2 N", Knob::Friction, 1.0, 0.2),
            ("x=-2mm", Knob::X, -0.002, 0.0),
        ] {
            let (found, read) = MACHINE.assignment(text).unwrap();
            assert_eq!((found, read.middle.value, read.half_width), (name, value, half_width));
        }
        for (text, words) in [
            ("m", "expected NAME=VALUE"),
            ("M=1", "there are m, c, d1, d3, F, R, v0, mu_s, R_static"),
            ("m=2 N", "m = 2 N has the wrong unit; it takes one such as kg"),
            ("R=-1", "R = -1 N is outside its range 0 .."),
            ("x=1e9", "x = 1000000000 m is outside its range -1e6 .. 1e6 m"),
            ("v=two", "\"two\" is not a number"),
            ("x=1 mm+-1 mm", "a start has no uncertainty"),
        ] {
            let refused = MACHINE.assignment(text).unwrap_err();
            assert!(refused.contains(words), "{text}: {refused}");
        }
    }

    #[test]
    fn sweeps_and_margins_are_read() {
        let over = MACHINE.over("v0=10 cm/s:50 cm/s:5").unwrap();
        assert_eq!((over.symbol, over.from, over.to, over.count), (Knob::BeltSpeed, 0.1, 0.5, 5));
        for text in ["v0", "v0=1:2", "v0=1 m/s:2:5", "v0=1:2:1", "v9=1:2:3", "v0=0:1:3", "v0=1:1:3"]
        {
            assert!(MACHINE.over(text).is_err(), "{text}");
        }
        assert_eq!(physical_margin("2 mm"), Ok((Kick::Displacement, 0.002)));
        assert_eq!(physical_margin("0.5 N s"), Ok((Kick::Impulse, 0.5)));
        assert_eq!(physical_margin("0.5 kg m/s"), Ok((Kick::Impulse, 0.5)));
        for text in ["2", "2 kg", "-2 mm", "0 mm", ""] {
            assert!(physical_margin(text).is_err(), "{text}");
        }
    }
}
