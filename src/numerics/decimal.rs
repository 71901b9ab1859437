//! Decimal numbers: as text that parses back to the same number; and round ones, 1, 2 or 5 times a power of ten, by which
//! values are stepped and axes are marked.
//!
//! A step of 0.01 from -0.1 should give -0.09, not -0.09000000000000001: sums are rounded to the digits that both terms
//! can have.

use serde::{Deserialize, Serialize};

use super::{by_number, ln, log10, powi, truncated};

/// The shortest text that parses back to this number, without a redundant `.0`.
pub fn shortest(value: f64) -> String {
    // Debug, unlike Display, writes very large and very small numbers with an exponent.
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// The same with an exponent where that saves zeros: `1e12`, but `1000`.
pub fn brief(value: f64) -> String {
    let (plain, scientific) = (shortest(value), format!("{value:e}"));
    if plain.len() > scientific.len() + 1 {
        scientific
    } else {
        plain
    }
}

/// Writes `value` with at most `digits` significant digits, without trailing zeros.
///
/// Magnitudes from `1e-4` up to `1e6` are written plainly, others with an exponent.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let digits = digits.max(1);
    let scientific = format!("{value:.*e}", digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    match exponent.parse::<isize>() {
        Ok(power @ -4..6) => {
            let decimals = (digits - 1).saturating_add_signed(-power);
            without_trailing_zeros(&format!("{value:.decimals$}")).into()
        }
        _ => format!("{}e{exponent}", without_trailing_zeros(mantissa)),
    }
}

/// Writes `value` with only the digits needed to distinguish numbers that are `resolution` apart.
pub fn resolved(value: f64, resolution: f64) -> String {
    let ratio = log10(value.abs() / resolution);
    let digits = truncated((ratio.ceil() + 1.0).clamp(1.0, 17.0));
    if ratio < 0.0 {
        "0".into()
    } else {
        significant(value, digits)
    }
}

/// Writes `value` and its standard error, each with the digits that count, and their unit.
pub fn with_error(value: f64, error: f64, unit: &str) -> String {
    let value = resolved(value, 0.05 * error);
    in_unit(&format!("{value} +- {}", significant(error, 2)), unit)
}

/// A number with its unit, if that is known.
pub fn in_unit(number: &str, unit: &str) -> String {
    format!("{number} {unit}").trim_end().to_owned()
}

fn without_trailing_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// A step size: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "f64", into = "f64")]
pub struct StepSize {
    /// Its place among all step sizes, three in each decade; that of 1 is 0.
    place: i32,
}

impl From<f64> for StepSize {
    fn from(value: f64) -> Self {
        StepSize::near(value)
    }
}

impl From<StepSize> for f64 {
    fn from(step: StepSize) -> Self {
        step.value()
    }
}

/// Places of the smallest and the largest step: within the range of floating-point numbers.
const PLACES: std::ops::RangeInclusive<i32> = -921..=923;

/// Significant decimal digits that a double always preserves.
const DIGITS: i32 = 15;

impl StepSize {
    /// The step size nearest to a positive number, by ratio; 1 for anything else.
    pub fn near(value: f64) -> Self {
        if !(value > 0.0 && value.is_finite()) {
            return StepSize { place: 0 };
        }
        let below = StepSize { place: 0 }.moved(3 * decade(value));
        let distance = |step: &StepSize| ln(step.value() / value).abs();
        let candidates = (0..=3).map(|places| below.moved(places));
        candidates.min_by(by_number(distance)).unwrap_or(below)
    }

    /// The smallest step size that is not below a positive number.
    pub fn at_least(value: f64) -> Self {
        let near = StepSize::near(value);
        if near.value() < value { near.moved(1) } else { near }
    }

    pub fn value(self) -> f64 {
        let (digit, power) = self.parts();
        decimal(digit, power)
    }

    /// Its digit and its power of ten.
    pub fn parts(self) -> (i64, i32) {
        let digit = [1, 2, 5][self.place.rem_euclid(3).unsigned_abs() as usize];
        (digit, self.place.div_euclid(3))
    }

    /// The step size that is some places larger, or the one at the end of the range.
    pub fn moved(self, places: i32) -> Self {
        StepSize { place: (self.place + places).clamp(*PLACES.start(), *PLACES.end()) }
    }

    /// `value` moved by `count` steps, rounded to its own decimals and those of the step.
    pub fn from(self, value: f64, count: i32) -> f64 {
        decimal_sum(value, f64::from(count) * self.value())
    }

    /// The multiple of the step that is `count` multiples from `value`. If `value` lies between two multiples,
    /// the first step leads to the next multiple in that direction.
    pub fn multiple_from(self, value: f64, count: i32) -> f64 {
        let steps = value / self.value();
        // A value within rounding of a multiple counts as that multiple.
        let near = steps.round();
        let on = (steps - near).abs() <= 1e-9;
        let base = match (on, count > 0) {
            (true, _) => near,
            (false, true) => steps.floor(),
            (false, false) => steps.ceil(),
        };
        decimal_sum(0.0, (base + f64::from(count)) * self.value())
    }
}

/// The power of ten at or below a positive number; far below all others for zero.
#[expect(clippy::cast_possible_truncation, reason = "exponents have three digits")]
pub fn decade(value: f64) -> i32 {
    log10(value).floor().max(-400.0) as i32
}

/// `number * 10^power`, correctly rounded.
#[expect(
    clippy::cast_precision_loss,
    reason = "numbers beyond the range of exact doubles are parsed"
)]
pub fn decimal(number: i64, power: i32) -> f64 {
    /// Powers of ten up to this one, and the whole numbers below, are doubles: one operation on them rounds correctly.
    const EXACT: (i32, u64) = (22, 1 << 53);
    if power.abs() > EXACT.0 || number.unsigned_abs() > EXACT.1 {
        return format!("{number}e{power}").parse().unwrap_or(0.0);
    }
    let factor = powi(10.0, power.abs());
    if power < 0 {
        number as f64 / factor
    } else {
        number as f64 * factor
    }
}

