//! Where a motion stops that is about to: next to `v = 0`, with hardly any distance to go.
//!
//! A start at the rim of the sticking set, with a tiny velocity, reaches `v = 0` a little further out, perhaps
//! by less than the position can resolve. This small distance is decisive: it is the clearance of the next
//! swing, and where the rim repels (`D <= -1`) it grows forever. It is therefore computed separately and with
//! its own exponent, because it is quadratic in the velocity.

use super::StepPoint;
use crate::model::{HalfPlane, PlaneField};
use crate::numerics::{GAUSS, exponent, times_power};

/// How far a motion still moves, and for how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApproachToRest {
    /// Distance to the stopping place in units of `2^unit`; 0 where the motion has already stopped.
    pub distance: f64,
    /// Exponent of that unit.
    pub unit: i32,
    /// Time until it stops.
    pub duration: f64,
}

impl ApproachToRest {
    /// The stop of a motion through `point` if its remaining distance is at most a part of its position that is
    /// `negligible`, by which the force of the spring changes as well; otherwise `None`.
    ///
    /// With x constant, `v' = -(x + force)`, so the distance is the integral of `v/(x + force)` over v, by
    /// Gauss's rule. Guarantee: a relative error of 1e-12 at most.
    pub fn of(field: &HalfPlane, point: StepPoint, negligible: f64) -> Option<Self> {
        /// Largest damping force as a fraction of the position.
        const WEAK: f64 = 1e-3;
        let unit = exponent(point.v);
        let HalfPlane { d, d2, d3 } = field.in_units(unit);
        let x = times_power(point.x, -unit);
        let top = times_power(point.v, -unit);
        let force = |v: f64| v * (2.0 * d.abs() + v * (d2.abs() + v * d3.abs()));
        let is_weak = force(top) <= WEAK * x && top * top <= negligible * x * x;
        if !(x > 0.0 && top > 0.0 && is_weak) {
            return None;
        }
        // In units of the position neither integral overflows or underflows.
        let rate = |v: f64| 1.0 / (1.0 + v * (2.0 * d + v * (d2 + v * d3)) / x);
        let nodes = GAUSS.iter().map(|&(node, weight)| (node * top, weight * rate(node * top)));
        let (way, time) =
            nodes.fold((0.0, 0.0), |(way, time), (v, rate)| (way + v * rate, time + rate));
        let size = exponent(point.x);
        let mantissa = times_power(point.x, -size);
        Some(ApproachToRest {
            distance: top * way / mantissa,
            unit: 2 * unit - size,
            duration: times_power(top * time / mantissa, unit - size),
        })
    }

    /// The distance; 0 where it underflows.
    pub fn way(&self) -> f64 {
        times_power(self.distance, self.unit)
    }

    /// How far it stops beyond a place that it has already `passed` by this much (negative: not yet), and the
    /// exponent of the unit of the result.
    pub fn beyond(&self, passed: f64) -> (f64, i32) {
        if passed == 0.0 {
            (self.distance, self.unit)
        } else {
            (passed + self.way(), 0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::ln;

    /// Without damping the motion is a circle about 0.
    #[test]
    fn undamped_motions_stop_on_their_circle() {
        let field = HalfPlane { d: 0.0, d2: 0.0, d3: 0.0 };
        for (x, v) in [(2.0, 1e-9), (3e-5, 1e-18), (1e200, 1e-100)] {
            let stop = ApproachToRest::of(&field, StepPoint { x, v }, 1e-12).unwrap();
            // In units of 2^-600 the last of these distances is representable.
            let way = times_power(stop.distance, stop.unit + 600);
            let expected = 0.5 * times_power(v, 300) * (times_power(v, 300) / x);
            assert!((way / expected - 1.0).abs() < 1e-15, "{stop:?}");
            assert!((stop.duration / (v / x) - 1.0).abs() < 1e-15);
        }
        assert_eq!(ApproachToRest::of(&field, StepPoint { x: 2.0, v: 1e-5 }, 1e-12), None);
        assert_eq!(ApproachToRest::of(&field, StepPoint { x: -2.0, v: 1e-30 }, 1e-12), None);
    }

    /// The distance is quadratic in the velocity: it is known even where that square underflows.
    #[test]
    fn ways_below_the_range_of_numbers_keep_their_digits() {
        let field = HalfPlane { d: -1.5, d2: 3.0, d3: 1e3 };
        let stop = ApproachToRest::of(&field, StepPoint { x: 2.0, v: 3e-300 }, 1e-12).unwrap();
        let log = ln(stop.distance) + f64::from(stop.unit) * std::f64::consts::LN_2;
        let expected = 2.0 * ln(3e-300) - ln(4.0);
        assert!((log / expected - 1.0).abs() < 1e-15, "{stop:?}");
    }

    /// A damping force that is a fraction of the position changes the distance by about two thirds of that fraction.
    #[test]
    fn damping_shortens_the_way() {
        let (x, v) = (1.0, 1e-9);
        let stop = |d: f64| {
            let stop =
                ApproachToRest::of(&HalfPlane { d, d2: 0.0, d3: 0.0 }, StepPoint { x, v }, 1e-12)
                    .unwrap();
            stop.way()
        };
        // The integral of v/(1 + k v), as a series in k v.
        let part: f64 = 5e-4;
        let series = 0.5 - part * (1.0 / 3.0 - part * (0.25 - part * (0.2 - part / 6.0)));
        let expected = v * v * series;
        assert!((stop(0.5 * part / v) / expected - 1.0).abs() < 1e-12);
        assert!(stop(-0.5 * part / v) > 0.5 * v * v);
    }
}
