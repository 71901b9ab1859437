//! Step sizes 1, 2 and 5 times a power of ten, and sums that stay decimal.
//!
//! A step of 0.01 from -0.1 should give -0.09, not -0.09000000000000001: sums are rounded to the digits that
//! both terms can have.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::numerics::elementary::{ln, log10};

/// A step size: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "f64", into = "f64")]
pub struct StepSize {
    mantissa: u8,
    exponent: i16,
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

/// Exponents of the smallest and the largest step: well within the range of floating-point numbers.
const EXPONENTS: std::ops::RangeInclusive<i16> = -290..=290;

/// Significant decimal digits that a double always preserves.
const DIGITS: i32 = 15;

impl StepSize {
    /// The step size nearest to a positive number, by ratio; 1 for anything else.
    pub fn near(value: f64) -> Self {
        if !(value > 0.0 && value.is_finite()) {
            return StepSize { mantissa: 1, exponent: 0 };
        }
        let exponent = decade(value).clamp(*EXPONENTS.start(), *EXPONENTS.end());
        let below = StepSize { mantissa: 1, exponent };
        let distance = |step: &StepSize| ln(step.value() / value).abs();
        [below, below.larger(), below.larger().larger(), below.larger().larger().larger()]
            .into_iter()
            .min_by(|a, b| distance(a).partial_cmp(&distance(b)).unwrap_or(Ordering::Equal))
            .unwrap_or(below)
    }

    pub fn value(self) -> f64 {
        decimal(&format!("{}e{}", self.mantissa, self.exponent))
    }

    /// The next larger step size, or this one at the end of the range.
    pub fn larger(self) -> Self {
        match self.mantissa {
            1 => StepSize { mantissa: 2, ..self },
            2 => StepSize { mantissa: 5, ..self },
            _ if self.exponent == *EXPONENTS.end() => self,
            _ => StepSize { mantissa: 1, exponent: self.exponent + 1 },
        }
    }

    /// The next smaller step size, or this one at the end of the range.
    pub fn smaller(self) -> Self {
        match self.mantissa {
            5 => StepSize { mantissa: 2, ..self },
            2 => StepSize { mantissa: 1, ..self },
            _ if self.exponent == *EXPONENTS.start() => self,
            _ => StepSize { mantissa: 5, exponent: self.exponent - 1 },
        }
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

/// The power of ten at or below a positive number.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a double has three digits")]
fn decade(value: f64) -> i16 {
    log10(value).floor() as i16
}

/// Parses digits that this module has written itself.
fn decimal(text: &str) -> f64 {
    text.parse().unwrap_or(0.0)
}

/// The sum of two decimal numbers, rounded to the decimals that the larger one can have; never `-0.0`.
pub fn decimal_sum(value: f64, by: f64) -> f64 {
    let largest = value.abs().max(by.abs());
    let sum = value + by;
    if !(largest > 0.0 && sum.is_finite()) {
        return sum;
    }
    let decimals = DIGITS - 1 - i32::from(decade(largest));
    let rounded = match usize::try_from(decimals) {
        Ok(decimals) => decimal(&format!("{sum:.decimals$}")),
        Err(_) => decimal(&format!("{sum:.14e}")),
    };
    rounded + 0.0
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
            step = step.larger();
            assert_eq!(step.value(), wanted);
        }
        for wanted in [0.1, 0.05, 0.02, 0.01, 0.005] {
            step = step.smaller();
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
        fn a_step_back_undoes_a_step(digits in -99_999..99_999_i32, decimals in 0..6_i32, size in -8..3_i16) {
            let value = decimal(&format!("{digits}e-{decimals}"));
            let step = StepSize { mantissa: 1, exponent: size };
            prop_assert_eq!(step.from(step.from(value, 1), -1), value);
        }

        #[test]
        fn every_number_has_a_step(value in proptest::num::f64::ANY) {
            let step = StepSize::near(value);
            prop_assert!(step.value() > 0.0 && step.value().is_finite());
            prop_assert!(!step.from(value, 1).is_nan() || value.is_nan());
        }
    }
}
