//! Reading the values of options. Every error names the value and what is allowed.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use crate::figure::FileForm;
use crate::flow::{METHODS, Method};
use crate::oscillator::{Interval, PARAMETERS, Symbol};
use crate::scene::file::UNTIL_RANGE;
use crate::study::basin::Window;

/// A finite number; `1e400` is refused, as no double is that large.
fn number(text: &str) -> Result<f64, String> {
    match f64::from_str(text.trim()) {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("{text:?} is not a finite number")),
        Err(_) => Err(format!("{text:?} is not a number")),
    }
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

/// A number within a closed range.
pub fn within(name: &str, (min, max): (f64, f64), text: &str) -> Result<f64, String> {
    let allowed = format!("allowed: {min:?} .. {max:?}");
    let value = number(text).map_err(|refused| format!("{name}: {refused}; {allowed}"))?;
    if (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(format!("{name} = {text} is outside its range; {allowed}"))
    }
}

/// An end time.
pub fn until(text: &str) -> Result<f64, String> {
    within("until", UNTIL_RANGE, text)
}

/// One of the six numbers that define a motion.
fn symbol(name: &str) -> Result<Symbol, String> {
    Symbol::named(name).ok_or_else(|| {
        let names = PARAMETERS.map(|row| row.name).join(", ");
        format!("there is no parameter {name:?}; there are {names}")
    })
}

/// A value of one of the six numbers.
fn value_of(symbol: Symbol, text: &str) -> Result<f64, String> {
    let value = within(symbol.spec().name, (symbol.spec().min, symbol.spec().max), text)?;
    symbol.spec().check(value).map_err(|refused| refused.to_string())
}

/// `NAME=VALUE`.
pub fn assignment(text: &str) -> Result<(Symbol, f64), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as D=-0.3")?;
    let symbol = symbol(name.trim())?;
    Ok((symbol, value_of(symbol, value)?))
}

/// `NAME=VALUE` or `NAME=INTERVAL`.
pub fn assigned(text: &str) -> Result<(Symbol, Interval), String> {
    if text.contains("+-") || text.contains("..") {
        return interval(text);
    }
    assignment(text).map(|(symbol, value)| (symbol, Interval::point(value)))
}

/// `NAME=INTERVAL`: a number, `VALUE+-HALFWIDTH` or `LOW..HIGH`.
pub fn interval(text: &str) -> Result<(Symbol, Interval), String> {
    let form = "expected NAME=VALUE+-HALFWIDTH or NAME=LOW..HIGH, such as r=0.10+-0.01";
    let (name, interval) = text.split_once('=').ok_or(form)?;
    let symbol = symbol(name.trim())?;
    let interval: Interval =
        interval.parse().map_err(|refused| format!("{}: {refused}", symbol.spec().name))?;
    for end in [interval.lower(), interval.upper()] {
        symbol.spec().check(end).map_err(|refused| refused.to_string())?;
    }
    Ok((symbol, interval))
}

/// A bound on a disturbing force.
pub fn disturbance(text: &str) -> Result<f64, String> {
    within("disturbance", (0.0, Symbol::R.spec().max), text)
}

/// `NAME=HALFWIDTH` of D, D2, D3 or r.
pub fn half_width(text: &str) -> Result<(Symbol, f64), String> {
    let form = "expected NAME=HALFWIDTH with D, D2, D3 or r, such as r=0.01";
    let (name, value) = text.split_once('=').ok_or(form)?;
    let symbol = symbol(name.trim())?;
    if matches!(symbol, Symbol::Q0 | Symbol::V0) {
        return Err(form.to_owned());
    }
    Ok((symbol, within(name, (0.0, symbol.spec().max), value)?))
}

/// A parameter and its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    pub symbol: Symbol,
    /// Smallest and largest value.
    pub range: (f64, f64),
    /// Number of values.
    pub count: usize,
}

/// `NAME=FROM:TO:COUNT`.
pub fn over(text: &str) -> Result<Over, String> {
    let form = "expected NAME=FROM:TO:COUNT, such as D=-0.95:0:400";
    let (name, range) = text.split_once('=').ok_or(form)?;
    let symbol = symbol(name.trim())?;
    let value = |text: &str| value_of(symbol, text);
    let ((from, to), count) =
        stepped(range, form, 1_000_000, |from, to| Ok((value(from)?, value(to)?)))?;
    Ok(Over { symbol, range: (from.min(to), from.max(to)), count })
}

/// `FROM:TO:COUNT`: two different ends, which `ends` reads together, and a count from 2 to `most`.
pub fn stepped(
    text: &str,
    form: &str,
    most: usize,
    ends: impl Fn(&str, &str) -> Result<(f64, f64), String>,
) -> Result<((f64, f64), usize), String> {
    let [from, to, count] = text.split(':').collect::<Vec<_>>()[..] else {
        return Err(form.to_owned());
    };
    let (from, to) = ends(from, to)?;
    let count = whole(count, 2..=most)
        .map_err(|_| format!("COUNT = {count} is not a whole number in 2 .. {most}"))?;
    if from == to {
        return Err(format!("FROM and TO are both {from:?}"));
    }
    Ok(((from, to), count))
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

/// `QMIN:QMAX,VMIN:VMAX`.
pub fn window(text: &str) -> Result<Window, String> {
    let form = "expected QMIN:QMAX,VMIN:VMAX, such as -6:6,-6:6";
    let read = |symbol| move |text: &str| value_of(symbol, text);
    let [q, v] = sides(text, form, [&read(Symbol::Q0), &read(Symbol::V0)])?;
    Ok(Window { q, v })
}

/// `WxH` starts.
pub fn grid(text: &str) -> Result<(usize, usize), String> {
    /// Maximum number of starts on a side.
    const MOST: usize = 100_000;
    let allowed = 1..=MOST;
    let sides =
        pair(text, 'x').filter(|(one, other)| allowed.contains(one) && allowed.contains(other));
    sides.ok_or_else(|| {
        format!("{text:?} is not a grid; expected WxH, such as 320x384, 1 .. {MOST} each")
    })
}

pub fn method(name: &str) -> Result<Method, String> {
    Method::named(name).ok_or_else(|| {
        let names: Vec<_> = METHODS.iter().map(|row| row.name).collect();
        format!("there is no method {name:?}; there are {}", names.join(", "))
    })
}

/// `WIDTHxHEIGHT` in cells.
pub fn size(text: &str) -> Result<(u16, u16), String> {
    let allowed = 1..=1000;
    let sides =
        pair(text, 'x').filter(|(one, other)| allowed.contains(one) && allowed.contains(other));
    sides.ok_or_else(|| {
        format!("{text:?} is not a size; expected WxH, such as 120x40, 1 .. 1000 each")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_read_and_refused_with_the_range() {
        assert_eq!(interval("D=-0.3..-0.28"), Ok((Symbol::D, Interval::new(-0.3, -0.28))));
        for (text, expected) in [
            ("r", "NAME=VALUE+-HALFWIDTH"),
            ("r=0.1+-0.2", "outside its range 0.0 .. 1e150"),
            ("R=0.1", "there is no parameter"),
            ("r=0.1+-", "r: \"\" is not a number"),
        ] {
            let refused = interval(text).unwrap_err();
            assert!(refused.contains(expected), "{text}: {refused}");
        }
    }

    #[test]
    fn ranges_are_read_in_either_direction() {
        let expected = Over { symbol: Symbol::D, range: (-0.95, 0.0), count: 400 };
        assert_eq!(over("D=-0.95:0:400"), Ok(expected));
        assert_eq!(over("D=0:-0.95:400"), Ok(expected));
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
}
