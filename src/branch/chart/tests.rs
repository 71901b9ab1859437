//! Charts against known boundaries and against the search for cycles.

use super::*;
use crate::branch::fold::fold;
use crate::branch::regime::tests::regime;
use crate::model::Knob;
use crate::numerics::elementary::{hypot, powi};

/// Few lines, and none between them.
const COARSE: Resolution = Resolution { lines: 4, chord: f64::INFINITY, tolerance: 1e-13 };

const PLAIN: Parameters = Parameters { d: -0.2, d2: 0.0, d3: 0.5, r: 0.1 };

fn plane(right: Knob, right_range: (f64, f64), up: Knob, up_range: (f64, f64)) -> Plane {
    Plane { right, up, right_range, up_range }
}

fn drawn(parameters: &Parameters, plane: Plane, count: usize) -> Chart {
    let resolution = Resolution { lines: count, ..COARSE };
    chart(parameters, plane, resolution, &Limits::PATIENT).unwrap()
}

/// Every band of every line against the regime computed at its middle.
fn bands_are_right(parameters: &Parameters, chart: &Chart) {
    let across = chart.plane.across();
    let mut checked = 0;
    for line in &chart.lines {
        assert_eq!(line.failure, None, "{line:?}");
        for band in &line.bands {
            // A band as thin as the digits of its ends has no middle.
            if band.to - band.from < 1e-9 {
                continue;
            }
            let middle = 0.5 * (band.from + band.to);
            let here = parameters.with(across, line.at).with(chart.plane.along(), middle);
            let expected = regime(&here);
            assert_eq!(band.regime, Some(expected), "{here:?}");
            checked += 1;
        }
    }
    assert!(checked > chart.lines.len());
}

#[test]
fn over_d_the_boundaries_are_the_known_folds_and_escape_points() {
    let over_r = drawn(&PLAIN, plane(Knob::D, (-0.5, 0.1), Knob::R, (0.1, 0.2)), 4);
    assert_eq!(over_r.plane.along(), Knob::D);
    let parameters = Parameters { r: 0.1, ..PLAIN };
    let known = fold(&parameters, &Limits::PATIENT).unwrap().0.unwrap().d;
    assert_eq!(over_r.lines[0].fold, Some(known));
    let [run] = &over_r.boundary(|line| line.fold)[..] else { panic!("one run") };
    assert_eq!((run.len(), run[0]), (5, (known, 0.1)));
    // A little to the left of the fold a cycle attracts, to the right of it nothing does.
    assert_eq!(over_r.regime_at(known - 1e-6, 0.1), Some(Regime::Coexisting));
    assert_eq!(over_r.regime_at(known + 1e-6, 0.1), Some(Regime::Global));

    let parameters = Parameters { d3: 0.0, r: 0.1, ..PLAIN };
    let over_d2 = drawn(&parameters, plane(Knob::D, (-0.5, 0.1), Knob::D2, (-1.0, 1.0)), 8);
    let [left, right] = [&over_d2.lines[0], &over_d2.lines[over_d2.lines.len() - 1]];
    for end in [left, right] {
        assert!((end.escape.unwrap() + 0.079_769).abs() < 1e-6, "{end:?}");
    }
    assert_eq!(over_d2.regime_at(-0.05, 0.9), Some(Regime::Escape));
    assert_eq!(over_d2.regime_at(-0.09, 0.9), Some(Regime::Finite));
}

#[test]
fn without_d_the_fold_is_where_it_comes_to_the_given_d() {
    // With D2 = 0 only r^2 D3 matters: one number for all lines.
    let known = fold(&Parameters { r: 0.1, ..PLAIN }, &Limits::PATIENT).unwrap().0.unwrap().d;
    let parameters = Parameters { d: known, ..PLAIN };
    let chart = drawn(&parameters, plane(Knob::R, (0.0, 0.5), Knob::D3, (-0.5, 2.0)), 10);
    assert_eq!(chart.plane.along(), Knob::R);
    let mut seen = 0;
    for line in chart.lines.iter().filter(|line| line.at > 0.0) {
        let product = powi(line.fold.unwrap(), 2) * line.at;
        assert!((product / (0.01 * 0.5) - 1.0).abs() < 1e-9, "{product}");
        // (48) is within 0.6 % in D, which is 2 % in r^2 D3.
        assert!((line.harmonic.unwrap() / line.fold.unwrap() - 1.0).abs() < 0.01);
        seen += 1;
    }
    assert!(seen > 8);
    assert_eq!(chart.regime_at(0.4, -0.2), Some(Regime::Finite));
}

