//! How far a friction law may be believed: up to the slip at which its coefficient falls below zero.

use super::{LawParts, LawPiece};
use crate::numerics::{TO_ROUNDING, bisect, exp, exp2, polynomial, pow};

/// The smallest slip, in m/s, beyond which the coefficient of friction is negative; infinite where there is
/// none.
pub fn first_below_zero(law: &LawParts) -> f64 {
    if let (Some(fall), Some((_, _, rest))) = (law.fall, law.pieces.first()) {
        return falling_zero(fall, rest);
    }
    let zero = |(from, to, coefficients): &LawPiece| {
        let begins_below = polynomial::value(coefficients, 0.0) < 0.0;
        let at = if begins_below {
            0.0
        } else {
            *zeros(coefficients, to - from).first()?
        };
        Some(from + at)
    };
    law.pieces.iter().find_map(zero).unwrap_or(f64::INFINITY)
}

/// The first zero of a law that falls over this velocity, on a fine ladder of slips: between two rungs it is monotone
/// but near its only minimum.
fn falling_zero((drop, velocity, exponent): (f64, f64, f64), rest: &[f64]) -> f64 {
    /// Rungs in a doubling of the slip.
    const RUNGS: i32 = 32;
    // From where the law has hardly fallen to where only its straight part is left.
    let [kinetic, viscous] = [0, 1].map(|power| *rest.get(power).unwrap_or(&0.0));
    let far = if viscous < 0.0 {
        2.0 * (kinetic / viscous).abs()
    } else {
        0.0
    };
    let last = far.max(1024.0 * velocity);
    let doublings = (0..).map(|rung| f64::from(rung - 20 * RUNGS) / f64::from(RUNGS));
    let ladder = doublings.map(|power| velocity * exp2(power));
    let fall = |slip: f64| drop * exp(-pow(slip / velocity, exponent));
    let negative = |slip: f64| kinetic + fall(slip) + viscous * slip < 0.0;
    let mut below = 0.0;
    for slip in ladder.take_while(|slip| *slip <= 2.0 * last) {
        if negative(slip) {
            return bisect(below, slip, TO_ROUNDING, negative).0;
        }
        below = slip;
    }
    f64::INFINITY
}

/// The zeros in `0 .. end` at which a polynomial changes its sign, in their order: between two zeros of its
/// derivative there is one at most.
pub fn zeros(coefficients: &[f64], end: f64) -> Vec<f64> {
    let value = |at: f64| polynomial::value(coefficients, at);
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let far = if end.is_finite() {
        end
    } else {
        beyond_zeros(coefficients)
    };
    let mut found = Vec::new();
    let mut from = 0.0;
    for to in zeros(&polynomial::derivative(coefficients), far).into_iter().chain([far]) {
        let (left, right) = (value(from), value(to));
        if (left < 0.0) != (right < 0.0) {
            let changed = |at: f64| (value(at) < 0.0) != (left < 0.0);
            found.push(bisect(from, to, TO_ROUNDING, changed).0);
        }
        from = to;
    }
    found
}

/// Cauchy's bound: all zeros are smaller.
fn beyond_zeros(coefficients: &[f64]) -> f64 {
    let Some(last) = coefficients.iter().rposition(|c| *c != 0.0) else { return 1.0 };
    let largest = coefficients[..last].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    1.0 + largest / coefficients[last].abs()
}
