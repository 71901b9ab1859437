//! The linear oscillator `x'' + 2 D x' + x = 0`, solved in closed form for every damping D.
//!
//! With `D2 = D3 = 0` each half swing is a piece of this motion in the frame of its half plane
//! ([`crate::model::HalfPlane`]). The fundamental solutions `e^(-D t) C(t)` and `e^(-D t) S(t)` are
//!
//! | | C | S |
//! |---|---|---|
//! | `abs(D) < 1` | `cos(omega t)` | `sin(omega t)/omega` |
//! | `abs(D) = 1` | 1 | t |
//! | `abs(D) > 1` | `cosh(kappa t)` | `sinh(kappa t)/kappa` |
//!
//! with `omega = sqrt(1 - D^2)`, `kappa = sqrt(D^2 - 1)`; `S` is written as `t` times a function that
//! tends to 1, so that nothing is divided by a small frequency. Frequencies, phases and exponents are
//! carried in twice the working precision. All operations are linear in the state: a state scaled by
//! a power of two, or mirrored, gives the scaled or mirrored result to the last bit.

use crate::numerics::twofold::PI;
use crate::numerics::{Twofold, atan, cosh, ln, ln_1p, sinh};

/// The flow of `x'' + 2 D x' + x = 0` with what depends on D alone worked out once.
#[derive(Clone, Copy, Debug)]
pub struct LinearFlow {
    d: f64,
    /// omega or kappa.
    frequency: Twofold,
}

/// Where and when a motion stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standstill {
    /// Time since the start.
    pub time: f64,
    /// Position there.
    pub x: f64,
}

/// Where hyperbolic functions give way to single exponentials: below, these cancel; above, those do.
const HYPERBOLIC: f64 = 1.0;

impl LinearFlow {
    /// The flow with damping `d`, `abs(d) < 1e150`.
    pub fn new(d: f64) -> Self {
        LinearFlow { d, frequency: Twofold::from_one_minus_square(d).sqrt() }
    }

    /// Whether motions oscillate: `abs(D) < 1`.
    pub fn oscillates(&self) -> bool {
        self.d.abs() < 1.0
    }

    /// `sqrt(1 - D^2)` in twice the working precision, where motions oscillate.
    pub fn omega(&self) -> Option<Twofold> {
        self.oscillates().then_some(self.frequency)
    }

    /// Duration of a half swing from rest, `pi/omega`, where motions oscillate.
    pub fn half_period(&self) -> Option<f64> {
        self.omega().map(|omega| (PI / omega).value())
    }

    /// Natural logarithm of the growth in a half swing from rest, `-pi D/omega`, where motions oscillate.
    pub fn log_growth(&self) -> Option<Twofold> {
        self.omega().map(|omega| PI.times(-self.d) / omega)
    }

    /// The state at time `t` of the motion through `(x, v)` at time 0 (equations 25 to 27).
    ///
    /// Guarantee: the error is a few units in the last place of `max(abs(x(t)), abs(v(t)))`, times
    /// `max(1, t)` where the state passes near an eigenvector of nearly critical damping. What
    /// overflows is infinite, nothing is NaN.
    pub fn state(&self, x: f64, v: f64, t: f64) -> (f64, f64) {
        let phase = self.frequency.times(t);
        if !self.oscillates() && phase.high.abs() > HYPERBOLIC {
            return self.separated(x, v, t);
        }
        let (c, s) = if self.oscillates() {
            let (sin, cos) = phase.sin_cos();
            (cos, t * ratio(sin, phase))
        } else {
            (cosh(phase.high), t * ratio(sinh(phase.high), Twofold::from(phase.high)))
        };
        let decay = Twofold::product(-self.d, t).exp();
        let pull = self.d.mul_add(x, v);
        let push = self.d.mul_add(v, x);
        (grown(x.mul_add(c, pull * s), decay), grown(v.mul_add(c, -(push * s)), decay))
    }

    /// The same as the sum of its two exponentials, for overdamped motions some time after their start.
    fn separated(&self, x: f64, v: f64, t: f64) -> (f64, f64) {
        let (fast, slow) = self.eigenvalues();
        let split = fast.high - slow.high;
        // v - fast x and v - slow x are the amounts of the slow and of the fast exponential.
        let slow_amount = fast.high.mul_add(-x, v) / -split;
        let fast_amount = slow.high.mul_add(-x, v) / split;
        let slowly = grown(slow_amount, slow.times(t).exp());
        let fastly = grown(fast_amount, fast.times(t).exp());
        let velocity = (slow.high * slowly, fast.high * fastly);
        (together(slowly, fastly), together(velocity.0, velocity.1))
    }

