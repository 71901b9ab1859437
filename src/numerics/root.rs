//! Zeros of functions of one variable, inside brackets.
//!
//! [`newton`] is for functions with a known derivative, [`illinois`] for those without, [`bisect`] for
//! conditions, and [`maximum`] for the largest value. Each ends after a fixed number of evaluations, whatever
//! the function does. The versions named `try_..` are for functions that may fail; they stop at the first error.

use std::convert::Infallible;

/// No limit on halvings: [`bisect`] then ends at two neighbouring doubles.
pub const TO_ROUNDING: u32 = u32::MAX;

/// An interval at whose ends a function has opposite signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// Whether the function is positive at the upper end.
    pub rising: bool,
}

impl Bracket {
    /// A bracket of a function that is positive at `high` but not at `low`.
    pub fn rising(low: f64, high: f64) -> Self {
        Bracket { low, high, rising: true }
    }

    /// A bracket of a function that is positive at `low` but not at `high`.
    pub fn falling(low: f64, high: f64) -> Self {
        Bracket { low, high, rising: false }
    }

    pub fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// `place` if it lies between the ends, otherwise the middle.
    pub fn inside(&self, place: f64) -> f64 {
        if place > self.low && place < self.high {
            place
        } else {
            self.middle()
        }
    }

    /// Moves one end to `place`, where the function has this value.
    pub fn narrow(&mut self, place: f64, value: f64) {
        *(if (value > 0.0) == self.rising {
            &mut self.high
        } else {
            &mut self.low
        }) = place;
    }

    /// The same, with the place inside to which Newton's method goes from there; `None` from a zero, and where no double
    /// lies between the ends.
    pub fn step(&mut self, place: f64, value: f64, slope: f64) -> Option<f64> {
        self.narrow(place, value);
        let next = self.inside(place - value / slope);
        (value != 0.0 && next > self.low && next < self.high).then_some(next)
    }
}

/// The change of the place at which a search ends.
#[derive(Clone, Copy, Debug)]
pub enum PlaceTolerance {
    /// An absolute change.
    Absolute(f64),
    /// A change relative to the place.
    Relative(f64),
}

impl PlaceTolerance {
    fn at(self, place: f64) -> f64 {
        match self {
            PlaceTolerance::Absolute(change) => change,
            PlaceTolerance::Relative(part) => part * place.abs(),
        }
    }
}

/// Newton's method from `start` inside a bracket, which is halved wherever a step would leave it.
///
/// `function` returns the value and the derivative. Assumption: it is continuous on the bracket and has the
/// bracket's signs at the ends. Guarantee: the result lies in the final bracket, at whose ends the function
/// still has these signs. Near a simple zero the error of the result is about the square of the last step,
/// relative to the length over which the function bends; half the desired digits therefore suffice for `settled`.
///
/// Hard-wired: 200 evaluations. Newton's method takes about five, and bisection to rounding about sixty.
#[inline]
pub fn newton(
    bracket: Bracket,
    start: f64,
    settled: PlaceTolerance,
    mut function: impl FnMut(f64) -> (f64, f64),
) -> f64 {
    let Ok((at, _)) = try_newton(bracket, start, settled, |at| Ok::<_, Infallible>(function(at)));
    at
}

/// [`newton`] for a function that may fail, with the final bracket, as the signs of the evaluations have established it.
#[inline]
pub fn try_newton<E>(
    mut bracket: Bracket,
    start: f64,
    settled: PlaceTolerance,
    mut function: impl FnMut(f64) -> Result<(f64, f64), E>,
) -> Result<(f64, Bracket), E> {
    const EVALUATIONS: u32 = 200;
    let mut at = start;
    for _ in 0..EVALUATIONS {
        let (value, slope) = function(at)?;
        let next = bracket.step(at, value, slope);
        let newton = at - value / slope;
        if (newton - at).abs() <= settled.at(at) {
            return Ok((newton.clamp(bracket.low, bracket.high), bracket));
        }
        let Some(next) = next else { break };
        at = next;
    }
    Ok((at, bracket))
}

/// The point between `without` and `with` where a condition begins to hold, in at most this many halvings.
///
/// Assumption: the condition holds at `with` and not at `without`; neither is tested. Guarantee: the result is
/// a pair of places, without and with the condition, whose distance is the initial one divided by `2^halvings`,
/// or which are neighbouring doubles. If the condition changes more than once, this is one of the changes.
pub fn bisect(
    without: f64,
    with: f64,
    halvings: u32,
    mut holds: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    let Ok(ends) = try_bisect(without, with, halvings, |at| Ok::<_, Infallible>(holds(at)));
    ends
}

