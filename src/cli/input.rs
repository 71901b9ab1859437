//! Reading the values of options. Every error names the value and what is allowed.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use super::Failure;
use crate::figure::FileForm;
use crate::flow::{METHODS, Method};
use crate::model::unit::{Dimension, WithTolerance, measured, quantity};
use crate::model::{Group, Interval, Knob, MachineProblem};
use crate::portrait::basin::Window;
use crate::portrait::design::Kick;
use crate::portrait::kicks::RandomKick;
use crate::scan::sweep::ends;

/// Reads the text of an option whose numbers depend on what the command is about.
pub fn read<T>(
    option: &str,
    text: &str,
    read: impl FnOnce(&str) -> Result<T, String>,
) -> Result<T, Failure> {
    read(text)
        .map_err(|why| Failure::Usage(format!("invalid value '{text}' for '{option}': {why}")))
}

/// Reads the text of an option if it is given.
pub fn given<T>(
    option: &str,
    text: Option<&String>,
    of_text: impl FnOnce(&str) -> Result<T, String>,
) -> Result<Option<T>, Failure> {
    text.map(|text| read(option, text, of_text)).transpose()
}

/// Reads a number if it is given.
pub fn number(option: &str, text: Option<&String>, knob: Knob) -> Result<Option<f64>, Failure> {
    given(option, text, |text| knob.parse(text))
}

/// A whole number within a range.
pub fn whole(text: &str, range: RangeInclusive<usize>) -> Result<usize, String> {
    let (least, most) = (range.start(), range.end());
    let number = text.trim().parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("{text:?} is not a whole number in {least} .. {most}"))
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

/// A number of these groups and the text of its value, from `NAME=VALUE`; `form` says what is expected.
pub fn named<'a>(text: &'a str, groups: &[Group], form: &str) -> Result<(Knob, &'a str), String> {
    let (name, value) = text.split_once('=').ok_or(form)?;
    Ok((Knob::named(name.trim(), groups)?, value))
}

/// `NAME=VALUE` or `NAME=INTERVAL`: a number, `VALUE+-HALFWIDTH` or `LOW..HIGH`.
pub fn assigned(text: &str) -> Result<(Knob, Interval), String> {
    let form = "expected NAME=VALUE, such as D=-0.3 or r=0.10+-0.01";
    let (knob, value) = named(text, &[Group::Motion], form)?;
    Ok((knob, knob.parse_toleranced(value)?.ends))
}

/// `NAME=HALFWIDTH` of D, D2, D3 or r.
pub fn half_width(text: &str) -> Result<(Knob, f64), String> {
    let form = "expected NAME=HALFWIDTH with D, D2, D3 or r, such as r=0.01";
    let (knob, value) = named(text, &[Group::Motion], form)?;
    if !knob.is_parameter() {
        return Err(form.to_owned());
    }
    let half_width = knob.parse(value)?;
    let wide = Some(half_width).filter(|half_width| *half_width >= 0.0);
    Ok((knob, wide.ok_or_else(|| format!("{text:?}: a half width is 0 or more"))?))
}

/// A margin: `q=DISPLACEMENT` or `v=IMPULSE`.
pub fn margin(text: &str) -> Result<(Kick, f64), String> {
    let form = || format!("{text:?} is not a margin; expected q=DISPLACEMENT or v=IMPULSE");
    let (name, size) = text.split_once('=').ok_or_else(form)?;
    let (kick, knob) = match name.trim() {
        "q" => (Kick::Displacement, Knob::Q0),
        "v" => (Kick::Impulse, Knob::V0),
        _ => return Err(form()),
    };
    let size = knob.parse(size)?;
    if size > 0.0 { Ok((kick, size)) } else { Err(format!("{text:?} is not positive")) }
}

/// A number and the values that it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    pub knob: Knob,
    /// The first and the last value.
    pub ends: (f64, f64),
    /// Number of values.
    pub count: usize,
}

impl Over {
    /// Smallest and largest value.
    pub fn range(&self) -> (f64, f64) {
        let (from, to) = self.ends;
        (from.min(to), from.max(to))
    }
}

/// `NAME=FROM:TO:COUNT` of a number of a motion.
pub fn over(text: &str) -> Result<Over, String> {
    over_of(text, &[Group::Motion], "such as D=-0.95:0:400", 1_000_000)
}

/// `NAME=FROM:TO:COUNT` of a number of these groups: two different ends, and a count from 2 to `most`.
pub fn over_of(text: &str, groups: &[Group], such: &str, most: usize) -> Result<Over, String> {
    let form = format!("expected NAME=FROM:TO:COUNT, {such}");
    let (knob, range) = named(text, groups, &form)?;
    let [from, to, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(form) };
    let ends = ends(knob, range, [from, to])?;
    let count = whole(count, 2..=most)
        .map_err(|_| format!("COUNT = {count} is not a whole number in 2 .. {most}"))?;
    if ends.0 == ends.1 {
        return Err(format!("FROM and TO are both {:?}", ends.0));
    }
    Ok(Over { knob, ends, count })
}

/// Reads a number; the error says in one line what is wrong.
type ReadNumber<'a> = &'a dyn Fn(&str) -> Result<f64, String>;