    /// The eigenvalue of larger and that of smaller magnitude of an overdamped or critical motion.
    ///
    /// Their product is 1, which gives the smaller one without cancellation.
    fn eigenvalues(&self) -> (Twofold, Twofold) {
        let Twofold { high, low } = self.frequency;
        let magnitude = Twofold::sum(self.d.abs(), high);
        let magnitude = Twofold::sum(magnitude.high, magnitude.low + low);
        let fast = magnitude.times(-self.d.signum());
        (fast, Twofold::from(1.0) / fast)
    }

    /// The first time after the start at which `v = 0`, for a start with `v > 0`, or with `v = 0` and
    /// `x < 0`; mirror images are served alike. `None` where the motion never stands still again.
    ///
    /// Guarantee: time and place are right to a few units in their last place; where damping is
    /// critical or more and the start lies next to the motion that never returns, the time is as
    /// uncertain as the last digits of the start make it.
    pub fn first_standstill(&self, x: f64, v: f64) -> Option<Standstill> {
        if v == 0.0 {
            let (time, growth) = (self.half_period()?, self.log_growth()?);
            return Some(Standstill { time, x: grown(-x, growth.exp()) });
        }
        // Standing still means tan(omega t)/omega = v/(D v + x), or the same with tanh and kappa.
        let time = if let Some(omega) = self.omega() {
            let push = self.d.mul_add(v, x);
            let angle = atan((omega.high * (v / push)).abs());
            let soon = push == 0.0 || (push > 0.0) == (v > 0.0);
            let phase = if soon { angle } else { PI.high - (angle - PI.low) };
            phase / omega.high
        } else {
            let (fast, slow) = self.eigenvalues();
            let split = fast.high - slow.high;
            let (near, far) = (slow.high.mul_add(-v, x), fast.high.mul_add(-v, x));
            if near * v.signum() <= 0.0 || far * v.signum() <= 0.0 {
                return None;
            }
            let excess = split * (v / far);
            if split == 0.0 {
                v / far
            } else if excess.abs() < 0.5 {
                ln_1p(excess) / split
            } else {
                ln(near / far) / split
            }
        };
        time.is_finite().then(|| Standstill { time, x: self.state(x, v, time).0 })
    }
}

/// `numerator / phase`, or its limit 1 where the phase is zero.
fn ratio(numerator: f64, phase: Twofold) -> f64 {
    let Twofold { high, low } = phase;
    if high == 0.0 {
        1.0
    } else {
        numerator / high * (1.0 - low / high)
    }
}

/// `amount * factor`, with nothing times infinity being nothing.
fn grown(amount: f64, factor: f64) -> f64 {
    if amount == 0.0 { amount } else { amount * factor }
}

