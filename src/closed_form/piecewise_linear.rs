//! The piecewise linear oscillator, `D2 = D3 = 0`: the cycle in closed form
//! (equations 25 to 33, corrected).
//!
//! With the clearance `c = abs(q) - r` of a turning point as the unknown, a half swing is one
//! multiplication: it takes `pi/omega` and ends at `X = c e^x` in the frame of its half plane, where
//! `x = -pi D/omega`; the next clearance is `X - 2 r`. For `D < 0` that map has one fixed point, the
//! unstable cycle that borders the basin of attraction of the sticking set.
//!
//! Clearances are computed as such and never as differences `q_max - r`, and their logarithms exist
//! where they underflow: at `D = -0.999` the clearance is 6.5e-31 r, at `D = -0.999999` it is
//! `e^(-2221)` r.

use super::LinearFlow;
use crate::numerics::{atan2, exp, exp_m1, ln, ln_1p};

/// The unstable cycle that borders the basin of attraction of the sticking set.
///
/// It is symmetric: `q_min = -q_max`, `v_min = -v_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearCycle {
    /// Linear damping, between -1 and 0.
    pub d: f64,
    /// Friction, positive.
    pub r: f64,
    /// `c = q_max - r = 2 r/(e^x - 1)` (equation 30); 0 where it underflows.
    pub clearance: f64,
    /// Natural logarithm of the clearance; always finite.
    pub log_clearance: f64,
    /// Right turning point `A_q = r + c` (equation 32).
    pub q_max: f64,
    /// Largest velocity `A_v` (equation 33, corrected: as printed it has the wrong sign).
    pub v_max: f64,
    /// Period `2 pi/omega`.
    pub period: f64,
    /// Floquet multiplier `e^(2 x)`; `None` where it overflows.
    pub multiplier: Option<f64>,
    /// Natural logarithm `2 x` of the multiplier.
    pub log_multiplier: f64,
}

/// Above this exponent `e^x` comes near its overflow and is taken in two factors.
const LARGE_EXPONENT: f64 = 600.0;