/// `LOW:HIGH,LOW:HIGH`; `read` has one function for each side.
pub fn sides(text: &str, form: &str, read: [ReadNumber; 2]) -> Result<[(f64, f64); 2], String> {
    let (first, second) = text.split_once(',').ok_or(form)?;
    let side = |part: &str, read: ReadNumber| {
        let (low, high) = part.split_once(':').ok_or(form)?;
        let (low, high) = (read(low)?, read(high)?);
        let above = || format!("{part:?}: {low:?} is not below {high:?}");
        (low < high).then_some((low, high)).ok_or_else(above)
    };
    Ok([side(first, read[0])?, side(second, read[1])?])
}

/// The window where none is given.
pub const WINDOW: Window = Window { q: (-3.0, 3.0), v: (-3.0, 3.0) };

/// `QMIN:QMAX,VMIN:VMAX`.
pub fn window(text: &str) -> Result<Window, String> {
    let form = "expected QMIN:QMAX,VMIN:VMAX, such as -6:6,-6:6";
    let read = |knob: Knob| move |text: &str| knob.parse(text);
    let [q, v] = sides(text, form, [&read(Knob::Q0), &read(Knob::V0)])?;
    Ok(Window { q, v })
}

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
    Method::named(name).ok_or_else(|| {
        let names: Vec<_> = METHODS.iter().map(|row| row.name).collect();
        format!("there is no method {name:?}; there are {}", names.join(", "))
    })
}

/// The file of a figure, and the form given by its extension.
pub fn figure_file(text: &str) -> Result<(PathBuf, FileForm), String> {
    let path = PathBuf::from(text);
    FileForm::of_file(&path).map(|form| (path, form))
}

/// The file of a page.
pub fn page_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_page = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html"));
    if is_page { Ok(path) } else { Err("a page ends in .html".to_owned()) }
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

/// A part of `x=..,v=..`.
pub fn start(text: &str) -> Result<(Knob, WithTolerance), String> {
    let start = assignment(text)?;
    match start.0 {
        Knob::X | Knob::V => Ok(start),
        _ => Err(format!("{text:?} is not a start; expected x=.. and v=..")),
    }
}

/// `XMIN:XMAX,VMIN:VMAX`, in m and m/s.
pub fn physical_window(text: &str) -> Result<Window, String> {
    let form =
        format!("{text:?} is not a window; expected XMIN:XMAX,VMIN:VMAX, such as -2mm:2mm,0:1");
    let read = |unit| move |text: &str| quantity(text, unit);
    let [q, v] = sides(text, &form, [&read("m"), &read("m/s")])?;
    Ok(Window { q, v })
}

/// Random kicks, in m and m/s.
pub fn physical_kicks(text: &str) -> Result<RandomKick, String> {
    RandomKick::read(text, ["m", "m/s"])
}

/// `NAME=FROM:TO:COUNT`.
pub fn physical_over(text: &str) -> Result<Over, String> {
    over_of(text, Group::SOURCE, "such as \"v0=0.1 m/s:0.5 m/s:21\"", 100_000)
}

/// A margin: the unit decides whether it is a displacement or an impulse.
pub fn physical_margin(text: &str) -> Result<(Kick, f64), String> {
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
    fn numbers_and_intervals_are_read_and_refused_with_the_range() {
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
        let expected = Over { knob: Knob::D, ends: (-0.95, 0.0), count: 400 };
        assert_eq!(over("D=-0.95:0:400"), Ok(expected));
        assert_eq!(over("D=0:-0.95:400").map(|over| over.range()), Ok(expected.range()));
        for text in ["D", "D=1", "D=0:1", "D=0:1:1", "D=0:1:x", "D=0:0:5", "D=0:inf:5", "D=0:1:2:3"]
        {
            assert!(over(text).is_err(), "{text}");
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
        assert_eq!(figure_file("a/fig.SVG").unwrap().1, FileForm::Svg);
        assert_eq!(figure_file("fig.json").unwrap().1, FileForm::Json);
        assert_eq!(figure_file("fig.png").unwrap().1, FileForm::Png);
        for wrong in ["fig", "fig.pdf", ".svg", ""] {
            assert!(figure_file(wrong).is_err(), "{wrong}");
        }
        assert!(page_file("a/Page.HTML").is_ok());
        for wrong in ["page", "page.htm", ".html", ""] {
            assert!(page_file(wrong).is_err(), "{wrong}");
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
        assert_eq!(physical_over("v0=10 cm/s:50 cm/s:5"), Ok(expected));
        for text in ["v0", "v0=1:2", "v0=1 m/s:2:5", "v0=1:2:1", "v9=1:2:3", "v0=0:1:3", "v0=1:1:3"]
        {
            assert!(physical_over(text).is_err(), "{text}");
        }
        assert_eq!(physical_margin("2 mm"), Ok((Kick::Displacement, 0.002)));
        assert_eq!(physical_margin("0.5 N s"), Ok((Kick::Impulse, 0.5)));
        assert_eq!(physical_margin("0.5 kg m/s"), Ok((Kick::Impulse, 0.5)));
        for text in ["2", "2 kg", "-2 mm", "0 mm", ""] {
            assert!(physical_margin(text).is_err(), "{text}");
        }
    }
}
