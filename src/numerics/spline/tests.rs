//! Smoothing against exact curves.

use super::*;
use crate::numerics::elementary::{exp, pow};

fn sampled(mu: impl Fn(f64) -> f64, count: u32) -> Vec<(f64, f64)> {
    // Unevenly spaced, closer near 0, as measurements are.
    let at = |index: u32| pow(f64::from(index) / f64::from(count - 1), 1.3);
    (0..count).map(|index| (at(index), mu(at(index)))).collect()
}

fn stribeck(v: f64) -> f64 {
    0.2 + 0.3 * exp(-v / 0.3)
}

#[test]
fn it_passes_through_every_point_and_repeats_parabolas() {
    let points = sampled(stribeck, 12);
    let spline = SmoothingSpline::new(&points, 0.0).unwrap();
    assert!(points.iter().all(|&(x, y)| (spline.at(x).value - y).abs() < 1e-14));
    let parabola = |v: f64| 0.5 - 0.3 * v + 0.1 * v * v;
    let spline = SmoothingSpline::new(&sampled(parabola, 9), 0.0).unwrap();
    for v in [0.0, 0.123, 0.5, 1.0] {
        let found = spline.at(v);
        assert!((found.value - parabola(v)).abs() < 1e-14);
        assert!((found.first - (0.2 * v - 0.3)).abs() < 1e-12);
        assert!((found.second - 0.2).abs() < 1e-10 && found.third.abs() < 1e-8);
    }
}

#[test]
fn four_derivatives_are_continuous() {
    let points = sampled(stribeck, 9);
    let spline = SmoothingSpline::new(&points, 0.0).unwrap();
    for &(x, _) in &points[1..8] {
        let (before, after) = (spline.at(x - 1e-9), spline.at(x + 1e-9));
        assert!((before.first - after.first).abs() < 1e-7);
        assert!((before.second - after.second).abs() < 1e-6);
        assert!((before.third - after.third).abs() < 1e-4);
    }
}

#[test]
fn derivatives_away_from_the_ends_converge_to_those_of_the_law() {
    let exact = Derivatives {
        value: stribeck(0.5),
        first: (stribeck(0.5) - 0.2) / -0.3,
        second: (stribeck(0.5) - 0.2) / 0.09,
        third: (stribeck(0.5) - 0.2) / -0.027,
    };
    let error = |count| {
        let found = SmoothingSpline::new(&sampled(stribeck, count), 0.0).unwrap().at(0.5);
        (found.third / exact.third - 1.0).abs().max((found.first / exact.first - 1.0).abs())
    };
    assert!(error(12) < 0.05, "{}", error(12));
    assert!(error(48) < 2e-3 && error(192) < 1e-4, "{} {}", error(48), error(192));
}

#[test]
fn scatter_is_taken_out_by_as_much_as_was_said() {
    // Uniform deviations of root mean square 0.01, from a congruential generator.
    let mut points = sampled(stribeck, 60);
    let mut seed = 1_u32;
    for point in &mut points {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let even = f64::from(seed) / f64::from(u32::MAX) - 0.5;
        point.1 += 0.01 * 12.0_f64.sqrt() * even;
    }
    let spline = SmoothingSpline::new(&points, 0.01).unwrap();
    assert!((spline.missed() - 0.01).abs() < 1e-6, "{}", spline.missed());
    let rough = SmoothingSpline::new(&points, 0.0).unwrap();
    let slope = (stribeck(0.5) - 0.2) / -0.3;
    let (smooth, rough) = (spline.at(0.5).first, rough.at(0.5).first);
    assert!((smooth / slope - 1.0).abs() < 0.1, "{smooth} for {slope}");
    assert!((rough / slope - 1.0).abs() > 0.2, "{rough} for {slope}");
    // If all deviation is allowed as scatter, the least squares parabola remains.
    let parabola = SmoothingSpline::new(&points, 1.0).unwrap();
    assert!(parabola.at(0.5).third.abs() < 1e-6);
}

#[test]
fn what_is_no_table_is_refused() {
    let refused = |points: &[(f64, f64)]| SmoothingSpline::new(points, 0.0).unwrap_err();
    assert_eq!(refused(&[(0.0, 1.0); 3]), PointsError::TooFew { count: 3 });
    let twice = [(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
    assert_eq!(refused(&twice), PointsError::Point { index: 2 });
    let uneven = [(0.0, 0.4), (1.0, 0.3), (1.0 + 1e-15, 0.25), (1e300, 0.2)];
    assert_eq!(refused(&uneven), PointsError::Uneven { index: 1 });
    let missing = [(0.0, 1.0), (1.0, f64::NAN), (2.0, 2.0), (3.0, 1.0)];
    assert_eq!(refused(&missing), PointsError::Point { index: 1 });
}
