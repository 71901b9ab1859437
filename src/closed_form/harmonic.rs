//! First-order harmonic balance: `q = A0 + A cos(tau)` (equations 37 to 54, corrected).
//!
//! Averaging the oscillator over one turn gives for the amplitude the slow equation
//!
//! `A' = -2 r/pi - D A - (3/8) D3 A^3`
//!
//! (41; as printed it is twice too fast). Its stationary amplitudes are the positive roots of
//! `4 r/pi + 2 D A + (3/4) D3 A^3 = 0` (42), a cubic without quadratic term. Everything about it depends on one
//! number,
//!
//! `R = (9/pi)^2 r^2 abs(D3) / (8 abs(D)^3)`,
//!
//! and its roots are trigonometric functions of it, written so that no digits are lost where a root is
//! tiny against another (`R -> 0`) or where two roots meet at the fold (`R -> 1`): there the small
//! difference `1 - R` decides, and it is computed in twice the working precision. Within the range of the
//! parameters no root over- or underflows.
//!
//! These are approximations to the true cycles of the oscillator. For `D2 = D3 = 0` the amplitude lies
//! below both `q_max` and `v_max` of the true cycle: 5 % below `q_max` at `D = -0.4`, 17 % at -0.7.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

use serde::Serialize;

use crate::model::Parameters;
use crate::numerics::twofold::{self, Twofold};
use crate::numerics::{atan2, cbrt, cos, sin};

/// A stationary amplitude of the first-order harmonic approximation `q = A0 + A cos(tau)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Harmonic {
    /// Amplitude A, a positive root of equation (42).
    pub amplitude: f64,
    /// Mean A0 (equation 40).
    pub mean: f64,
    /// Whether the averaged equation (41, corrected) attracts to it.
    pub stable: bool,
}

/// The point at which the two amplitudes for `D3 > 0` meet and vanish.
pub struct HarmonicFold {
    /// Damping `D_F` (equation 48): for `D > D_F` no amplitude is stationary.
    pub d: f64,
    /// Amplitude `A_F` (equation 49).
    pub amplitude: f64,
}

/// The stationary amplitudes, smallest first: positive roots of equation (42), with mean and stability.
///
/// - `D3 > 0`: two for `D < D_F`, the smaller unstable; one half-stable (reported as unstable) at the
///   fold itself; none beyond.
/// - `D3 = 0`: one for `D < 0`, unstable (exact solution of the averaged equation only).
/// - `D3 < 0`: one for every D with `r > 0`, unstable.
/// - `r = 0`: `A = 0` is the steady state, not a cycle, and is not listed.
///
/// Guarantee: each amplitude is right to a few units in its last place. At the centre `D = D3 = r = 0` every amplitude is stationary; the list is
/// then empty and [`is_centre`] says so.
pub fn amplitudes(parameters: &Parameters) -> Vec<Harmonic> {
    let Parameters { d, d2, d3, r } = *parameters;
    let alone = |root: Option<f64>, stable| root.map(|it| (it, stable)).into_iter().collect();
    let roots = if r == 0.0 {
        alone(large_asymptote(parameters), d3 > 0.0)
    } else if d3 == 0.0 {
        alone(small_asymptote(parameters), false)
    } else if d3 < 0.0 {
        alone(Some(subcritical(d, d3, r)), false)
    } else {
        supercritical(d, d3, r)
    };
    let harmonic = |(a, stable)| Harmonic { amplitude: a, mean: mean(d2, a), stable };
    roots.into_iter().map(harmonic).collect()
}

/// Whether every amplitude is stationary: `D = D3 = r = 0`.
pub fn is_centre(parameters: &Parameters) -> bool {
    parameters.d == 0.0 && parameters.d3 == 0.0 && parameters.r == 0.0
}

/// Mean `A0 = -(D2/2) A^2` (equation 40); infinite where it overflows, never NaN.
pub fn mean(d2: f64, amplitude: f64) -> f64 {
    if d2 == 0.0 {
        0.0
    } else {
        -0.5 * (d2 * amplitude) * amplitude
    }
}

/// The damping at which an amplitude `A > 0` is stationary: `D = -2 r/(pi A) - (3/8) D3 A^2`, equation
/// (42) solved for D. `None` where that is not a finite number.
pub fn damping_at(d3: f64, r: f64, amplitude: f64) -> Option<f64> {
    let friction = if r == 0.0 { 0.0 } else { 2.0 / PI * r / amplitude };
    let cubic = if d3 == 0.0 {
        0.0
    } else {
        0.375 * (d3 * amplitude) * amplitude
    };
    let d = -friction - cubic;
    (amplitude > 0.0 && d.is_finite()).then_some(d)
}

