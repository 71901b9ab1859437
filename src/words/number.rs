//! Numbers as text: with a few significant digits, with a prefix and a unit, or exactly, within a given width.

pub use crate::numerics::decimal::{in_unit, resolved, shortest, significant, with_error};
use crate::numerics::{amount, real};
use crate::scan::Value;

/// A positive `value` with all but this many significant digits cut off, so that it is not above `value`.
pub fn rounded_down(value: f64, digits: usize) -> f64 {
    let text = format!("{value:e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return value };
    // One more for the point.
    let kept = &mantissa[..mantissa.len().min(digits + 1)];
    format!("{kept}e{exponent}").parse().unwrap_or(0.0)
}

/// Writes `value` so that it reads back as the same number, if that fits into `width` columns; otherwise rounds
/// it until it fits.
pub fn exact(value: f64, width: usize) -> String {
    let full = shortest(value);
    if full.len() <= width {
        return full;
    }
    let scientific = format!("{value:e}");
    if scientific.len() <= width {
        return scientific;
    }
    fitting(value, 15, width).unwrap_or_else(|| significant(value, 1))
}

/// Writes a number with as many of its `digits` as fit into `width` columns; `None` if not even one does.
pub fn fitting(value: f64, digits: usize, width: usize) -> Option<String> {
    let mut texts = (1..=digits).rev().map(|digits| significant(value, digits));
    texts.find(|text| text.len() <= width)
}

/// Writes a count in at most six columns: `950`, `12.4k`, `3.1M`.
pub fn count(value: u64) -> String {
    let number = amount(value);
    // Up to five columns there is room for all digits.
    let fits = |(_, scale): &&(&str, f64)| *scale > 1.0 && number >= scale.max(1e4);
    let Some((prefix, scale)) = PREFIXES.iter().find(fits) else { return value.to_string() };
    format!("{}{prefix}", significant(number / scale, 3))
}

/// Writes a duration given in seconds: `0.21 ms`, `35 ms`, `2.4 s`.
pub fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{} ms", significant(seconds * 1e3, 2))
    } else {
        format!("{} s", significant(seconds, 3))
    }
}

/// Writes by which part of the true value (which is not 0) another exceeds it: `12 % too large`.
pub fn too_large(part: f64) -> String {
    let way = if part > 0.0 { "large" } else { "small" };
    format!("{} % too {way}", significant(100.0 * part.abs(), 2))
}

/// Writes the time left if `done` of `wanted` equal parts took `elapsed` seconds: `12 s`, `3 min`, `2.5 h`.
pub fn remaining(elapsed: f64, done: usize, wanted: usize) -> String {
    let seconds = elapsed * real(wanted.saturating_sub(done)) / real(done.max(1));
    if seconds < 90.0 {
        format!("{} s", seconds.ceil())
    } else if seconds < 5400.0 {
        format!("{} min", (seconds / 60.0).round())
    } else {
        format!("{} h", significant(seconds / 3600.0, 2))
    }
}

