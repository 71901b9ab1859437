//! The positive roots of the amplitude equation `4 r/pi + 2 D A + (3/4) D3 A^3 = 0` (42).
//!
//! Everything about this cubic depends on one number,
//!
//! `R = (9/pi)^2 r^2 abs(D3) / (8 abs(D)^3)`,
//!
//! and its roots are trigonometric functions of it, written so that no digits are lost where a root is
//! tiny against another (`R -> 0`) or where two roots meet at the fold (`R -> 1`): there the small
//! difference `1 - R` decides, and it is computed in twice the working precision.
//!
//! Within the range of the parameters no root over- or underflows.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

use crate::numerics::elementary::{acos, acosh, asinh, atan2, cbrt, cos, cosh, sin, sinh};
use crate::numerics::twofold::{self, Twofold};

/// The roots for `D3 > 0`, `r > 0`.
pub enum Pair {
    /// Beyond the fold.
    None,
    /// Both in one point, at the fold.
    Meeting(f64),
    /// The smaller and the larger.
    Apart(f64, f64),
}

/// The roots for `D3 > 0`, `r > 0`.
///
/// With `sin(beta) = sqrt(R)` the roots are `A_1 3 sin(beta/3)/sin(beta)` and
/// `A_2 (2/sqrt 3) cos(pi/6 + beta/3)`: Viete's formula, with the cancelling factors divided out.
pub fn supercritical(d: f64, d3: f64, r: f64) -> Pair {
    if d.is_nan() || d >= 0.0 {
        return Pair::None;
    }
    let (ratio, gap) = distance_from_fold(d, d3, r);
    if gap < 0.0 {
        return Pair::None;
    }
    let sine = ratio.sqrt();
    let third = atan2(sine, gap.sqrt()) / 3.0;
    let small = small_root(d, r) * triple_ratio(sin(third), sine);
    let large = large_root(d, d3) * (SCALE * cos(FRAC_PI_6 + third));
    if gap > 0.0 { Pair::Apart(small, large) } else { Pair::Meeting(small) }
}

/// The root for `D3 < 0`, `r > 0`.
///
/// In units of `A_Z` it obeys `u^3 - delta u - 1 = 0` with `delta = pi D A_Z/(2 r)`; where delta is not
/// small, the hyperbolic and the trigonometric formula in units of `A_1` and `A_2` keep all digits.
pub fn subcritical(d: f64, d3: f64, r: f64) -> f64 {
    /// Up to here the expansion about `u = 1` is a good start for Newton's method.
    const NEAR_ZERO: f64 = 1.5;
    let crossing = zero_crossing_root(d3, r);
    let delta = FRAC_PI_2 * d * crossing / r;
    if delta.abs() <= NEAR_ZERO {
        let mut u = 1.0 + delta / 3.0;
        // Convex and increasing at the root, so Newton converges: quadratically, from an error < 0.2.
        for _ in 0..6 {
            u -= (u * (u * u - delta) - 1.0) / (3.0 * u * u - delta);
        }
        crossing * u
    } else {
        let (ratio, _) = distance_from_fold(d, d3, r);
        let sine = ratio.sqrt();
        if d < 0.0 {
            let third = asinh(sine) / 3.0;
            small_root(d, r) * triple_ratio(sinh(third), sine)
        } else {
            // Above 1 the arc cosine turns hyperbolic; the root itself does not notice.
            let third = if sine <= 1.0 { cos(acos(sine) / 3.0) } else { cosh(acosh(sine) / 3.0) };
            large_root(d, d3) * (SCALE * third)
        }
    }
}

/// `2/sqrt(3)`, which makes the large root tend to `A_2`.
const SCALE: f64 = 1.154_700_538_379_251_5;

/// `3 part/whole`, where `part` is a function of a third of the argument of `whole`; 1 in the limit.
fn triple_ratio(part: f64, whole: f64) -> f64 {
    // Below this argument the ratio is 1 to rounding, and its parts may be subnormal.
    if whole < 1e-9 { 1.0 } else { 3.0 * part / whole }
}

/// `R` and `1 - R`, the latter with full relative precision.
pub fn distance_from_fold(d: f64, d3: f64, r: f64) -> (f64, f64) {
    /// Up to its reciprocal R is as good as zero, from here on as good as infinite.
    const FAR: f64 = 1e290;
    let (friction, cubic) = (r / d.abs(), (d3 / d).abs());
    let rough = friction * cubic * friction;
    if rough < 1.0 / FAR {
        return (0.0, 1.0);
    } else if rough > FAR {
        return (f64::INFINITY, f64::NEG_INFINITY);
    }
    let over = |number: f64| Twofold::of(number).over(Twofold::of(d.abs()));
    let (friction, cubic) = (over(r), over(d3.abs()));
    let numerator = friction.by(cubic).by(friction).times(81.0 / 8.0);
    let ratio = numerator.over(twofold::PI.by(twofold::PI));
    (ratio.high, ratio.one_minus().value())
}

/// `A_1 = 2 r/(pi abs(D))`.
pub fn small_root(d: f64, r: f64) -> f64 {
    2.0 / PI * r / d.abs()
}

/// `A_2 = sqrt(8 abs(D)/(3 abs(D3)))`.
pub fn large_root(d: f64, d3: f64) -> f64 {
    (8.0 / 3.0 * (d / d3).abs()).sqrt()
}

/// `A_Z = cbrt(16 r/(3 pi abs(D3)))`.
pub fn zero_crossing_root(d3: f64, r: f64) -> f64 {
    cbrt(16.0 / (3.0 * PI) * r / d3.abs())
}
