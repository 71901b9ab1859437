//! The fold of limit cycles in D, and the borders that it and the escape point draw in a second parameter.
//!
//! For a given clearance exactly one D closes the cycle, so all cycles with `D3 > 0` are one graph
//! `D(u)`, `u = ln c0`, which rises from -1 to a largest value and falls again: the fold `D_F`. Newton's method
//! finds it from an estimate ([`super::extended`]); where that fails, the graph is followed to its top
//! ([`super::fold_graph`]). Below `D = -1` cycles may end otherwise ([`mod@super::fold`]).
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::{Parameters, Knob};
//! use hopfscope::branch::fold::{border, fold};
//!
//! let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.01, r: 0.1 };
//! let (found, _) = fold(&parameters, &Limits::PATIENT)?;
//! assert!((found.unwrap().d + 0.046_814_10).abs() < 1e-8);
//!
//! // The border of the region without cycles, over the friction.
//! let border = border(&parameters, Knob::R, (0.1, 0.2), 3, &Limits::PATIENT)?;
//! assert_eq!(border.points.len(), 3);
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

use serde::Serialize;

use super::{FoldPlace, FoldPoint, escape_point, fold_near, highest_cycle};
use crate::closed_form::harmonic;
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters};
use crate::numerics::{PlaceTolerance, illinois};
use crate::portrait::{Equation, STEP, all_closings, evenly};

/// Maximum number of evaluations of one swing: a cycle that takes more is not followed.
const BUDGET: u64 = 200_000;

/// Smallest relative error of the clearance at the fold; that of `D_F` is its square.
const TOLERANCE: f64 = 1e-13;

/// Finds the fold in D, or `None` where cycles have none (`D3 <= 0` or `r = 0`).
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn fold(parameters: &Parameters, limits: &Limits) -> Result<(Option<FoldPoint>, Cost)> {
    fold_within(parameters, TOLERANCE, limits)
}

/// The same with another relative error of the clearance; that of `D_F` is its square, to rounding.
///
/// # Errors
/// As [`fold`].
pub fn fold_within(
    parameters: &Parameters,
    tolerance: f64,
    limits: &Limits,
) -> Result<(Option<FoldPoint>, Cost)> {
    /// Estimates below which the stable cycle may graze the sticking set.
    const STRONG: f64 = -0.9;
    let Some(harmonic) = harmonic::fold(parameters.d3, parameters.r) else {
        return Ok((None, Cost::default()));
    };
    let limits = &limits.up_to(BUDGET);
    let mut cost = Cost::default();
    if let Some(guess) = FoldPlace::in_damping(parameters)
        && let Some(found) = cost.spend(fold_near(&guess, Knob::D, tolerance, limits)?)
    {
        return Ok((Some(FoldPoint::of(&found.closing, &found.place.parameters)), cost));
    }
    // A rough fold, one of many on a map, need not be found at any cost.
    let thorough = tolerance <= TOLERANCE;
    let grazing = |cost: &mut Cost| -> Result<Option<FoldPoint>> {
        Ok(Reason::tolerated(grazing_cycle(parameters, limits, cost))?.unwrap_or_default())
    };
    let strong = harmonic.d < STRONG;
    if thorough
        && strong
        && let Some(point) = grazing(&mut cost)?
    {
        return Ok((Some(point), cost));
    }
    let met = cost.spend(highest_cycle(parameters, tolerance, limits));
    let lost = match &met {
        Ok((met, log_multiplier)) => {
            met.d < -1.0 && (log_multiplier.is_nan() || log_multiplier.abs() >= 1.0)
        }
        Err(reason) => *reason != Reason::Interrupted,
    };
    if thorough
        && lost
        && !strong
        && let Some(point) = grazing(&mut cost)?
    {
        return Ok((Some(point), cost));
    }
    Ok((Some(met?.0), cost))
}

/// One value of the second parameter, and where the basin changes its kind along D.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoundaryPoint {
    /// Value of the second parameter.
    pub value: f64,
    /// The fold, where cycles fold.
    pub fold: Option<FoldPoint>,
    /// `D_F` of the first harmonic (48), for comparison.
    pub harmonic_fold: Option<f64>,
    /// `D_c`, where the cycle goes to infinity.
    pub escape: Option<f64>,
    /// Why one of them could not be computed, or why there is neither.
    pub reason: Option<String>,
}

/// The fold and the escape point along a second parameter.
#[derive(Debug)]
pub struct Boundary {
    /// The parameters that stay.
    pub parameters: Parameters,
    /// The second parameter.
    pub second: Knob,
    /// Its values and what was found there.
    pub points: Vec<BoundaryPoint>,
    /// What it cost.
    pub cost: Cost,
}