/// [`bisect`] for a condition that may fail.
pub fn try_bisect<E>(
    mut without: f64,
    mut with: f64,
    halvings: u32,
    mut holds: impl FnMut(f64) -> Result<bool, E>,
) -> Result<(f64, f64), E> {
    for _ in 0..halvings {
        let middle = f64::midpoint(without, with);
        if middle == without || middle == with || middle.is_nan() {
            break;
        }
        *(if holds(middle)? { &mut with } else { &mut without }) = middle;
    }
    Ok((without, with))
}

/// The Illinois method: secants inside a bracket, halving the value at an end that is kept twice.
///
/// Assumption: `ends` are two places with values of opposite sign, or 0, of a continuous function. Guarantee:
/// the result is the final bracket, places and values, with the value of smaller magnitude first. The search
/// ends when a value is at most `small` in magnitude (never, if `small` is negative) or the bracket is at most
/// `width` wide. An infinite value makes the next step a halving.
///
/// Hard-wired: 100 evaluations. The order of convergence is 1.44, so ten are usual.
pub fn illinois<E>(
    ends: [(f64, f64); 2],
    small: f64,
    width: PlaceTolerance,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<[(f64, f64); 2], E> {
    const EVALUATIONS: u32 = 100;
    let [mut one, mut other] = ends;
    // The values as weighted by the secant.
    let (mut weight, mut weight_of_other) = (one.1, other.1);
    let mut moved = None;
    for _ in 0..EVALUATIONS {
        let size = one.0.abs().max(other.0.abs());
        let least = one.1.abs().min(other.1.abs());
        if least <= small || (other.0 - one.0).abs() <= width.at(size) {
            break;
        }
        let secant = one.0 - weight * (other.0 - one.0) / (weight_of_other - weight);
        let bracket = Bracket::rising(one.0.min(other.0), one.0.max(other.0));
        let at = bracket.inside(secant);
        if at <= bracket.low || at >= bracket.high {
            break;
        }
        let value = function(at)?;
        let first = (value > 0.0) == (one.1 > 0.0);
        let factor = if moved == Some(first) { 0.5 } else { 1.0 };
        if first {
            (one, weight, weight_of_other) = ((at, value), value, factor * weight_of_other);
        } else {
            (other, weight_of_other, weight) = ((at, value), value, factor * weight);
        }
        moved = Some(first);
    }
    Ok(if one.1.abs() < other.1.abs() {
        [one, other]
    } else {
        [other, one]
    })
}

/// A bracket at most `width` wide around the maximum of a function, by golden section search.
///
/// Assumption: the function has one maximum between `low` and `high`. Guarantee: the bracket contains it. A
/// maximum is flat, so rounding hides about half of the digits of its place, but none of its value.
///
/// Hard-wired: 100 evaluations, which shrink a bracket by 20 orders of magnitude.
pub fn maximum(low: f64, high: f64, width: f64, function: impl Fn(f64) -> f64) -> (f64, f64) {
    let Ok(ends) = try_maximum(low, high, width, |at| Ok::<_, Infallible>(function(at)));
    ends
}

/// [`maximum`] for a function that may fail.
pub fn try_maximum<E>(
    mut low: f64,
    mut high: f64,
    width: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(f64, f64), E> {
    const EVALUATIONS: u32 = 100;
    /// The smaller fraction of a golden section.
    const GOLDEN: f64 = 0.381_966_011_250_105_2;
    let mut value = |at: f64| function(at).map(|value| (at, value));
    let mut left = value(low + GOLDEN * (high - low))?;
    let mut right = value(high - GOLDEN * (high - low))?;
    for _ in 2..EVALUATIONS {
        if high - low <= width {
            break;
        }
        if left.1 > right.1 {
            (high, right) = (right.0, left);
            left = value(low + GOLDEN * (high - low))?;
        } else {
            (low, left) = (left.0, right);
            right = value(high - GOLDEN * (high - low))?;
        }
    }
    Ok((low, high))
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::{atan, cbrt, pow, powi, sinh, tan};

    #[test]
    fn newton_settles_within_a_few_evaluations_and_keeps_its_bracket() {
        let count = Cell::new(0);
        let cube = |x: f64| {
            count.set(count.get() + 1);
            Ok::<_, Infallible>((x * x * x - 2.0, 3.0 * x * x))
        };
        let settled = PlaceTolerance::Relative(1e-9);
        let Ok((at, bracket)) = try_newton(Bracket::rising(0.0, 2.0), 2.0, settled, cube);
        assert!((at - cbrt(2.0)).abs() <= f64::EPSILON && count.get() <= 7, "{at}");
        assert!(bracket.low <= at && at <= bracket.high);
    }

    /// Unprotected, Newton's method would diverge on `atan`, divide by zero on the plateau, and cycle.
    #[test]
    fn newton_finds_what_newton_alone_would_lose() {
        let far =
            newton(Bracket::rising(-30.0, 50.0), 50.0, PlaceTolerance::Absolute(0.0), |x: f64| {
                (atan(x) - 0.25, 1.0 / (1.0 + x * x))
            });
        assert!((far - tan(0.25)).abs() < 1e-15, "{far:?}");
        let flat =
            newton(Bracket::rising(0.0, 8.0), 1.0, PlaceTolerance::Absolute(0.0), |x: f64| {
                if x < 3.0 { (-1.0, 0.0) } else { (x - 4.0, 1.0) }
            });
        assert_eq!(flat, 4.0);
        let cycling =
            newton(Bracket::rising(-2.0, 2.0), 0.0, PlaceTolerance::Relative(1e-9), |x: f64| {
                (powi(x, 3) - 2.0 * x + 2.0 - 4.0, 3.0 * x * x - 2.0)
            });
        assert!((powi(cycling, 3) - 2.0 * cycling - 2.0).abs() < 1e-14, "{cycling:?}");
    }

    #[test]
    fn what_is_not_a_number_ends_the_search_as_a_bracket() {
        let count = Cell::new(0);
        let root = newton(Bracket::falling(0.0, 1.0), 0.5, PlaceTolerance::Relative(1e-9), |_| {
            count.set(count.get() + 1);
            (f64::NAN, f64::NAN)
        });
        assert!((0.0..=1.0).contains(&root) && count.get() <= 200, "{root:?}");
    }

    #[test]
    fn bisection_ends_at_neighbouring_doubles_in_both_directions() {
        let (without, with) = bisect(0.0, 10.0, TO_ROUNDING, |x| x * x >= 2.0);
        assert_eq!(without.next_up(), with);
        assert!(without * without < 2.0 && with * with >= 2.0);
        assert_eq!(bisect(10.0, 0.0, TO_ROUNDING, |x| x * x < 2.0), (with, without));
        assert_eq!(bisect(0.0, 1.0, 3, |x| x > 0.3), (0.25, 0.375));
        assert_eq!(bisect(-f64::MAX, f64::MAX, TO_ROUNDING, |x| x >= 0.0).1, 0.0);
    }

    #[test]
    fn the_largest_value_is_bracketed() {
        let count = Cell::new(0);
        let (low, high) = maximum(-1.0, 5.0, 1e-6, |x| {
            count.set(count.get() + 1);
            -(x - 0.7).abs()
        });
        assert!(low <= 0.7 && 0.7 <= high && high - low <= 1e-6 && count.get() <= 40);
        let (_, end) = maximum(0.0, 1.0, 1e-9, |x| x);
        assert_eq!(end, 1.0);
        assert_eq!(try_maximum(0.0, 1.0, 1e-9, |_| Err::<f64, _>("no value")), Err("no value"));
    }

    proptest! {
        /// `sinh(k (x - root))` ranges from nearly straight to strongly bent.
        #[test]
        fn illinois_finds_the_root(root in -1.0..1.0_f64, k in 0.01..5.0_f64, back in any::<bool>()) {
            let function = |x: f64| sinh(k * (x - root));
            let mut ends = [(-2.0, function(-2.0)), (2.5, function(2.5))];
            if back {
                ends.reverse();
            }
            let count = Cell::new(0);
            let found = illinois(ends, 0.0, PlaceTolerance::Absolute(1e-15), |x| {
                count.set(count.get() + 1);
                Ok::<_, Infallible>(function(x))
            });
            let Ok([(at, value), other]) = found;
            prop_assert!(value == 0.0 || (value > 0.0) != (other.1 > 0.0));
            prop_assert!((at - root).abs() < 4e-15 && count.get() <= 60, "{} {}", at, count.get());
            prop_assert_eq!(value, function(at));
        }

        #[test]
        fn newton_ends_within_its_bracket(root in 0.01..0.99_f64, power in 1_i32..12, start in 0.0..1.0_f64) {
            let function = |x: f64| {
                let n = f64::from(power);
                let slope = n * pow((x - root).abs(), n - 1.0);
                Ok::<_, Infallible>((pow((x - root).abs(), n).copysign(x - root), slope))
            };
            let settled = PlaceTolerance::Relative(1e-9);
            let Ok((at, bracket)) = try_newton(Bracket::rising(0.0, 1.0), start, settled, function);
            let Bracket { low, high, .. } = bracket;
            prop_assert!(low <= root && root <= high && low <= at && at <= high);
            prop_assert!((at - root).abs() < 1e-7, "{} {:?}", at, bracket);
        }
    }
}
