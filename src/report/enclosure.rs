//! Numbers that are proved to lie in an interval, as text.

use crate::numerics::Interval;
use crate::numerics::elementary::{log10, pow};
use crate::words::significant;

/// Most digits of an enclosure.
pub(super) const PLACES: usize = 12;

/// The digits on which both ends of an enclosure agree. If there are none: a power of ten as a bound of a number that
/// overflows or underflows, else `?`.
pub(super) fn certain(value: Interval) -> String {
    let ends = |digits| [value.lower(), value.upper()].map(|end| significant(end, digits));
    let agreed = (1..=PLACES).rev().map(ends).find(|[lower, upper]| lower == upper);
    agreed.map(|[digits, _]| digits).or_else(|| beyond(value)).unwrap_or_else(|| "?".to_owned())
}

/// `> 1e149` for an enclosure without an upper end that lies above 1e100, `< 1e-322` for one that reaches from 0
/// to less than 1e-100.
fn beyond(value: Interval) -> Option<String> {
    const HUGE: f64 = 1e100;
    let power = |of: f64| log10(of).floor();
    if value.lower() > HUGE && value.upper() == f64::INFINITY {
        return Some(format!("> 1e{}", power(value.lower()) - 1.0));
    }
    let tiny = value.lower() == 0.0 && value.upper() < 1.0 / HUGE;
    tiny.then(|| format!("< 1e{}", power(value.upper()) + 2.0))
}

/// The ends of an interval, rounded outward to six digits.
pub(super) fn ends(it: Interval) -> String {
    if !it.is_finite() {
        return certain(it);
    }
    let step = |value: f64| {
        let digits = pow(10.0, log10(value.abs()).floor() - 5.0);
        if digits.is_finite() { digits } else { 0.0 }
    };
    let end = |value: f64, sign: f64| {
        let near = significant(value, 6);
        let read: f64 = near.parse().unwrap_or(f64::NAN);
        let inside = sign * (value - read) > 0.0;
        if inside { significant(value + sign * step(value), 6) } else { near }
    };
    format!("{} .. {}", end(it.lower(), -1.0), end(it.upper(), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_digits_on_which_both_ends_agree_are_shown() {
        assert_eq!(certain(Interval::new(0.123_449, 0.123_451)), "0.12345");
        assert_eq!(certain(Interval::new(0.123_44, 0.123_46)), "0.123");
        assert_eq!(certain(Interval::new(1.0, 3.0)), "?");
        assert_eq!(certain(Interval::new(1.0, f64::INFINITY)), "?");
        assert_eq!(certain(Interval::new(1.3e150, f64::INFINITY)), "> 1e149");
        assert_eq!(certain(Interval::new(0.0, 5e-324)), "< 1e-322");
        assert_eq!(certain(Interval::point(0.1)), "0.1");
    }
}
