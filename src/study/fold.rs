//! The fold of limit cycles in D, and the borders that it and the escape point draw in a second parameter.
//!
//! For a given clearance exactly one D closes the cycle, so all cycles with `D3 > 0` are one graph
//! `D(u)`, `u = ln c0`, which rises from -1 to a largest value and falls again: the fold `D_F`. It is
//! found as the place where the multiplier is 1, beginning at the harmonic estimate (48, 49).

use serde::Serialize;

use super::basin::between;
use super::closing::{Route, first_side};
use super::continuation::{Curve, CurvePoint, Tangent};
use super::escape::escape_point;
use crate::closed_form::harmonic;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{Parameters, State, Symbol};

/// The fold at given D2, D3 and r.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FoldPoint {
    /// `D_F`: above it every motion is captured.
    #[serde(rename = "D")]
    pub d: f64,
    /// Right turning point of the cycle that is born there.
    pub q_max: f64,
    /// Its period.
    pub period: f64,
}

/// Relative error of the clearance at the fold; that of `D_F` is its square.
const TOLERANCE: f64 = 1e-13;

/// Finds the fold in D, or `None` where cycles have none (`D3 <= 0` or `r = 0`).
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn fold(parameters: &Parameters, limits: &Limits) -> Result<(Option<FoldPoint>, Cost), Reason> {
    /// First stride from the harmonic estimate, in u; it is doubled until the fold lies between.
    const STRIDE: f64 = 0.2;
    let Some(estimate) = harmonic::fold(parameters.d3, parameters.r) else {
        return Ok((None, Cost::default()));
    };
    let side = first_side(parameters);
    let mut curve = Curve::new(parameters, Symbol::D, side, 1.0, TOLERANCE, limits);
    // The first swing starts where its side's D2 brakes: the turning point displaced outwards.
    let shift = harmonic::mean(parameters.d2.abs(), estimate.amplitude).abs();
    let clearance = estimate.amplitude + shift - parameters.r;
    let u = clearance.max(0.1 * parameters.r).ln();
    let lost = Reason::NoConvergence { sought: "the fold", change: f64::NAN };
    let mut d = estimate.d;
    let mut at = |u: f64, curve: &mut Curve| -> Result<CurvePoint, Reason> {
        let near = curve.correct((u, d), Tangent::ACROSS_P, Route::Mixed)?;
        let found = match near {
            Some(found) => found,
            // Strong friction is far from harmonic: begin anew with all of (-1, 0).
            None => curve.bracketed(u, (-1.0 + f64::EPSILON, 0.0))?.ok_or(lost)?,
        };
        d = found.p;
        Ok(found)
    };
    let here = at(u, &mut curve)?;
    let (mut low, mut high) = (here, here);
    let mut stride = STRIDE;
    // The inner cycles are unstable (multiplier above 1), the outer ones stable.
    while low.log_multiplier <= 0.0 || high.log_multiplier > 0.0 {
        if low.log_multiplier <= 0.0 {
            low = at(low.u - stride, &mut curve)?;
        } else {
            high = at(high.u + stride, &mut curve)?;
        }
        stride *= 1.5;
        if stride > 40.0 {
            return Err(lost);
        }
    }
    let fold = curve.fold_between(&low, &high)?.ok_or(lost)?;
    let cycle = fold.closing.describe(&curve.parameters_at(fold.p), side);
    let point = FoldPoint { d: fold.p, q_max: cycle.q_max, period: cycle.period };
    Ok((Some(point), curve.cost))
}

/// One value of the second parameter, and where the basin changes its kind along D.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BorderPoint {
    /// Value of the second parameter.
    pub value: f64,
    /// The fold, where cycles fold.
    pub fold: Option<FoldPoint>,
    /// `D_F` of the first harmonic (48), for comparison.
    pub harmonic_fold: Option<f64>,
    /// `D_c`, where the cycle goes to infinity.
    pub escape: Option<f64>,
}

/// The fold and the escape point along a second parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Border {
    /// The parameters that stay.
    pub parameters: Parameters,
    /// The second parameter.
    pub second: Symbol,
    /// Its values and what was found there.
    pub points: Vec<BorderPoint>,
    /// What it cost.
    pub cost: Cost,
}