/// Finds the fold and the escape point at `count` values of `second` (D2, D3 or r) over `range`.
///
/// # Errors
/// [`Reason::Interrupted`], or [`Reason::NotApplicable`] for other parameters. A point that cannot be computed
/// says why.
pub fn border(
    parameters: &Parameters,
    second: Knob,
    range: (f64, f64),
    count: usize,
    limits: &Limits,
) -> Result<Boundary> {
    if second == Knob::D || !second.is_parameter() {
        return Err(Reason::NotApplicable { needs: "one of D2, D3, r to vary" });
    }
    let mut border =
        Boundary { parameters: *parameters, second, points: Vec::new(), cost: Cost::default() };
    for value in evenly(range, count) {
        let here = parameters.with(second, value);
        let found = Reason::tolerated(fold(&here, limits))?;
        let escape = Reason::tolerated(escape_point(&here, limits))?;
        let failed = found.as_ref().err().or(escape.as_ref().err()).map(Reason::to_string);
        let fold = border.cost.spend(found.unwrap_or_default());
        let escape = border.cost.spend(escape.unwrap_or_default());
        let neither = fold.is_none() && escape.is_none();
        let reason = failed.or_else(|| neither.then(|| no_border(&here).to_owned()));
        border.points.push(BoundaryPoint {
            value,
            fold,
            harmonic_fold: harmonic::fold(here.d3, here.r).map(|fold| fold.d),
            escape,
            reason,
        });
    }
    Ok(border)
}

/// Why there is neither a fold nor an escape point, where none failed; [`Regime::of`](super::Regime::of) says the same.
fn no_border(parameters: &Parameters) -> &'static str {
    match *parameters {
        Parameters { r: 0.0, .. } => {
            "without friction the only border is the Hopf bifurcation at D = 0"
        }
        Parameters { d3, .. } if d3 < 0.0 => "D3 < 0: an unstable cycle borders the basin",
        Parameters { d3, .. } if d3 > 0.0 => "no fold was found",
        Parameters { d2: 0.0, .. } => "D2 = D3 = 0: the unstable cycle is infinite at D = 0",
        _ => "D3 = 0: D_c lies below -1",
    }
}

// Where the stable cycle grazes the sticking set, instead of meeting an unstable one.
//
// Below `D = -1` motions leave the end of the set along one curve. The cycle ends where this curve comes back to the
// other end.

/// Just beyond critical damping, and the largest damping tried.
const CRITICAL: f64 = -1.0 - 1e-3;
const LARGEST: f64 = -1e6;

