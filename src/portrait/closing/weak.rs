//! Cycles that are harmonic to rounding: where all damping is weak, they have a closed form.
//!
//! Measured at a cycle of amplitude A, damping and friction are D, `r/A`, `D2 A` and `D3 A^2`. Let all of them
//! be at most e. The equation of the amplitude (42) is odd in D, D3 and r, which change their signs when time
//! runs backward, and D2 by itself conserves the first integral K of [`super::balance`]: so what (42) leaves
//! out is e^2 of it. Extremes and period follow to first order; the next terms are smaller by e^2 again.
//!
//! There is no other cycle. On any motion K changes, at each step along q, by the weight `exp(2 D2 q)` times
//! `f = r + 2 D w + D3 w^3`, w being the speed. Let f have one zero, at w*. A motion that reaches four times this
//! speed and turns beyond a hundred `w*` passes, next to each of its turning points, from `4 w*` to `2 w*` over about
//! `6 w*^2/x` and from `w*` to rest over about `w*^2/(2 x)`, x being the distance of that turning point: and beyond
//! `2 w*` the magnitude of f is larger than it ever is below `w*`. So K changes the same way on every such motion,
//! which never closes. All others have an amplitude comparable with A: for them (42) holds.

use std::f64::consts::{PI, TAU};

use super::{Length, SwingPair};
use crate::closed_form::amplitudes;
use crate::model::Parameters;
use crate::numerics::cbrt;

/// Largest e: its square is far below rounding.
const WEAK: f64 = 1e-9;

/// The only cycle at these parameters, if it is harmonic to rounding.
///
/// Equation (42) with its one root, for `D3 <= 0`, or for `r = 0`; the turning points are at
/// `A0 -+ A - D2 A^2/6` with A0 of equation (40). Guarantee: relative errors of a few units in the last
/// place.
pub fn weak_closing(parameters: &Parameters) -> Option<SwingPair> {
    let Parameters { d, d2, d3, r } = *parameters;
    let one_zero = if r > 0.0 { d3 <= 0.0 } else { d * d3 < 0.0 };
    let [cycle] = amplitudes(parameters)[..] else { return None };
    let amplitude = cycle.amplitude;
    let bend = d2.abs() * amplitude;
    let cubic = d3.abs() * amplitude * amplitude;
    let strengths = [d.abs(), r / amplitude, bend, cubic];
    let square = PI * amplitude * amplitude;
    if !one_zero || !square.is_finite() || !strengths.iter().all(|&strength| strength <= WEAK) {
        return None;
    }
    // In the frame of the first swing, in which D2 >= 0, the left turning point is the farther one.
    let turning = [1.0, -1.0].map(|sign| amplitude * (1.0 + sign * 2.0 / 3.0 * bend) - r);
    Some(SwingPair::in_closed_form(turning.map(Length::new), TAU, square, amplitude))
}

/// Whether energy alone excludes cycles: whatever D2, the first integral K of [`super::balance`] changes the same
/// way on every motion.
///
/// It does where `r + 2 D w + D3 w^3` has the same sign for all speeds w.
pub fn is_one_way(parameters: &Parameters) -> bool {
    /// Beyond rounding.
    const CLEARLY: f64 = 1.0 - 1e-12;
    let Parameters { d, d3, r, .. } = *parameters;
    let loses = d >= 0.0 && d3 >= 0.0;
    let gains = r == 0.0 && d <= 0.0 && d3 <= 0.0;
    // The smallest value, at `w = 3 r/(4 abs(D))`, is positive for `-D^3 < (27/32) r^2 D3`.
    let loses_yet = d3 > 0.0 && -d < CLEARLY * cbrt(27.0_f64 / 32.0) * cbrt(r) * cbrt(r) * cbrt(d3);
    loses || gains || loses_yet
}

/// Whether there is a cycle for certain (see [`crate::branch::regime::Regime::of`]).
pub fn has_cycle(parameters: &Parameters) -> bool {
    let Parameters { d, d3, r, .. } = *parameters;
    if r > 0.0 {
        d3 < 0.0 && d > -1.0
    } else {
        (d < 0.0 && d3 > 0.0) || (d > 0.0 && d3 < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;
    use crate::numerics::elementary::cbrt;
    use crate::portrait::closing::all::{STEP, closings};
    use crate::portrait::closing::equation::Equation;

    #[test]
    fn where_both_can_the_search_finds_the_same_cycle_and_no_other() {
        for (d, d2, d3, r) in [
            (-1e-10, 1e-10, -1e-10, 1e-10),
            (-2e-10, -1e-9, 0.0, 1e-10),
            (1e-10, 3e-10, -1e-10, 2e-11),
            (0.0, -1e-10, -3e-10, 1e-11),
            (-1e-10, 2e-10, 3e-10, 0.0),
            (1e-10, -2e-10, -3e-10, 0.0),
        ] {
            let parameters = Parameters { d, d2, d3, r };
            let weak = weak_closing(&parameters).unwrap();
            let mut equation = Equation::new(&parameters, STEP, &Limits::PATIENT);
            let found = closings(&mut equation, usize::MAX, &[]).unwrap();
            assert_eq!(found.len(), 1, "{parameters:?}");
            let near = |one: f64, other: f64, within: f64| (one / other - 1.0).abs() <= within;
            for (one, other) in weak.clearances.iter().zip(found[0].clearances) {
                assert!(near(one.value, other.value, 1e-12), "{weak:?} {found:?}");
            }
            assert!(near(weak.duration, found[0].duration, 1e-14));
            assert!(near(weak.fastest[0], found[0].fastest[0], 1e-12));
            assert!(near(weak.fastest[1], found[0].fastest[1], 1e-12));
            let [one, other] = [&weak, &found[0]].map(|it| it.log_multiplier(&parameters));
            assert!(near(one, other, 1e-9), "{one:e} {other:e}");
        }
    }

    #[test]
    fn amplitudes_whose_square_is_no_number_have_no_answer_here() {
        let parameters = Parameters { d: -1.6e-150, d2: -1e-150, d3: 0.0, r: 2814.6 };
        assert_eq!(weak_closing(&parameters), None);
    }

    #[test]
    fn energy_changes_one_way_up_to_the_smallest_root_of_the_damping() {
        // Just beyond the bound, which holds for any D2, and just within.
        let edge = -cbrt(27.0_f64 / 32.0 * 0.01 * 0.5);
        for (d, one_way) in [(edge * (1.0 - 1e-9), true), (edge * (1.0 + 1e-9), false)] {
            assert_eq!(is_one_way(&Parameters { d, d2: 3.0, d3: 0.5, r: 0.1 }), one_way);
        }
        assert!(is_one_way(&Parameters { d: 0.0, d2: -1.0, d3: 0.0, r: 0.0 }));
        assert!(!is_one_way(&Parameters { d: 1e-150, d2: 0.0, d3: -1e-150, r: 0.0 }));
    }
}