/// `slow + fast`, of which only the fast part can win where both are infinite.
fn together(slow: f64, fast: f64) -> f64 {
    if fast.is_infinite() { fast } else { slow + fast }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::reference::rows;
    use super::*;
    use crate::numerics::elementary::{exp, exp2};

    #[test]
    fn states_agree_with_sixty_digit_arithmetic() {
        for row in rows(include_str!("../../tests/data/linear_states.csv")) {
            let [d, x0, v0, t, x, v] = row[..] else { panic!("{row:?}") };
            let got = LinearFlow::new(d).state(x0, v0, t);
            let size = x.abs().max(v.abs());
            let error = (got.0 - x).abs().max((got.1 - v).abs()) / size;
            assert!(error <= 8.0 * f64::EPSILON, "D = {d:?}, t = {t}: {got:?}, error {error:e}");
        }
    }

    #[test]
    fn standstills_agree_with_sixty_digit_arithmetic() {
        for row in rows(include_str!("../../tests/data/linear_standstills.csv")) {
            let [d, x0, v0, ref expected @ ..] = row[..] else { panic!("{row:?}") };
            let got = LinearFlow::new(d).first_standstill(x0, v0);
            assert_eq!(got.is_none(), expected.is_empty(), "D = {d:?}, ({x0}, {v0}): {got:?}");
            if let (Some(got), &[time, x]) = (got, expected) {
                let error = (got.time / time - 1.0).abs();
                assert!(error <= 8.0 * f64::EPSILON, "D = {d:?}: {got:?} for {time}, {error:e}");
                assert!((got.x - x).abs() <= 8.0 * f64::EPSILON * x, "D = {d:?}: {got:?} for {x}");
            }
        }
    }

    #[test]
    fn a_swing_from_rest_takes_half_a_period_where_there_is_one() {
        assert_eq!(
            LinearFlow::new(0.0).first_standstill(-1.0, 0.0),
            Some(Standstill { time: std::f64::consts::PI, x: 1.0 })
        );
        assert_eq!(
            LinearFlow::new(-0.0).first_standstill(-1.0, 0.0),
            LinearFlow::new(0.0).first_standstill(-1.0, -0.0)
        );
        for d in [1.0, -1.0, 1.0 + 1e-3, -1.0 - 1e-3, 2.0, 1e6] {
            assert_eq!(LinearFlow::new(d).first_standstill(-1.0, 0.0), None, "D = {d}");
        }
    }

    #[test]
    fn what_overflows_is_infinite_and_never_nan() {
        for d in [-1e6, -1.001, -1.0, -0.999_999, 1e6] {
            for (x, v) in [(-1.0, 0.0), (0.0, 0.0), (-0.3, 1.0), (1e300, -1e300)] {
                let (x, v) = LinearFlow::new(d).state(x, v, 1e5);
                assert!(!x.is_nan() && !v.is_nan(), "D = {d}: {x} {v}");
            }
        }
    }

    fn damping() -> impl Strategy<Value = f64> {
        prop_oneof![
            -1.5..1.5,
            -1e-9..1e-9,
            (-1.0 - 1e-9)..(-1.0 + 1e-9),
            (1.0 - 1e-9)..(1.0 + 1e-9),
            Just(1e-300),
            Just(-1e-12),
        ]
    }

    proptest! {
        #[test]
        fn two_steps_are_one(d in damping(), x in -1.0..1.0, v in -1.0..1.0, s in 0.0..3.0, t in 0.0..3.0) {
            let once = LinearFlow::new(d).state(x, v, s + t);
            let halfway = LinearFlow::new(d).state(x, v, s);
            let twice = LinearFlow::new(d).state(halfway.0, halfway.1, t);
            // Growth within 6 time units bounds what the error of the first step becomes.
            let size = (halfway.0.abs() + halfway.1.abs()) * exp(3.0 * t);
            let error = (once.0 - twice.0).abs().max((once.1 - twice.1).abs());
            prop_assert!(error <= 30.0 * f64::EPSILON * size, "{once:?} {twice:?}");
        }

        #[test]
        fn scaled_and_mirrored_states_move_alike_to_the_last_bit(
            d in damping(), x in -1.0..1.0, v in -1.0..1.0, t in 0.0..6.0, k in -400_i32..=400,
        ) {
            let unit = exp2(f64::from(k));
            let plain = LinearFlow::new(d).state(x, v, t);
            let other = LinearFlow::new(d).state(-x * unit, -v * unit, t);
            prop_assert_eq!((-plain.0 * unit, -plain.1 * unit), other);
            let v = v.abs();
            let plain = LinearFlow::new(d).first_standstill(x, v);
            let other = LinearFlow::new(d).first_standstill(-x * unit, -v * unit);
            prop_assert_eq!(plain.map(|it| (it.time, -it.x * unit)), other.map(|it| (it.time, it.x)));
        }

        #[test]
        fn velocity_is_positive_until_the_first_standstill(
            d in damping(), x0 in -1.0..1.0, v0 in 1e-3..1.0, part in 0.0..1.0,
        ) {
            let end = LinearFlow::new(d).first_standstill(x0, v0).map_or(10.0, |it| it.time);
            prop_assert!(LinearFlow::new(d).state(x0, v0, end * part).1 >= 0.0);
            if let Some(still) = LinearFlow::new(d).first_standstill(x0, v0) {
                let (x, v) = LinearFlow::new(d).state(x0, v0, still.time);
                // The last digit of the start alone moves the time by this much: where next to critical
                // damping a motion almost misses v = 0, by more than any rounding.
                let moved = LinearFlow::new(d).first_standstill(x0, v0.next_up());
                let unsure = moved.map_or(f64::INFINITY, |moved| (moved.time - still.time).abs());
                let bound = 1e-14 * (1.0 + still.time) + 4.0 * unsure;
                prop_assert!(v.abs() <= bound * x.abs(), "{x} {v} {still:?}");
                // Next to critical damping what is left after so long a time underflows.
                prop_assert!(x > 0.0 || still.time > 100.0);
            }
        }
    }
}