/// Prefixes and their factors, largest first.
const PREFIXES: [(&str, f64); 6] =
    [("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("u", 1e-6)];

/// Smallest number written before a prefix of at most 1 (0.25 m, but 25 mm); it is 1 for k, M and G.
const LEAST: f64 = 0.1;

/// A value given in an SI unit with at most `digits` significant digits: `5.47 mm`, `27.4 N`.
///
/// Pure numbers, units that already have a prefix (kg), and those that begin with a power (s^2/m^2), of which the prefix
/// would be a part, get none.
pub fn with_unit(value: f64, digits: usize, unit: &str) -> String {
    with_unit_of(value, value, digits, unit)
}

/// The same with the prefix that another number has, for numbers that are to be compared.
pub fn with_unit_of(other: f64, value: f64, digits: usize, unit: &str) -> String {
    let plain = |value: f64| significant(value, digits);
    if unit.is_empty() {
        return plain(value);
    }
    let least = |scale: f64| if scale > 1.0 { scale } else { scale * LEAST };
    let begins_with_power = unit.split(['/', ' ']).next().is_some_and(|first| first.contains('^'));
    let takes_none = unit.starts_with("kg") || begins_with_power;
    let (prefix, scale) = if other == 0.0 || !other.is_finite() || takes_none {
        ("", 1.0)
    } else {
        let found = PREFIXES.into_iter().find(|(_, scale)| other.abs() >= least(*scale));
        found.unwrap_or(PREFIXES[PREFIXES.len() - 1])
    };
    format!("{} {prefix}{unit}", plain(value / scale))
}

/// What a scan measured at a point: with all its digits, empty if there is nothing; or to some digits, then `-`.
pub fn measurement(value: Value, digits: Option<usize>) -> String {
    match (value, digits) {
        (Value::Nothing, None) => String::new(),
        (Value::Nothing, Some(_)) => "-".to_owned(),
        (Value::Number(value), None) => format!("{value:?}"),
        (Value::Number(value), Some(digits)) => significant(value, digits),
        (Value::Count(count), _) => count.to_string(),
        (Value::Word(word), _) => word.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::powi;

    #[test]
    fn what_is_promised_is_rounded_down() {
        for (value, digits, below) in [
            (0.139_66, 3, 0.139),
            (0.231, 3, 0.231),
            (2050.9, 3, 2050.0),
            (9.999e-7, 2, 9.9e-7),
            (3.0, 3, 3.0),
            (0.0, 3, 0.0),
        ] {
            assert_eq!(rounded_down(value, digits), below, "{value} to {digits}");
        }
    }

    #[test]
    fn digits_are_those_that_matter() {
        let cases = [
            (-0.116_144, 3, "-0.116"),
            (9.4699, 3, "9.47"),
            (1.0, 4, "1"),
            (0.1 + 0.2, 6, "0.3"),
            (6.5e-31, 3, "6.5e-31"),
            (1e12, 3, "1e12"),
            (123_456.7, 3, "123457"),
            (0.000_123, 2, "0.00012"),
            (999.96, 4, "1000"),
            (f64::NAN, 3, "-"),
            (-0.0, 3, "0"),
        ];
        for (value, digits, text) in cases {
            assert_eq!(significant(value, digits), text, "{value} to {digits}");
        }
    }

    #[test]
    fn digits_follow_the_resolution() {
        let cases = [
            (1.234_56, 0.016, "1.23"),
            (0.051_23, 0.016, "0.051"),
            (0.001, 0.016, "0"),
            (0.109_643_712_3, 1e-8, "0.109643712"),
        ];
        for (value, resolution, text) in cases {
            assert_eq!(resolved(value, resolution), text);
        }
    }

    #[test]
    fn counts_and_durations_stay_short() {
        assert_eq!(
            [0, 950, 9_999, 12_400, 3_100_000].map(count),
            ["0", "950", "9999", "12.4k", "3.1M"]
        );
        assert_eq!([0.000_21, 0.035, 2.4].map(duration), ["0.21 ms", "35 ms", "2.4 s"]);
    }

    #[test]
    fn prefixes_keep_numbers_short() {
        for (value, unit, text) in [
            (0.005_472, "m", "5.47 mm"),
            (0.3, "m/s", "0.3 m/s"),
            (0.03, "m/s", "30 mm/s"),
            (4000.0, "N", "4 kN"),
            (400.0, "N", "400 N"),
            (0.0, "m", "0 m"),
            (-2.5e-5, "m", "-25 um"),
            (1e-9, "m", "0.001 um"),
            (0.002, "kg", "0.002 kg"),
            (0.002, "s^2/m^2", "0.002 s^2/m^2"),
            (2.5, "", "2.5"),
            (0.0547, "N s", "54.7 mN s"),
        ] {
            assert_eq!(with_unit(value, 3, unit), text);
        }
    }

    #[test]
    fn what_is_written_can_be_typed_in_again() {
        for value in [1.5e-7, 0.0234, -0.7, 5.0, 12_345.0, 2e7] {
            for unit in ["m", "m/s", "N s", "N", "s", "kg", "N/m", "s^2/m^2"] {
                let text = with_unit(value, 15, unit);
                let back = crate::model::unit::measured(&text).unwrap().value;
                assert!((back / value - 1.0).abs() < 1e-14, "{text}: {back}");
            }
        }
    }

    proptest! {
        #[test]
        fn an_exact_number_reads_back_and_a_rounded_one_fits(value: f64, width in 7_usize..30) {
            prop_assume!(value.is_finite());
            let text = exact(value, width);
            let back: f64 = text.parse().unwrap();
            if width >= 25 {
                prop_assert_eq!(back, value);
            }
            prop_assert!(text.len() <= width.max(8), "{}", text);
        }

        #[test]
        fn what_is_rounded_down_is_not_above_and_less_than_a_unit_below(
            value in 1e-30_f64..1e30, digits in 1_usize..8,
        ) {
            let down = rounded_down(value, digits);
            let power: i32 = format!("{value:e}").split_once('e').unwrap().1.parse().unwrap();
            let unit = powi(10.0, power + 1 - i32::try_from(digits).unwrap());
            prop_assert!(down <= value && value - down < unit * (1.0 + 1e-9), "{down} of {value}");
            prop_assert_eq!(significant(down, digits).parse::<f64>().unwrap(), down);
        }

        #[test]
        fn rounding_to_three_digits_loses_less_than_half_a_percent(value: f64) {
            prop_assume!(value.is_normal());
            let back: f64 = significant(value, 3).parse().unwrap();
            prop_assert!(((back - value) / value).abs() <= 0.005_01 || back.is_infinite());
        }
    }
}