/// Finds the fold and the escape point at `count` values of `second` (D2, D3 or r) over `range`.
///
/// # Errors
/// The [`Reason`] why a point could not be computed; [`Reason::NotApplicable`] for other parameters.
pub fn border(
    parameters: &Parameters,
    second: Symbol,
    range: (f64, f64),
    count: usize,
    limits: &Limits,
) -> Result<Border, Reason> {
    if !matches!(second, Symbol::D2 | Symbol::D3 | Symbol::R) {
        return Err(Reason::NotApplicable { needs: "one of D2, D3, r to vary" });
    }
    let mut border =
        Border { parameters: *parameters, second, points: Vec::new(), cost: Cost::default() };
    for index in 0..count {
        let value = between(range, index, count);
        let mut here = *parameters;
        second.set(&mut here, &mut State { q: 0.0, v: 0.0 }, value);
        let (fold, cost) = fold(&here, limits)?;
        border.cost += cost;
        border.points.push(BorderPoint {
            value,
            fold,
            harmonic_fold: harmonic::fold(here.d3, here.r).map(|fold| fold.d),
            escape: escape_point(&here, limits)?,
        });
    }
    Ok(border)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Method, Problem};

    fn found(d2: f64, d3: f64, r: f64) -> FoldPoint {
        let parameters = Parameters { d: 0.0, d2, d3, r };
        fold(&parameters, &Limits::PATIENT).unwrap().0.expect("a fold")
    }

    #[test]
    fn the_fold_is_where_it_was_computed_elsewhere() {
        for (kappa, expected) in [(0.01, -0.217_412_751_691), (0.25, -0.639_011_106_199)] {
            assert!((found(0.0, kappa, 1.0).d - expected).abs() < 1e-11, "{kappa}");
        }
        let shifted = found(0.2, 0.5, 0.1);
        assert!((shifted.d + 0.172_784_103_071_94).abs() < 1e-13);
        assert!((shifted.q_max - 0.515_541_875_076).abs() < 1e-7);
    }

    /// Whether a motion from rest at `q0` comes back to its side further out.
    fn turn_grows(parameters: Parameters, q0: f64) -> bool {
        let initial = State { q: q0, v: 0.0 };
        let (method, tolerance) = (Method::Dop853, 1e-11);
        let problem =
            Problem { parameters, initial, until: 100.0, method, tolerance, ..Problem::default() };
        let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
        motion.crossings.get(1).is_some_and(|crossing| crossing.q > q0)
    }

    #[test]
    fn only_the_dimensionless_groups_and_the_size_of_d2_matter() {
        let fold = found(0.3, 0.4, 0.1);
        assert_eq!(found(-0.3, 0.4, 0.1).d.to_bits(), fold.d.to_bits());
        let scaled = found(0.3 / 4.0, 0.4 / 16.0, 0.4);
        assert!(
            (scaled.d - fold.d).abs() < 1e-13 && (scaled.q_max / fold.q_max - 4.0).abs() < 1e-6
        );
    }

    #[test]
    fn weak_and_strong_friction_have_their_folds_too() {
        let mut last = 0.0;
        for exponent in -12..=0 {
            let d = found(0.0, 10_f64.powi(exponent), 1.0).d;
            assert!(d < last, "kappa 1e{exponent}: {d} after {last}");
            last = d;
        }
        // Strong friction captures every motion even beyond critical negative damping.
        let grows = |d: f64| {
            let parameters = Parameters { d, d2: 0.0, d3: 1.0, r: 1.0 };
            (1..400).any(|index| turn_grows(parameters, 1.0 + 0.002 * f64::from(index)))
        };
        assert!(last < -1.0 && grows(last - 1e-4) && !grows(last + 1e-4), "{last}");
        // For weak friction the harmonic estimate is exact to leading order.
        let weak = found(0.0, 1e-12, 1.0).d;
        assert!((weak / harmonic::fold(1e-12, 1.0).unwrap().d - 1.0).abs() < 1e-6, "{weak}");
    }
}
