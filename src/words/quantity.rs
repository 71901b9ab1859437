//! Physical quantities as text: a few digits, a prefix, a unit.

use super::number::significant;

/// Prefixes and their factors, largest first.
const PREFIXES: [(&str, f64); 6] =
    [("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("u", 1e-6)];

/// Smallest number written before a prefix of at most 1 (0.25 m, but 25 mm); ten times that for k, M and G.
const LEAST: f64 = 0.1;

/// A value given in an SI unit with at most `digits` significant digits: `5.47 mm`, `27.4 N`.
///
/// Pure numbers, units that already have a prefix (kg), and those that begin with a power (s^2/m^2), of which the prefix
/// would be a part, get none.
pub fn with_unit(value: f64, digits: usize, unit: &str) -> String {
    let plain = |value: f64| significant(value, digits);
    if unit.is_empty() {
        return plain(value);
    }
    let fits = |scale: f64| value.abs() >= scale * LEAST;
    let begins_with_power = unit.split(['/', ' ']).next().is_some_and(|first| first.contains('^'));
    let takes_none = unit.starts_with("kg") || begins_with_power;
    let (prefix, scale) = if value == 0.0 || !value.is_finite() || takes_none {
        ("", 1.0)
    } else {
        let found =
            PREFIXES.iter().find(|(_, scale)| fits(scale * if *scale > 1.0 { 10.0 } else { 1.0 }));
        *found.unwrap_or(&PREFIXES[PREFIXES.len() - 1])
    };
    format!("{} {prefix}{unit}", plain(value / scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::unit::measured;

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
                let back = measured(&text).unwrap().value;
                assert!((back / value - 1.0).abs() < 1e-14, "{text}: {back}");
            }
        }
    }
}
