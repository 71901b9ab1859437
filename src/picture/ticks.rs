//! Ticks at round numbers, with labels of as many digits as they need.
//!
//! Ticks are integers times a power of ten, and labels are written from those integers, so two ticks
//! never share a label, whatever the rounding of floating point. Where the range is so narrow that
//! labels would be long rows of equal digits, the common part is split off as [`Ticks::base`].

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "powers of ten and counts of ticks are small, whatever the axis"
)]

use crate::numerics::{StepSize, decade, decimal, log10, pow};
use crate::scene::Span;

/// A tick: where it stands and what it says.
#[derive(Clone, Debug)]
pub struct Tick {
    /// Fraction of the axis, from 0 to 1.
    pub fraction: f64,
    /// The label, without the base.
    pub label: String,
}

/// Evenly spaced round ticks.
#[derive(Clone, Debug, Default)]
pub struct Ticks {
    /// What to add to every label, where labels count from a number other than zero.
    pub base: Option<String>,
    /// The ticks, from low to high.
    pub ticks: Vec<Tick>,
}

/// What the numbers along an axis stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scale {
    #[default]
    Even,
    /// Themselves in another unit.
    Times {
        /// What 1 is in that unit.
        factor: f64,
        /// What the axis is called there.
        name: &'static str,
    },
    /// Decimal logarithms of the magnitude of a quantity, whose own values are labelled with this sign: empty, or a minus.
    Logarithmic(&'static str),
}

impl Scale {
    /// What the numbers along the axis of a quantity are called in files.
    pub fn of_numbers(self, name: &str) -> String {
        match self {
            Scale::Even | Scale::Times { .. } => name.to_owned(),
            Scale::Logarithmic(sign) => format!("log10 {sign}{name}"),
        }
    }

    /// What the place of a value along the axis is labelled.
    pub fn value(self, place: f64) -> f64 {
        match self {
            Scale::Even => place,
            Scale::Times { factor, .. } => factor * place,
            Scale::Logarithmic("") => pow(10.0, place),
            Scale::Logarithmic(_) => -pow(10.0, place),
        }
    }

    /// What the axis of a quantity is called where its ticks are labelled.
    pub fn title(self, name: &str) -> &str {
        if let Scale::Times { name, .. } = self {
            name
        } else {
            name
        }
    }
}

/// Every how many decades are labelled, the finest first; and before these, digits within each decade.
const DECADES: [usize; 7] = [1, 2, 3, 5, 10, 20, 100];
const DIGITS_WITHIN: [i64; 3] = [1, 2, 5];

/// Maximum number of ticks that are ever considered: more than any screen can label.
const MOST: f64 = 60.0;

/// Part of a step by which rounding may push a tick over the end of the axis.
const ROUNDING: f64 = 1e-6;

/// Labels of more digits than this are split into a base and an offset.
const DIGITS: i32 = 6;

impl Ticks {
    /// The finest ticks on an axis of this scale that `fit`: decades where the axis is logarithmic, and
    /// round numbers between them where it is too short for two decades.
    pub fn on(scale: Scale, axis: Span, fit: impl Fn(&[Tick]) -> bool) -> Self {
        let sign = match scale {
            Scale::Even => return Ticks::fitting(axis, fit),
            Scale::Times { factor, .. } => {
                // Places on the axis are parts of it, whatever the unit.
                let scaled = Span::new(factor * axis.from(), factor * axis.to());
                return Ticks::fitting(scaled.unwrap_or(axis), fit);
            }
            Scale::Logarithmic(sign) => sign,
        };
        let within = std::iter::once((&DIGITS_WITHIN[..], 1));
        let decades = within.chain(DECADES.map(|every| (&DIGITS_WITHIN[..1], every)));
        let mut decades = decades.map(|(digits, every)| self::decades(axis, sign, digits, every));
        let fitting = decades.find(|ticks| fit(ticks));
        if let Some(ticks) = fitting.filter(|ticks| ticks.len() > 1) {
            return Ticks { base: None, ticks };
        }
        let Ok(values) = Span::new(pow(10.0, axis.from()), pow(10.0, axis.to())) else {
            return Ticks::default();
        };
        let bent = |ticks: &[Tick]| -> Vec<Tick> {
            let place = |tick: &Tick| axis.fraction(log10(values.at(tick.fraction)));
            let label = |tick: &Tick| format!("{sign}{}", tick.label);
            ticks.iter().map(|tick| Tick { fraction: place(tick), label: label(tick) }).collect()
        };
        let even = Ticks::fitting(values, |ticks| fit(&bent(ticks)));
        Ticks { base: even.base.clone(), ticks: bent(&even.ticks) }
    }