/// The sum of two decimal numbers, rounded to the decimals that the larger one can have; never `-0.0`.
pub fn decimal_sum(value: f64, by: f64) -> f64 {
    let largest = value.abs().max(by.abs());
    let sum = value + by;
    if !(largest > 0.0 && sum.is_finite()) {
        return sum;
    }
    let written = match usize::try_from(DIGITS - 1 - decade(largest)) {
        Ok(decimals) => format!("{sum:.decimals$}"),
        Err(_) => format!("{sum:.14e}"),
    };
    written.parse().unwrap_or(sum) + 0.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn sums_of_decimals_are_decimals() {
        let hundredth = StepSize::near(0.01);
        assert_eq!(hundredth.from(-0.1, 1), -0.09);
        assert_eq!(hundredth.from(-0.03, 3), 0.0);
        assert!(hundredth.from(-0.01, 1).is_sign_positive());
        assert_eq!(hundredth.from(0.1234, 1), 0.1334);
        assert_eq!(StepSize::near(1.0).from(1.1, -1), 0.1);
        assert_eq!(StepSize::near(1e20).from(3e20, 1), 4e20);
        assert_eq!(StepSize::near(1e-12).from(-1e-12, 1), 0.0);
    }

    #[test]
    fn sizes_go_one_two_five() {
        let mut step = StepSize::near(0.01);
        for wanted in [0.02, 0.05, 0.1, 0.2] {
            step = step.moved(1);
            assert_eq!(step.value(), wanted);
        }
        for wanted in [0.1, 0.05, 0.02, 0.01, 0.005] {
            step = step.moved(-1);
            assert_eq!(step.value(), wanted);
        }
    }

    #[test]
    fn multiples_are_met_from_between_and_left_from_on_them() {
        let tenth = StepSize::near(0.1);
        assert_eq!(tenth.multiple_from(0.3, 1), 0.4);
        assert_eq!(tenth.multiple_from(0.34, 1), 0.4);
        assert_eq!(tenth.multiple_from(0.34, -1), 0.3);
        assert_eq!(tenth.multiple_from(-0.1, 1), 0.0);
    }

    proptest! {
        #[test]
        fn a_step_back_undoes_a_step(digits in -99_999..99_999_i64, decimals in 0..6_i32, size in -8..3_i32) {
            let value = decimal(digits, -decimals);
            let step = StepSize { place: 3 * size };
            prop_assert_eq!(step.from(step.from(value, 1), -1), value);
        }

        #[test]
        fn a_decimal_is_what_its_digits_say(number in -10_000_000..10_000_000_i64, power in -40..40_i32) {
            prop_assert_eq!(decimal(number, power), format!("{number}e{power}").parse::<f64>().unwrap());
        }

        #[test]
        fn every_number_has_a_step(value in proptest::num::f64::ANY) {
            let step = StepSize::near(value);
            prop_assert!(step.value() > 0.0 && step.value().is_finite());
            prop_assert!(!step.from(value, 1).is_nan() || value.is_nan());
        }
    }

    #[test]
    fn round_numbers_are_brief() {
        for (value, text) in
            [(1e6, "1e6"), (-1e12, "-1e12"), (100.0, "100"), (0.01, "0.01"), (0.1, "0.1")]
        {
            assert_eq!(brief(value), text);
        }
    }

    #[test]
    fn numbers_are_written_short_and_read_back() {
        for (value, text) in [(1.0, "1"), (-0.1, "-0.1"), (1e300, "1e300"), (1e-10, "1e-10")] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse(), Ok(value));
        }
    }
}