impl LinearCycle {
    /// The cycle at damping `d` and friction `r`. There is none for `D >= 0`, where every motion loses energy (or
    /// keeps it, for `D = r = 0`); for `D <= -1`, where no swing recurs; and for `r = 0`, where it has shrunk to
    /// the steady state.
    ///
    /// Guarantee: every number is right to a few units in its last place, from `D = -1e-150` to the
    /// last double above -1 (`log_clearance` to a few units of 1e-16 where it is small itself).
    #[must_use]
    pub fn new(d: f64, r: f64) -> Option<Self> {
        if !(d < 0.0 && r > 0.0) {
            return None;
        }
        let linear = LinearFlow::new(d);
        let (omega, growth) = (linear.omega()?, linear.log_growth()?);
        let x = growth.high;
        let clearance = if x < LARGE_EXPONENT {
            2.0 * r / growth.exp_m1()
        } else {
            let half = growth.times(-0.5).exp();
            2.0 * r * half * half
        };
        let tiny = || ln(2.0 * r) - x - ln_1p(-exp(-x));
        let log_clearance = if clearance.is_normal() { ln(clearance) } else { tiny() };
        let q_max = r + clearance;
        // The largest velocity comes a quarter turn and some before the end of the half swing: counted
        // back from there, nothing under- or overflows.
        let before_end = atan2(omega.high, -d);
        let v_max = 2.0 * r / -exp_m1(-x) * exp(d * (before_end / omega.high));
        let multiplier = growth.times(2.0).exp();
        Some(LinearCycle {
            d,
            r,
            clearance,
            log_clearance,
            q_max,
            v_max,
            period: 2.0 * linear.half_period()?,
            multiplier: multiplier.is_finite().then_some(multiplier),
            log_multiplier: 2.0 * x,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::reference::rows;
    use super::*;
    use crate::numerics::elementary::{exp, exp2, ln, powi};

    fn close(got: f64, expected: f64, ulps: f64) -> bool {
        (got - expected).abs() <= ulps * f64::EPSILON * expected.abs()
    }

    #[test]
    fn cycles_agree_with_sixty_digit_arithmetic() {
        for row in rows(include_str!("../../tests/data/linear_cycles.csv")) {
            let [d, clearance, log_clearance, v_max, period, log_multiplier] = row[..] else {
                panic!("{row:?}")
            };
            let cycle = LinearCycle::new(d, 1.0).unwrap();
            assert!(close(cycle.clearance, clearance, 4.0), "{cycle:?}");
            assert!(close(cycle.log_clearance, log_clearance, 4.0), "{cycle:?}");
            assert!(close(cycle.v_max, v_max, 4.0), "{cycle:?}");
            assert!(close(cycle.period, period, 4.0), "{cycle:?}");
            assert!(close(cycle.log_multiplier, log_multiplier, 4.0), "{cycle:?}");
        }
    }

    #[test]
    fn multipliers_that_overflow_are_absent_but_have_a_logarithm() {
        let cycle = LinearCycle::new(-0.999_999, 1.0).unwrap();
        assert_eq!((cycle.multiplier, cycle.clearance, cycle.q_max), (None, 0.0, 1.0));
        let cycle = LinearCycle::new(-0.999, 1.0).unwrap();
        assert!(close(cycle.multiplier.unwrap(), exp(cycle.log_multiplier), 200.0));
    }

    #[test]
    fn next_to_the_ends_of_the_range_the_cycle_is_still_there() {
        assert_eq!(LinearCycle::new(-1.0_f64.next_up(), 1.0), None);
        let above = LinearCycle::new((-1.0_f64).next_up(), 1.0).unwrap();
        // omega = sqrt(2^-52 - 2^-106), and A_v tends to 2 r/e.
        let omega = (powi(2.0, -52)).sqrt();
        assert!(close(above.log_clearance, ln(2.0) - std::f64::consts::PI / omega, 8.0));
        assert!(close(above.v_max, 2.0 / std::f64::consts::E, 1e8));
        for r in [1e-150, 1e150] {
            let weak = LinearCycle::new(-1e-150, r).unwrap();
            assert!(close(weak.q_max, r * 2.0 / std::f64::consts::PI / 1e-150, 8.0));
            assert!(close(weak.v_max, weak.q_max, 8.0) && weak.multiplier == Some(1.0));
        }
    }

    #[test]
    fn without_self_excitation_or_friction_there_is_no_cycle() {
        for d in [0.0, -0.0, 1e-150, 0.5, 1.0, 2.0, f64::NAN, -1.0, -1.001, -1e6] {
            assert_eq!(LinearCycle::new(d, 1.0), None, "{d}");
        }
        assert_eq!(LinearCycle::new(-0.1, 0.0), None);
    }

    proptest! {
        #[test]
        fn the_cycle_is_the_fixed_point_of_the_half_swing(d in -0.99..-1e-6, r in 1e-3..1e3) {
            let cycle = LinearCycle::new(d, r).unwrap();
            let swing = LinearFlow::new(d).first_standstill(-cycle.clearance, 0.0).unwrap();
            // X - 2 r, with X = c e^x, is c again to rounding of X.
            prop_assert!((swing.x - 2.0 * r - cycle.clearance).abs() <= 8.0 * f64::EPSILON * swing.x);
            prop_assert!(close(2.0 * swing.time, cycle.period, 2.0));
            let growth = swing.x / cycle.clearance;
            prop_assert!(close(growth * growth, cycle.multiplier.unwrap(), 100.0));
        }

        #[test]
        fn scaling_by_a_power_of_two_changes_no_bit(d in -0.999..-1e-9, r in 0.5..2.0, k in -300_i32..300) {
            let unit = exp2(f64::from(k));
            let (plain, big) = (LinearCycle::new(d, r).unwrap(), LinearCycle::new(d, r * unit).unwrap());
            prop_assert_eq!(plain.clearance * unit, big.clearance);
            prop_assert_eq!((plain.q_max * unit, plain.v_max * unit), (big.q_max, big.v_max));
            prop_assert_eq!((plain.period, plain.multiplier), (big.period, big.multiplier));
        }
    }
}