    /// The name of an axis with these ticks, whose labels may count from a base.
    pub fn named(&self, name: &str) -> String {
        let Some(base) = &self.base else { return name.into() };
        match base.strip_prefix('-') {
            Some(positive) => format!("{name}+{positive}"),
            None => format!("{name}-{base}"),
        }
    }

    /// The finest ticks that `fit`; none at all if not even a single one fits.
    pub fn fitting(axis: Span, fit: impl Fn(&[Tick]) -> bool) -> Self {
        let mut step = StepSize::at_least(axis.width() / MOST);
        loop {
            let ticks = ticks(step, axis);
            if ticks.ticks.is_empty() || fit(&ticks.ticks) {
                return ticks;
            }
            step = step.moved(1);
        }
    }
}

/// Ticks at these digits of every nth decade, on an axis of decimal logarithms.
fn decades(axis: Span, sign: &str, digits: &[i64], every: usize) -> Vec<Tick> {
    let (first, last) = (axis.from().floor() as i32, axis.to().ceil() as i32);
    let numbers = (first..=last)
        .filter(|power| (power.unsigned_abs() as usize).is_multiple_of(every))
        .flat_map(|power| digits.iter().map(move |digit| (*digit, power)));
    let tick = |(digit, power): (i64, i32)| Tick {
        fraction: axis.fraction(f64::from(power) + log10(digit as f64)),
        label: format!("{sign}{}", label(digit, power, digit, false)),
    };
    let on_the_axis = |tick: &Tick| (-ROUNDING..=1.0 + ROUNDING).contains(&tick.fraction);
    let clamped = |tick: Tick| Tick { fraction: tick.fraction.clamp(0.0, 1.0), ..tick };
    numbers.map(tick).filter(on_the_axis).map(clamped).collect()
}

/// All multiples of a step on the axis.
fn ticks(step: StepSize, axis: Span) -> Ticks {
    let (digit, power) = step.parts();
    let (base, value) = origin(axis, power).unzip();
    let value = value.unwrap_or(0.0);
    let (low, high) = (axis.from() - value, axis.to() - value);
    let width = step.value();
    let first = (low / width - ROUNDING).ceil() as i64;
    let last = (high / width + ROUNDING).floor() as i64;
    let place = |number| ((decimal(number, power) - low) / axis.width()).clamp(0.0, 1.0);
    let numbers: Vec<i64> = (first..=last).map(|count| count * digit).collect();
    let largest = numbers.iter().map(|number| number.abs()).max().unwrap_or(0);
    let tick = |number| Tick {
        fraction: place(number),
        label: label(number, power, largest, base.is_some()),
    };
    Ticks { ticks: numbers.into_iter().map(tick).collect(), base }
}

/// The number from which labels count, where they would be long if they counted from zero; first as it is written.
fn origin(axis: Span, power: i32) -> Option<(String, f64)> {
    if decade(axis.farthest()) - power < DIGITS {
        return None;
    }
    // A round number inside the axis or just below it, with as few digits as tell it apart.
    let coarse = decade(axis.width()) + 1;
    let digits = (decade(axis.from().abs()) - coarse).clamp(0, 16);
    let value = format!("{:.*e}", digits as usize, axis.from()).parse().ok()?;
    Some((crate::words::number::exact(value, 24), value))
}