/// The damping at which the stable cycle grazes the sticking set, and that cycle; `None` where none does below
/// `D = -1`. Fails with the [`Reason`] why a swing could not be computed.
fn grazing_cycle(
    parameters: &Parameters,
    limits: &Limits,
    cost: &mut Cost,
) -> Result<Option<FoldPoint>> {
    /// How far above it cycles are looked for, as a fraction of the damping.
    const BESIDE: f64 = 1e-9;
    const ROUNDING: f64 = 2.0 * f64::EPSILON;
    let mut way = |d: f64| {
        let mut equation = Equation::new(&Parameters { d, ..*parameters }, STEP, limits);
        let way = equation.way_from_rim();
        *cost += equation.cost();
        way
    };
    let mut below = (CRITICAL, way(CRITICAL)?.excess);
    if below.1 > 0.0 {
        return Ok(None);
    }
    let mut above = below;
    while below.1 <= 0.0 {
        above = below;
        below = (2.0 * below.0, way(2.0 * below.0)?.excess);
        if below.0 < LARGEST {
            return Ok(None);
        }
    }
    // Where the curve that leaves the end of the set begins to come back beyond the other end, to rounding.
    let excess = |d: f64| way(d).map(|way| way.excess);
    let [(d, _), _] = illinois([below, above], 0.0, PlaceTolerance::Relative(ROUNDING), excess)?;
    let q_max = way(d)?.q_max;
    // Above it no motion leaves the end of the set: a cycle further out means that two meet.
    let mut clear =
        Equation::new(&Parameters { d: (1.0 - BESIDE) * d, ..*parameters }, STEP, limits);
    let beyond = all_closings(&mut clear);
    *cost += clear.cost();
    if !beyond?.is_empty() {
        return Ok(None);
    }
    // The cycle starts at the end of the set, and takes forever to leave it.
    Ok(Some(FoldPoint { d, q_max, period: f64::INFINITY, grazes: true }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Method, Problem};
    use crate::model::State;
    use crate::numerics::elementary::powi;
    use crate::portrait::basin::cycle::cycles;

    fn found(d2: f64, d3: f64, r: f64) -> FoldPoint {
        let parameters = Parameters { d: 0.0, d2, d3, r };
        fold(&parameters, &Limits::PATIENT).unwrap().0.expect("a fold")
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
    fn cycles_exist_below_the_fold_and_not_above_also_where_it_is_far_from_harmonic() {
        for (d2, d3) in [(0.3, 0.8), (1.0, 0.1), (0.05, 1.3), (0.5, 0.3)] {
            let d = found(d2, d3, 1.0).d;
            let count = |part: f64| {
                let parameters = Parameters { d: part * d, d2, d3, r: 1.0 };
                crate::portrait::basin::cycle::cycles(&parameters, &Limits::PATIENT).unwrap()
            };
            assert!(!count(1.0 + 1e-4).cycles.is_empty(), "D2 = {d2}, D3 = {d3}: D_F = {d}");
            let above = count(1.0 - 1e-4);
            assert!(above.cycles.is_empty(), "D2 = {d2}, D3 = {d3}: D_F = {d}");
            assert_eq!(
                above.border,
                crate::portrait::Border::None,
                "D2 = {d2}, D3 = {d3}: D_F = {d}"
            );
        }
    }

    #[test]
    fn weak_cubic_damping_folds_where_the_cycle_escapes_without_it() {
        for d2 in [0.1, 0.3, 1.0] {
            let without = Parameters { d: 0.0, d2, d3: 0.0, r: 1.0 };
            let escape = escape_point(&without, &Limits::PATIENT).unwrap().0.unwrap();
            let [near, far] = [1e-6, 1e-4].map(|d3| (found(d2, d3, 1.0).d - escape).abs());
            assert!(near < 5e-5 && near < 0.02 * far, "D2 = {d2}: {near} {far}");
        }
    }

    #[test]
    fn cycles_meet_below_critical_damping_too_as_long_as_numbers_can_tell() {
        // Both from an integration of the curve that leaves the end of the sticking set, and of the cycles:
        // with D3 = 2 the unstable cycle lives on an interval of 3e-7 in D.
        for (d3, d, clearance) in [(1.0, -1.029_759_8, 0.058_5), (2.0, -1.356_087_526, 2e-6)] {
            let point = found(0.0, d3, 1.0);
            assert!((point.d - d).abs() < 1e-7 && !point.grazes, "{point:?}");
            assert!((point.q_max - 1.0 - clearance).abs() < 0.2 * clearance, "{point:?}");
        }
    }

    #[test]
    fn with_strong_friction_and_d2_the_largest_damping_of_any_cycle_is_found() {
        for r in [2.0, 4.0] {
            let d = found(0.6, 0.125, r).d;
            assert!(d < -1.0, "r = {r}: {d}");
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
                let limits = Limits::PATIENT;
                let parameters = Parameters { d: 0.0, d2: 0.6, d3: 0.125, r };
                let rough = fold_within(&parameters, tolerance, &limits).unwrap().0.unwrap().d;
                assert!((rough / d - 1.0).abs() < tolerance, "{rough} {d}");
            }
        }
    }

    #[test]
    fn weak_and_strong_friction_have_their_folds_too() {
        let mut last = 0.0;
        for exponent in -12..=0 {
            let d = found(0.0, powi(10.0, exponent), 1.0).d;
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

    /// What is said in place of a border, against the search for cycles, which knows nothing of it.
    #[test]
    fn where_there_is_no_border_the_cycles_say_why() {
        let said = |d2: f64, d3: f64, r: f64| {
            let parameters = Parameters { d: 0.0, d2, d3, r: 0.0 };
            let found = border(&parameters, Knob::R, (r, 2.0 * r + 1.0), 2, &Limits::PATIENT);
            found.unwrap().points[0].reason.clone().unwrap()
        };
        let largest = |d: f64, d2: f64, d3: f64, r: f64| {
            let found = cycles(&Parameters { d, d2, d3, r }, &Limits::PATIENT).unwrap();
            found.cycles.last().filter(|cycle| !cycle.stable).map(|cycle| cycle.q_max)
        };
        assert_eq!(said(0.3, -0.5, 0.1), "D3 < 0: an unstable cycle borders the basin");
        assert!([-0.9, -0.3, 0.0, 0.4].iter().all(|d| largest(*d, 0.3, -0.5, 0.1).is_some()));
        // It grows like 2 r / (pi |D|).
        assert_eq!(said(0.0, 0.0, 0.1), "D2 = D3 = 0: the unstable cycle is infinite at D = 0");
        let near = largest(-1e-6, 0.0, 0.0, 0.1).unwrap();
        assert!((near * 1e-6 * std::f64::consts::PI / 0.2 - 1.0).abs() < 1e-5, "{near}");
        assert_eq!(said(5.0, 0.0, 3.4), "D3 = 0: D_c lies below -1");
        assert!([-0.999, -0.5, -0.01].iter().all(|d| largest(*d, 5.0, 0.0, 3.4).is_none()));
        assert!(said(0.3, 0.5, 0.0).starts_with("without friction"));
    }
}
