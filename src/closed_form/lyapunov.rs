//! Energy as Lyapunov function: a circle that surely belongs to the basin (equations 17 to 24).
//!
//! Along every motion `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. Wherever that is not positive on a
//! whole disk about the origin, no motion leaves the disk, and by LaSalle's principle all that start
//! in it are captured. The paper keeps only the terms of lowest order and finds the radius
//! `l = -r/(2 D)` (24); with all terms the radius is a root of a cubic, found here too, since (24)
//! promises too much where `D2` or negative `D3` feed energy in.

use crate::model::Parameters;
use crate::numerics::{TO_ROUNDING, bisect, times_power};

/// The rate of change `V'` of the energy (equations 17 to 19, with the terms of higher order).
pub fn energy_rate(parameters: &Parameters, v: f64) -> f64 {
    let Parameters { d, d2, d3, r } = *parameters;
    let damping = 2.0 * d + v * (d2 + v * d3);
    -(v * v * damping + r * v.abs())
}

/// Radius `l = -r/(2 D)` of the circle on which the linearised energy stops falling (equation 24).
///
/// `None` for `D >= 0`, where the linearised energy never grows.
/// Assumption: `D2` and `D3` negligible within the circle; [`full_disk`] assumes nothing.
pub fn radius(parameters: &Parameters) -> Option<f64> {
    let Parameters { d, r, .. } = *parameters;
    (d < 0.0).then_some(-r / (2.0 * d))
}

/// Radius of the largest disk within which the energy of the full system never grows, so that for `r > 0` every motion that
/// starts there is captured; infinite where that is the whole plane.
///
/// It is the smallest `v` beyond which `r + 2 D v - abs(D2) v^2 + D3 v^3`, the loss of energy
/// per length of path on the worse side of `v = 0`, is negative. Guarantee: the radius is bracketed
/// between neighbouring doubles by the sign of that polynomial as rounded.
pub fn full_disk(parameters: &Parameters) -> f64 {
    let Parameters { d, d2, d3, r } = *parameters;
    let asymmetry = d2.abs();
    let loss = |v: f64| r + v * (2.0 * d - v * (asymmetry - v * d3));
    // Without friction the lowest term that is not zero decides next to the origin.
    let feeds_small_motions = d < 0.0 || (d == 0.0 && (asymmetry > 0.0 || d3 < 0.0));
    if r == 0.0 && feeds_small_motions {
        return 0.0;
    }
    // By the rule of signs the loss turns negative at most once for D3 <= 0, and then stays so; for
    // D3 > 0 it turns negative and positive again or never, and is least in between.
    let least = (asymmetry + (asymmetry * asymmetry - 6.0 * d * d3).sqrt()) / (3.0 * d3);
    let negative = if d3 > 0.0 && !least.is_infinite() {
        Some(least).filter(|&v| v > 0.0 && loss(v) < 0.0)
    } else {
        // All powers of two.
        (-1022..1024).map(|power| times_power(1.0, power)).find(|&v| loss(v) < 0.0)
    };
    negative
        .map_or(f64::INFINITY, |negative| bisect(0.0, negative, TO_ROUNDING, |v| loss(v) < 0.0).0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::piecewise_linear::LinearCycle;
    use super::*;
    use crate::numerics::elementary::powi;

    fn oscillator(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
        Parameters { d, d2, d3, r }
    }

    #[test]
    fn with_linear_damping_alone_both_radii_are_r_over_two_d() {
        let parameters = oscillator(-0.1, 0.0, 0.0, 0.5);
        assert_eq!(radius(&parameters), Some(2.5));
        let full = full_disk(&parameters);
        assert!((full - 2.5).abs() <= 4.0 * f64::EPSILON);
        for d in [0.0, -0.0, 0.3] {
            assert_eq!(radius(&oscillator(d, 0.0, 0.0, 0.5)), None);
            assert_eq!(full_disk(&oscillator(d, 0.0, 0.0, 0.5)), f64::INFINITY);
        }
        assert!(radius(&oscillator(-1e-150, 0.0, 0.0, 1e150)).is_some_and(f64::is_finite));
    }

    #[test]
    fn terms_of_higher_order_move_the_radius() {
        // 0.5 - 0.2 v - 0.1 v^2 = 0 at v = sqrt(6) - 1.
        let full = full_disk(&oscillator(-0.1, -0.1, 0.0, 0.5));
        assert!((full - (6.0_f64.sqrt() - 1.0)).abs() <= 4.0 * f64::EPSILON);
        // 0.1 - 0.6 v + 0.5 v^3 has its least value below zero at v = sqrt(0.4); with r = 0.3 above.
        assert!(full_disk(&oscillator(-0.3, 0.0, 0.5, 0.1)).is_finite());
        assert_eq!(full_disk(&oscillator(-0.3, 0.0, 0.5, 0.3)), f64::INFINITY);
        // Negative cubic damping feeds energy in even at D > 0: 1 + v - v^3/4 = 0.
        let full = full_disk(&oscillator(0.5, 0.0, -0.25, 1.0));
        assert!((1.0 + full - powi(full, 3) / 4.0).abs() < 1e-14);
    }

    #[test]
    fn without_friction_the_origin_decides() {
        assert_eq!(full_disk(&oscillator(-1e-150, 0.0, 1.0, 0.0)), 0.0);
        assert_eq!(full_disk(&oscillator(-0.0, 1e-150, 1.0, 0.0)), 0.0);
        assert_eq!(full_disk(&oscillator(0.0, 0.0, 0.0, 0.0)), f64::INFINITY);
        assert_eq!(full_disk(&oscillator(0.1, 0.0, 1.0, 0.0)), f64::INFINITY);
    }

    proptest! {
        #[test]
        fn the_circle_lies_inside_the_cycle(d in -0.999..-1e-6, r in 1e-3..1e3) {
            let circle = radius(&oscillator(d, 0.0, 0.0, r)).unwrap();
            let cycle = LinearCycle::new(d, r).unwrap();
            prop_assert!(circle < cycle.q_max && circle < cycle.v_max);
        }

        #[test]
        fn energy_falls_inside_the_disk_and_grows_somewhere_just_outside(
            d in -1.0..1.0, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 1e-3..1.0, part in 0.0..1.0,
        ) {
            let parameters = oscillator(d, d2, d3, r);
            let radius = full_disk(&parameters);
            let inside = part * if radius.is_finite() { radius } else { 1e3 };
            let rate = |v: f64| energy_rate(&parameters, v);
            prop_assert!(rate(inside) <= 0.0 && rate(-inside) <= 0.0);
            let outside = radius * (1.0 + 1e-9);
            if outside.is_finite() {
                prop_assert!(rate(outside).max(rate(-outside)) > 0.0);
            }
        }
    }
}