/// The fold for `D3 > 0`, `r > 0` (equations 48 and 49); at `r = 0` it has become the Hopf point.
///
/// Guarantee: right to a few units in the last place; `None` where `r^2 D3` over- or underflows.
pub fn fold(d3: f64, r: f64) -> Option<HarmonicFold> {
    if !(d3 > 0.0 && r > 0.0) {
        return None;
    }
    let invariant = Some(r * d3 * r).filter(|it| it.is_normal())?;
    let d = -cbrt(81.0 / (8.0 * PI * PI) * invariant);
    Some(HarmonicFold { d, amplitude: cbrt(8.0 / (3.0 * PI) * r / d3) })
}

/// Asymptote of small amplitudes, `A_1 = -2 r/(pi D)` for `D < 0` (equation 51).
///
/// For `D3 = 0` it solves the one-harmonic equation exactly, but not the oscillator.
pub fn small_asymptote(parameters: &Parameters) -> Option<f64> {
    let Parameters { d, r, .. } = *parameters;
    (d < 0.0 && r > 0.0).then(|| small_root(d, r))
}

/// Asymptote of large amplitudes, `A_2 = sqrt(-8 D/(3 D3))` where D and D3 differ in sign (equation 52).
pub fn large_asymptote(parameters: &Parameters) -> Option<f64> {
    let Parameters { d, d3, .. } = *parameters;
    let apart = (d < 0.0 && d3 > 0.0) || (d > 0.0 && d3 < 0.0);
    apart.then(|| large_root(d, d3))
}

/// Discriminant of the cubic (42) divided by its leading coefficient (equation 47):
/// `(1/3) (16/(3 D3))^2 (-8 D^3/D3 - (9/pi)^2 r^2)`. Positive: three real roots; zero: two of them
/// equal; negative: one. `None` where `D3 = 0` leaves no cubic or where it overflows.
pub fn discriminant(parameters: &Parameters) -> Option<f64> {
    let Parameters { d, d3, r, .. } = *parameters;
    if d3 == 0.0 {
        return None;
    }
    let scale = 16.0 / (3.0 * d3);
    // (9/pi)^2 r^2 = 8 R abs(D)^3/abs(D3), and 1 - R is known to all digits.
    let cube = 8.0 * d * d * (d / -d3);
    let bracket = if cube > 0.0 {
        cube * distance_from_fold(d, d3, r).1
    } else {
        cube - (9.0 / PI * r) * (9.0 / PI * r)
    };
    let value = scale * scale / 3.0 * bracket;
    Some(value).filter(|value| value.is_finite())
}

/// The roots for `D3 > 0`, `r > 0`, and whether each is stable: none beyond the fold, one at it, else two.
///
/// With `sin(beta) = sqrt(R)` the roots are `A_1 3 sin(beta/3)/sin(beta)` and
/// `A_2 (2/sqrt 3) cos(pi/6 + beta/3)`: Viete's formula, with the cancelling factors divided out.
fn supercritical(d: f64, d3: f64, r: f64) -> Vec<(f64, bool)> {
    if d.is_nan() || d >= 0.0 {
        return Vec::new();
    }
    let (ratio, gap) = distance_from_fold(d, d3, r);
    if gap < 0.0 {
        return Vec::new();
    }
    let sine = ratio.sqrt();
    let third = atan2(sine, gap.sqrt()) / 3.0;
    // Below this argument the ratio is 1 to rounding, and its parts may be subnormal.
    let small = small_root(d, r) * if sine < 1e-9 { 1.0 } else { 3.0 * sin(third) / sine };
    let large = large_root(d, d3) * (SCALE * cos(FRAC_PI_6 + third));
    if gap > 0.0 {
        vec![(small, false), (large, true)]
    } else {
        vec![(small, false)]
    }
}

/// The root for `D3 < 0`, `r > 0`.
///
/// In units of `A_Z` it obeys `u^3 - delta u - 1 = 0` with `delta = pi D A_Z/(2 r)`; where delta is far from 0, it is
/// `A_1` or `A_2`. Newton's method begins above it, where the cubic is convex and increasing, and comes down to it.
fn subcritical(d: f64, d3: f64, r: f64) -> f64 {
    /// From here on the root differs from the asymptote by less than rounding.
    const FAR: f64 = 1e12;
    let crossing = zero_crossing_root(d3, r);
    let delta = FRAC_PI_2 * d * crossing / r;
    if delta.abs() > FAR {
        return if d < 0.0 { small_root(d, r) } else { large_root(d, d3) };
    }
    let mut u = if delta < 0.0 {
        f64::min(1.0, -1.0 / delta)
    } else {
        1.0 + delta.sqrt()
    };
    // At most a factor of two away, and then quadratically.
    for _ in 0..9 {
        u -= (u * (u * u - delta) - 1.0) / (3.0 * u * u - delta);
    }
    crossing * u
}

/// `2/sqrt(3)`, which makes the large root tend to `A_2`.
const SCALE: f64 = 1.154_700_538_379_251_5;