/// Writes `number * 10^power`: plainly while the largest of its kind stays short, else with exponent.
fn label(number: i64, power: i32, largest: i64, signed: bool) -> String {
    let (value, sign) = (decimal(number, power), if signed && number > 0 { "+" } else { "" });
    let order = power + largest.max(1).ilog10() as i32;
    match power {
        _ if number == 0 => "0".into(),
        -4..0 if order < DIGITS => format!("{sign}{value:.*}", power.unsigned_abs() as usize),
        0.. if order < DIGITS - 1 => format!("{sign}{value}"),
        _ => format!("{sign}{value:e}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::powi;
    fn span(low: f64, high: f64) -> Span {
        Span::covering([low, high]).unwrap()
    }

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        let ticks = Ticks::fitting(span(low, high), |ticks| ticks.len() <= most);
        ticks.ticks.into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn labels_have_just_the_digits_needed() {
        assert_eq!(labels(-1.0, 1.0, 5), ["-1.0", "-0.5", "0", "0.5", "1.0"]);
        assert_eq!(labels(0.0, 10.0, 6), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(-0.012, 0.001, 4), ["-0.010", "-0.005", "0"]);
        assert_eq!(labels(0.0, 40_000.0, 5), ["0", "10000", "20000", "30000", "40000"]);
    }

    #[test]
    fn decades_of_a_logarithmic_axis_are_labelled_by_their_values() {
        let on = |scale, low: f64, high: f64, most: usize| {
            let ticks = Ticks::on(scale, span(low, high), |ticks| ticks.len() <= most).ticks;
            ticks.into_iter().map(|tick| (tick.label, tick.fraction)).collect::<Vec<_>>()
        };
        let names = |ticks: &[(String, f64)]| -> Vec<String> {
            ticks.iter().map(|(label, _)| label.clone()).collect()
        };
        let scale = Scale::Logarithmic("");
        assert_eq!(names(&on(scale, -2.0, 0.0, 4)), ["0.01", "0.1", "1"]);
        assert_eq!(names(&on(Scale::Logarithmic("-"), -2.0, 0.0, 4)), ["-0.01", "-0.1", "-1"]);
        assert_eq!(names(&on(scale, -1.0, 0.0, 4)), ["0.1", "0.2", "0.5", "1"]);
        assert_eq!(
            names(&on(scale, -6.0, 4.0, 6)),
            ["1e-6", "0.0001", "0.01", "1", "100", "10000"]
        );
        // Too short for two decades or their parts: round values.
        assert_eq!(names(&on(scale, 0.1, 0.28, 4)), ["1.4", "1.6", "1.8"]);
        for (label, fraction) in on(scale, -3.3, 2.2, 9) {
            let value: f64 = label.parse().unwrap();
            assert!((log10(value) - (-3.3 + 5.5 * fraction)).abs() < 1e-9, "{label} {fraction}");
        }
    }

    #[test]
    fn extremes_are_written_with_exponents() {
        assert_eq!(labels(0.0, 2e-31, 3), ["0", "1e-31", "2e-31"]);
        assert_eq!(labels(0.0, 2e12, 5), ["0", "5e11", "1e12", "1.5e12", "2e12"]);
    }

    #[test]
    fn a_narrow_range_splits_off_what_all_labels_share() {
        let ticks = Ticks::fitting(span(0.109_64, 0.109_64 + 3e-9), |ticks| ticks.len() <= 4);
        assert_eq!(ticks.base.as_deref(), Some("0.10964"));
        let labels: Vec<&str> = ticks.ticks.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, ["0", "+1e-9", "+2e-9", "+3e-9"]);
    }

    proptest! {
        #[test]
        fn ticks_lie_on_the_axis_evenly_with_distinct_labels(
            low in -1e300..1e300_f64, high in -1e300..1e300_f64, scale in -300..0_i32, most in 1_usize..30) {
            let scale = powi(10.0, scale);
            let ticks = Ticks::fitting(span(low * scale, high * scale), |ticks| ticks.len() <= most).ticks;
            prop_assert!(ticks.len() <= most);
            prop_assert!(ticks.iter().all(|tick| (0.0..=1.0).contains(&tick.fraction)));
            let gaps: Vec<f64> = ticks.windows(2).map(|pair| pair[1].fraction - pair[0].fraction).collect();
            prop_assert!(gaps.iter().all(|gap| (gap - gaps[0]).abs() < 1e-3 && *gap > 0.0), "{:?}", gaps);
            let mut labels: Vec<String> = ticks.into_iter().map(|tick| tick.label).collect();
            let count = labels.len();
            labels.sort();
            labels.dedup();
            prop_assert_eq!(labels.len(), count);
        }

        #[test]
        fn a_label_and_its_base_say_where_the_tick_stands(low in -1e6..1e6_f64, exponent in -12..6_i32) {
            let axis = span(low, low + powi(10.0, exponent));
            let ticks = Ticks::fitting(axis, |ticks| ticks.len() <= 8);
            let base: f64 = ticks.base.map_or(0.0, |base| base.parse().unwrap());
            for tick in ticks.ticks {
                let value = base + tick.label.parse::<f64>().unwrap();
                prop_assert!((axis.fraction(value) - tick.fraction).abs() < 1e-3, "{:?} {}", tick, value);
            }
        }

        #[test]
        fn every_wide_enough_axis_has_ticks(low in -10.0..10.0_f64, width in 0.001..20.0_f64) {
            let ticks = Ticks::fitting(span(low, low + width), |ticks| ticks.len() <= 6).ticks;
            prop_assert!(ticks.len() >= 2, "{} .. {}: {:?}", low, low + width, ticks);
        }
    }
}
