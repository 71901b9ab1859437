//! Statements that a closed form proves true are accepted; false ones next to them are refused.

use super::*;
use crate::numerics::interval::PI;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// Whether a cycle step is accepted.
fn shown(
    kind: StepKind,
    parameters: [f64; 4],
    [from, to]: Bounds,
    clearance: Bounds,
) -> Result<usize, String> {
    let step =
        CertificateStep { kind, from, to: Some(to), clearance: Some(clearance), fences: None };
    step.verify(parameters.map(point), from)
}

/// Without D2 and D3 both half swings multiply by `m = exp(-pi D/sqrt(1 - D^2))`, so that `G' = m^2`.
fn stretch(d: f64) -> Interval {
    (-(PI * d) / ((point(1.0) + d) * (point(1.0) - d)).sqrt()).exp()
}

#[test]
fn the_derivative_of_linear_swings_is_held() {
    for (d, r) in [(-0.2, 0.1), (-0.05, 0.0), (0.1, 0.02), (0.3, 0.1)] {
        let square = stretch(d).square();
        let linear = [d, 0.0, 0.0, r].map(point);
        for (inverse, exact) in [(false, square), (true, point(1.0) / square)] {
            for z in [0.7, 3.0] {
                let slope = Map::new(linear, inverse, [0.0; 2]).slope(point(z));
                let Some(slope) = slope.filter(|it| it.lower() > 0.0) else {
                    // In forward time these have come to rest.
                    assert!(!inverse && d > 0.0 && r > 0.0, "{d} {r} {z}");
                    continue;
                };
                assert!(slope.intersection(exact).is_some(), "{d} {r} {z}: {slope} {exact}");
                assert!(slope.width() < 1e-11, "{d} {r} {z}: {slope}");
            }
        }
    }
}

/// The cycle of linear swings has the clearance `2 r/(m - 1)`.
#[test]
fn bounds_of_a_clearance_that_miss_it_are_refused() {
    let (d, r) = (-0.2, 0.1);
    let exact = (point(2.0 * r) / (stretch(d) - 1.0)).middle();
    let linear = [d, 0.0, 0.0, r];
    let within = [0.9999 * exact, 1.0001 * exact];
    let shown = |low: f64, high: f64| {
        shown(StepKind::Unstable, linear, within, [exact * (1.0 + low), exact * (1.0 + high)])
    };
    let off = 1e-12;
    assert_eq!(shown(-off, off), Ok(1));
    assert_eq!(shown(off, 2.0 * off).unwrap_err(), "the clearance may be below its bounds");
    assert_eq!(shown(-2.0 * off, -off).unwrap_err(), "the clearance may be above its bounds");
}

/// Next to a fold two cycles are close: the derivative of G is 1.0022 at one and 0.9978 at the other. A step
/// that contains both and claims one is wrong by that little.
#[test]
fn a_step_that_holds_two_cycles_is_refused() {
    let near_fold = [-0.172_784_28, 0.2, 0.5, 0.1];
    let [repelling, attracting] = [0.415_062_415_659, 0.416_021_602_729];
    let around = [attracting - 1e-9, attracting + 1e-9];
    let shown = |from: f64| shown(StepKind::Stable, near_fold, [from, attracting + 1e-6], around);
    assert_eq!(shown(attracting - 1e-6), Ok(1));
    assert_eq!(shown(repelling - 1e-6).unwrap_err(), "the map that should contract may not");
}

/// `r + 2 D w + D3 w^3` for `D = -3/8`, `D3 = 1/4` has its minimum at `w = 1`: `r - 1/2`.
#[test]
fn the_first_integral_falls_where_its_rate_has_one_sign() {
    for (off, holds) in [(1e-12, Some(0)), (-1e-12, None)] {
        let parameters = [-0.375, 0.2, 0.25, 0.5 * (1.0 + off)];
        assert_eq!(StepKind::OneWay.theorem(parameters.map(point)), holds, "{off}");
    }
}

/// Each set meets all conditions of its theorem, or all but one.
#[test]
fn a_theorem_needs_each_of_its_conditions() {
    use StepKind::{Affine, Frictionless, OneWay, Overdamped};
    for (kind, parameters, shown) in [
        (Overdamped, [-1.0, 0.3, 0.0, 0.1], Some(0)),
        (Overdamped, [-0.999, 0.3, 0.0, 0.1], None),
        (Overdamped, [-1.0, 0.3, 1e-9, 0.1], None),
        (Affine, [-0.2, 0.0, 0.0, 0.1], Some(1)),
        (Affine, [-0.2, 1e-9, 0.0, 0.1], None),
        (Affine, [-0.2, 0.0, 1e-9, 0.1], None),
        (Affine, [-1.0, 0.0, 0.0, 0.1], None),
        (Affine, [0.0, 0.0, 0.0, 0.1], None),
        (Affine, [-0.2, 0.0, 0.0, 0.0], None),
        (Frictionless, [-0.2, 0.3, 0.5, 0.0], Some(1)),
        (Frictionless, [0.2, 0.3, -0.5, 0.0], Some(1)),
        (Frictionless, [-0.2, 0.3, 0.5, 1e-9], None),
        (Frictionless, [-0.2, 0.3, -0.5, 0.0], None),
        (OneWay, [-0.2, 0.3, -0.5, 0.0], Some(0)),
        (OneWay, [-0.2, 0.3, -0.5, 1e-9], None),
        (OneWay, [0.2, 0.3, 0.0, 0.1], Some(0)),
        (OneWay, [0.2, 0.3, -1e-9, 0.1], None),
        (OneWay, [-0.2, 0.3, 0.0, 0.1], None),
    ] {
        assert_eq!(kind.theorem(parameters.map(point)), shown, "{kind:?} {parameters:?}");
    }
}

/// Bounds in the wrong order contain nothing, of which any statement would be true; and friction is never negative.
#[test]
fn bounds_that_hold_no_parameters_are_refused() {
    let with = |d: &str, r: &str| {
        let steps = r#"[{"step": "one-way", "from": 0.0}]"#;
        check(&format!(
            r#"{{"parameters": [{d}, [0, 0], [0, 0], {r}], "cycles": 0, "steps": {steps}}}"#
        ))
    };
    assert!(with("[0.1, 0.2]", "[0.1, 0.1]").is_ok());
    for (d, r) in [("[0.2, 0.1]", "[0.1, 0.1]"), ("[0.1, 0.2]", "[-0.1, 0.1]")] {
        assert_eq!(with(d, r).unwrap_err(), "line 1: these are not bounds of parameters");
    }
    assert!(with("[0.1, 1e999]", "[0.1, 0.1]").is_err());
}