/// `R` and `1 - R`, the latter with full relative precision.
fn distance_from_fold(d: f64, d3: f64, r: f64) -> (f64, f64) {
    /// Up to its reciprocal R is as good as zero, from here on as good as infinite.
    const FAR: f64 = 1e290;
    let (friction, cubic) = (r / d.abs(), (d3 / d).abs());
    let rough = friction * cubic * friction;
    if rough < 1.0 / FAR {
        return (0.0, 1.0);
    } else if rough > FAR {
        return (f64::INFINITY, f64::NEG_INFINITY);
    }
    let over = |number: f64| Twofold::from(number) / Twofold::from(d.abs());
    let (friction, cubic) = (over(r), over(d3.abs()));
    let numerator = (friction * cubic * friction).times(81.0 / 8.0);
    let ratio = numerator / (twofold::PI * twofold::PI);
    (ratio.high, ratio.one_minus().value())
}

/// `A_1 = 2 r/(pi abs(D))`.
fn small_root(d: f64, r: f64) -> f64 {
    2.0 / PI * r / d.abs()
}

/// `A_2 = sqrt(8 abs(D)/(3 abs(D3)))`.
fn large_root(d: f64, d3: f64) -> f64 {
    (8.0 / 3.0 * (d / d3).abs()).sqrt()
}