#[test]
fn every_band_holds_what_is_computed_there() {
    let asymmetric = Parameters { d2: 0.6, ..PLAIN };
    let linear = Parameters { d2: 0.6, d3: 0.0, ..PLAIN };
    for (parameters, plane) in [
        (PLAIN, plane(Knob::D, (-0.8, 0.2), Knob::D3, (-0.5, 1.0))),
        (asymmetric, plane(Knob::D3, (-0.5, 1.0), Knob::D, (-0.8, 0.2))),
        (linear, plane(Knob::D, (-1.2, 0.2), Knob::R, (0.0, 0.6))),
        (asymmetric, plane(Knob::D2, (-1.5, 1.5), Knob::D3, (-0.2, 0.8))),
        (linear, plane(Knob::D2, (-1.5, 1.5), Knob::R, (0.0, 0.8))),
        (asymmetric, plane(Knob::R, (0.0, 0.5), Knob::D3, (-0.5, 2.0))),
    ] {
        bands_are_right(&parameters, &drawn(&parameters, plane, 8));
    }
}

#[test]
fn planes_that_are_not_are_refused() {
    for plane in [
        plane(Knob::D, (-1.0, 0.0), Knob::D, (0.0, 1.0)),
        plane(Knob::Q0, (-1.0, 0.0), Knob::D, (0.0, 1.0)),
    ] {
        let refused = chart(&PLAIN, plane, COARSE, &Limits::PATIENT).unwrap_err();
        assert!(matches!(refused, Reason::NotApplicable { .. }));
    }
}

#[test]
fn lines_stand_closer_where_a_sign_changes() {
    let at = values(Knob::D3, (-1.0, 3.0), 8);
    assert!(at.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(at.iter().all(|value| value.abs() >= 1e-6));
    assert_eq!((at[0], at[at.len() - 1]), (-1.0, 3.0));
    assert!(values(Knob::R, (-1.0, 1.0), 8).iter().all(|&value| value > 0.0));
}

#[test]
fn between_lines_boundaries_are_followed_as_closely_as_asked() {
    // With friction to the right the fold is hyperbolic: r^2 D3 is the same all along.
    let over_r = plane(Knob::R, (0.0, 0.5), Knob::D3, (0.02, 2.0));
    let chord = 1e-4;
    let resolution = Resolution { lines: 8, chord, ..COARSE };
    let close = chart(&PLAIN, over_r, resolution, &Limits::PATIENT).unwrap();
    let [run] = &close.boundary(|line| line.fold)[..] else { panic!("one run") };
    let kappa = powi(run[0].0, 2) * run[0].1;
    let mut farthest: f64 = 0.0;
    for pair in run.windows(2) {
        let middle = (f64::midpoint(pair[0].0, pair[1].0), f64::midpoint(pair[0].1, pair[1].1));
        // The distance to the chord, both sides of the chart being equally long.
        let slope = ((pair[1].0 - pair[0].0) / 0.5) / ((pair[1].1 - pair[0].1) / 1.98);
        let aside = (middle.0 - (kappa / middle.1).sqrt()) / 0.5;
        farthest = farthest.max(aside.abs() / hypot(1.0, slope));
    }
    assert!(farthest < chord, "{farthest}");
    // Where the boundary comes into the range, just below D3 = kappa / 0.25, nothing is left blank.
    let enters = kappa / 0.25;
    for part in [0.7, 0.9, 0.99, 1.01, 1.1] {
        let expected = if part < 1.0 {
            Regime::Coexisting
        } else {
            Regime::Global
        };
        assert_eq!(close.regime_at(0.4999, enters * part), Some(expected), "{part}");
    }
    assert!(close.lines.windows(2).all(|pair| pair[0].at < pair[1].at));
    assert!(close.lines.len() < 80, "{}", close.lines.len());
}