/// Amplitude `A_Z = cbrt(-16 r/(3 pi D3))` of the cycle at `D = 0` for `D3 < 0`, `r > 0` (equation 50).
fn zero_crossing_root(d3: f64, r: f64) -> f64 {
    cbrt(16.0 / (3.0 * PI) * r / d3.abs())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::reference::rows;
    use super::*;
    use crate::numerics::elementary::exp2;

    fn oscillator(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
        Parameters { d, d2, d3, r }
    }

    fn roots(d: f64, d3: f64, r: f64) -> Vec<f64> {
        amplitudes(&oscillator(d, 0.0, d3, r)).iter().map(|root| root.amplitude).collect()
    }

    fn close(got: f64, expected: f64, ulps: f64) -> bool {
        (got - expected).abs() <= ulps * f64::EPSILON * expected.abs()
    }

    #[test]
    fn amplitudes_agree_with_many_digit_arithmetic_down_to_one_ulp_from_the_fold() {
        for row in rows(include_str!("../../tests/data/harmonic_amplitudes.csv")) {
            let [d, d3, r, ref expected @ ..] = row[..] else { panic!("{row:?}") };
            let got = roots(d, d3, r);
            assert_eq!(got.len(), expected.len(), "D = {d:?}, D3 = {d3}, r = {r}: {got:?}");
            for (got, expected) in got.iter().zip(expected) {
                assert!(close(*got, *expected, 4.0), "D = {d:?}: {got:?} for {expected:?}");
            }
        }
    }

    #[test]
    fn without_cubic_damping_the_amplitude_is_the_small_asymptote() {
        // r = 0.1, D = -0.4: A = 0.15915 (the paper's Fig. 9).
        let [root] = amplitudes(&oscillator(-0.4, 0.3, 0.0, 0.1))[..] else { panic!("one root") };
        assert!(close(root.amplitude, 0.5 / PI, 4.0) && !root.stable);
        assert!(close(root.mean, -0.15 * root.amplitude * root.amplitude, 4.0));
        for d in [0.0, -0.0, 0.5] {
            assert!(roots(d, 0.0, 0.1).is_empty());
        }
    }

    #[test]
    fn without_friction_the_amplitude_is_that_of_the_smooth_oscillator() {
        let [root] = amplitudes(&oscillator(-0.3, 0.0, 0.2, 0.0))[..] else { panic!("one root") };
        assert!(close(root.amplitude, 2.0, 2.0) && root.stable);
        let [root] = amplitudes(&oscillator(0.3, 0.0, -0.2, 0.0))[..] else { panic!("one root") };
        assert!(close(root.amplitude, 2.0, 2.0) && !root.stable);
        for (d, d3) in [(0.3, 0.2), (-0.3, -0.2), (0.0, 0.2), (-0.0, -0.2), (-0.3, 0.0)] {
            assert!(roots(d, d3, 0.0).is_empty(), "{d} {d3}");
        }
        assert!(is_centre(&oscillator(-0.0, 1.0, 0.0, 0.0)));
    }

    #[test]
    fn the_crossing_of_zero_is_the_amplitude_at_zero_damping() {
        for d in [0.0, -0.0, 1e-150, -1e-150] {
            assert_eq!(roots(d, -0.5, 0.1), [zero_crossing_root(-0.5, 0.1)]);
        }
    }

    #[test]
    fn extremes_have_amplitudes_or_none_but_never_nan() {
        let d = [-1e6, -1.0 - 1e-3, -1.0, -0.999, -1e-12, -1e-150, -0.0, 0.0, 1e-150, 0.5, 2.0];
        let r = [0.0, 1e-150, 1e-12, 1.0, 1e12, 1e150];
        let d3 = [-1e150, -1e6, -1e-12, -1e-150, -0.0, 0.0, 1e-150, 1e-12, 1e6, 1e150];
        let grid = d.into_iter().flat_map(|d| r.map(|r| d3.map(|d3| (d, r, d3)))).flatten();
        for (d, r, d3) in grid {
            let found = amplitudes(&oscillator(d, 1.0, d3, r));
            for root in &found {
                assert!(root.amplitude > 0.0 && root.amplitude.is_finite(), "{d} {d3} {r}");
                assert!(!root.mean.is_nan());
            }
            assert!(found.windows(2).all(|pair| pair[0].amplitude < pair[1].amplitude));
            let fold = fold(d3, r);
            assert!(fold.is_none_or(|fold| fold.d.is_finite() && fold.amplitude.is_finite()));
            assert!(discriminant(&oscillator(d, 0.0, d3, r)).is_none_or(f64::is_finite));
        }
    }

    proptest! {
        #[test]
        fn the_number_of_roots_follows_from_the_discriminant(d in -1.0..1.0, d3 in -2.0..2.0, r in 1e-3..1.0) {
            let found = roots(d, d3, r).len();
            let three_real = discriminant(&oscillator(d, 0.0, d3, r)).unwrap() > 0.0;
            // Of three real roots whose sum is zero, two are positive where their product -b is
            // negative; of a single one the sign is that of -b.
            let expected = match (d3 > 0.0, three_real) {
                (true, true) => 2,
                (true, false) => 0,
                (false, _) => 1,
            };
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn two_roots_obey_vieta(below in 1e-12..3.0, d3 in 1e-3..1e3, r in 1e-3..1e3) {
            let (below, d3, r): (f64, f64, f64) = (below, d3, r);
            let d = fold(d3, r).unwrap().d * (1.0 + below);
            let [small, large] = roots(d, d3, r)[..] else { panic!("two roots") };
            // The third root is minus their sum; product of all three -16 r/(3 pi D3), and the sum of
            // the products of pairs 8 D/(3 D3).
            prop_assert!(close(small * large * (small + large), 16.0 * r / (3.0 * PI * d3), 16.0));
            let pairs = small * large - (small + large) * (small + large);
            prop_assert!(close(pairs, 8.0 * d / (3.0 * d3), 16.0));
        }

        #[test]
        fn the_fold_is_the_top_of_the_amplitude_curve(d3 in 1e-3..1e3, r in 1e-3..1e3, step in 0.01..0.5) {
            let (d3, r, step): (f64, f64, f64) = (d3, r, step);
            let top = fold(d3, r).unwrap();
            prop_assert!(close(damping_at(d3, r, top.amplitude).unwrap(), top.d, 8.0));
            for a in [top.amplitude * (1.0 - step), top.amplitude * (1.0 + step)] {
                prop_assert!(damping_at(d3, r, a).unwrap() < top.d);
            }
        }

        #[test]
        fn damping_and_amplitude_are_inverse(d in -1.0..1.0, d3 in -2.0..2.0, r in 1e-3..1.0) {
            for root in roots(d, d3, r) {
                let size = d.abs() + 0.375 * d3.abs() * root * root;
                prop_assert!((damping_at(d3, r, root).unwrap() - d).abs() <= 8.0 * f64::EPSILON * size);
            }
        }

        #[test]
        fn stable_amplitudes_attract(d in -1.0..1.0, d3 in -2.0..2.0, r in 1e-3..1.0) {
            // (41), corrected: the printed right-hand side is twice as large.
            let rate = |a: f64| -2.0 / PI * r - a * (d + 0.375 * d3 * a * a);
            for root in amplitudes(&oscillator(d, 0.0, d3, r)) {
                let [above, below] = [1e-5, -1e-5].map(|off| rate(root.amplitude * (1.0 + off)));
                prop_assert_eq!(above < below, root.stable);
            }
        }

        #[test]
        fn scaling_by_a_power_of_two_changes_no_bit(
            d in -1.0..1.0, d3 in -2.0..2.0, r in 1e-3..1.0, k in -150_i32..150,
        ) {
            let unit = exp2(f64::from(k));
            let plain = amplitudes(&oscillator(d, 0.3, d3, r));
            let big = amplitudes(&oscillator(d, 0.3 / unit, d3 / unit / unit, r * unit));
            let plain: Vec<_> = plain.iter().map(|it| (it.amplitude * unit, it.mean * unit)).collect();
            let big: Vec<_> = big.iter().map(|it| (it.amplitude, it.mean)).collect();
            prop_assert_eq!(plain, big);
        }
    }
}
