//! The fold of limit cycles in D, and the borders that it and the escape point draw in a second parameter.
//!
//! For a given clearance exactly one D closes the cycle, so all cycles with `D3 > 0` are one graph
//! `D(u)`, `u = ln c0`, which rises from -1 to a largest value and falls again: the fold `D_F`. It is
//! found as the place where the multiplier is 1, beginning at the harmonic estimate (48, 49).

use serde::Serialize;

use super::basin::between;
use super::closing::{Equation, Route, first_side};
use super::closings::{STEP, all_closings, innermost_closing};
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
    /// Whether the stable cycle grazes the sticking set there, instead of meeting an unstable one.
    ///
    /// Below `D = -1` motions leave the end of the set along one curve. An unstable cycle exists only between
    /// the damping at which that curve leads to the other end of the set and the fold, and these two approach
    /// each other quickly: for `D2 = 0`, `r = 1` they are 0.027 apart at `D3 = 1`, 3e-7 at 2, 1e-14 at 10.
    #[serde(skip)]
    pub grazes: bool,
}

/// Least relative error of the clearance at the fold; that of `D_F` is its square.
const TOLERANCE: f64 = 1e-13;

/// Finds the fold in D, or `None` where cycles have none (`D3 <= 0` or `r = 0`).
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn fold(parameters: &Parameters, limits: &Limits) -> Result<(Option<FoldPoint>, Cost), Reason> {
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
) -> Result<(Option<FoldPoint>, Cost), Reason> {
    let Some(start) = start(parameters) else { return Ok((None, Cost::default())) };
    let side = first_side(parameters);
    let limits =
        Limits { evaluations: limits.evaluations.min(BUDGET), interrupted: limits.interrupted };
    let curve = Curve::new(parameters, Symbol::D, side, 1.0, tolerance, &limits);
    let mut graph = Graph { curve, parameters: *parameters, d: start.d };
    let met = graph.meeting(start);
    let lost = match &met {
        Ok(fold) => {
            fold.p < -1.0 && (fold.log_multiplier.is_nan() || fold.log_multiplier.abs() >= 1.0)
        }
        Err(reason) => *reason != Reason::Interrupted,
    };
    // A rough fold, one of many on a map, need not be found at such a cost.
    if lost
        && tolerance <= TOLERANCE
        && let Some((point, mut cost)) = grazing(parameters, &limits)?
    {
        cost += graph.curve.cost;
        return Ok((Some(point), cost));
    }
    let fold = met?;
    let cycle = fold.closing.describe(&graph.curve.parameters_at(fold.p), side);
    let grazes = fold.p < -1.0 && cycle.is_stable_beyond_doubt();
    let point = FoldPoint { d: fold.p, q_max: cycle.q_max, period: cycle.period, grazes };
    Ok((Some(point), graph.curve.cost))
}

/// The damping at which the stable cycle grazes the sticking set, and that cycle; `None` where none does below
/// `D = -1`.
///
/// There the curve along which motions leave one end of the set comes back to it. Bisection, to rounding.
fn grazing(parameters: &Parameters, limits: &Limits) -> Result<Option<(FoldPoint, Cost)>, Reason> {
    /// Just beyond critical damping, the largest damping tried, and the width at the end.
    const CRITICAL: f64 = -1.0 - 1e-3;
    const LARGEST: f64 = -1e6;
    const ROUNDING: f64 = 2.0 * f64::EPSILON;
    /// How far above it cycles are looked for, as a part of the damping.
    const BESIDE: f64 = 1e-9;
    let mut cost = Cost::default();
    let mut leaves = |d: f64| {
        let mut equation = Equation::new(&Parameters { d, ..*parameters }, STEP);
        let leaves = equation.leaves_rim(limits);
        cost += equation.cost();
        leaves
    };
    let (mut above, mut below) = (CRITICAL, 2.0 * CRITICAL);
    if leaves(above)? {
        return Ok(None);
    }
    while !leaves(below)? {
        (above, below) = (below, 2.0 * below);
        if below < LARGEST {
            return Ok(None);
        }
    }
    while above - below > ROUNDING * -below {
        let middle = 0.5 * (above + below);
        if leaves(middle)? {
            below = middle;
        } else {
            above = middle;
        }
    }
    // Above it no motion leaves the end of the set; a cycle further out means a fold that was not found.
    let clear = Parameters { d: (1.0 - BESIDE) * below, ..*parameters };
    if !all_closings(&mut Equation::new(&clear, STEP), limits)?.is_empty() {
        return Ok(None);
    }
    let there = Parameters { d: below, ..*parameters };
    let mut equation = Equation::new(&there, STEP);
    let cycle = innermost_closing(&mut equation, limits)
        .ok()
        .flatten()
        .map(|closing| closing.describe(&there, equation.side));
    cost += equation.cost();
    // At the grazing itself the cycle starts at the end of the set, and takes for ever to leave it.
    let (q_max, period) =
        cycle.map_or((parameters.r, f64::INFINITY), |cycle| (cycle.q_max, cycle.period));
    Ok(Some((FoldPoint { d: below, q_max, period, grazes: true }, cost)))
}

/// Most evaluations of one swing: a cycle that takes more is not followed.
const BUDGET: u64 = 200_000;

const LOST: Reason = Reason::NoConvergence { sought: "the fold", change: f64::NAN };

/// Where the search begins.
#[derive(Clone, Copy)]
struct Start {
    u: f64,
    d: f64,
    /// First stride in u.
    stride: f64,
}

/// The harmonic estimate where it is near, else a cycle close to the sticking set, which lies below the
/// fold.
fn start(parameters: &Parameters) -> Option<Start> {
    /// Mean shift, as a part of the amplitude, and damping up to which the harmonic estimate is near.
    const NEAR: (f64, f64) = (0.3, 0.8);
    /// Clearance that is small, in units of r.
    const CLOSE: f64 = 0.2;
    let estimate = harmonic::fold(parameters.d3, parameters.r)?;
    // The first swing starts where its side's D2 brakes: the turning point displaced outwards.
    let shift = harmonic::mean(parameters.d2.abs(), estimate.amplitude).abs();
    let near = shift < NEAR.0 * estimate.amplitude && estimate.d > -NEAR.1;
    let clearance =
        if near { estimate.amplitude + shift - parameters.r } else { CLOSE * parameters.r };
    let u = clearance.max(CLOSE * parameters.r).ln();
    Some(Start { u, d: estimate.d.max(-0.5), stride: if near { 0.2 } else { 0.5 } })
}

/// What is known of the place of the fold.
enum Around {
    /// It lies between these.
    Between(Box<[CurvePoint; 2]>),
    /// Cycles grow and grow while D stays the same to rounding: the fold is where they begin to shrink,
    /// and its D is this one. So it is where D3 is much weaker than D2.
    Plateau(Box<CurvePoint>),
}

/// All cycles as the graph `D(u)`.
struct Graph<'a> {
    curve: Curve<'a>,
    parameters: Parameters,
    /// D of the last cycle found, the guess for the next.
    d: f64,
}

impl Graph<'_> {
    /// The cycle at which two meet.
    fn meeting(&mut self, start: Start) -> Result<CurvePoint, Reason> {
        match self.around_fold(start)? {
            Around::Plateau(point) => Ok(*point),
            Around::Between(ends) => match self.curve.fold_between(&ends[0], &ends[1])? {
                Some(fold) => Ok(fold),
                None => self.highest(ends[0], ends[1]),
            },
        }
    }

    /// The cycle at `u`; `None` where it cannot be followed that far out.
    fn at(&mut self, u: f64) -> Result<Option<CurvePoint>, Reason> {
        let near = self.curve.correct((u, self.d), Tangent::ACROSS_P, Route::Mixed)?;
        let found = match near {
            Some(found) => Some(found),
            // Far from the guess: begin anew with all of the dampings that can close a cycle.
            None => match self.curve.bracketed(u, (self.lowest_damping(u), 0.0)) {
                Err(Reason::Budget { .. } | Reason::OutOfRange) => None,
                found => found?,
            },
        };
        if let Some(found) = found {
            self.d = found.p;
        }
        Ok(found)
    }

    /// A damping below that of the cycle at `u`: well beyond the harmonic one, and beyond critical.
    fn lowest_damping(&self, u: f64) -> f64 {
        let Parameters { d2, d3, r, .. } = self.parameters;
        let harmonic = harmonic::damping_at(d3, r, u.exp() + r).unwrap_or(-1.0);
        -1.5 + 2.0 * harmonic - r * d2.abs()
    }

    /// A cycle on either side of the fold: the inner ones are unstable (multiplier above 1), the outer
    /// ones stable.
    fn around_fold(&mut self, start: Start) -> Result<Around, Reason> {
        /// Shortest and longest stride, and strides before giving up.
        const LENGTHS: (f64, f64) = (0.01, 1.0);
        const STRIDES: usize = 60;
        let mut stride = start.stride;
        let here = self.at(start.u)?.ok_or(LOST)?;
        let (mut low, mut high) = (here, here);
        let mut flat = false;
        for _ in 0..STRIDES {
            // Where the second swing begins at the very end of the sticking set there is no multiplier:
            // next to it it is infinite.
            let inwards = low.log_multiplier <= 0.0;
            if !inwards && high.log_multiplier <= 0.0 {
                return Ok(Around::Between(Box::new([low, high])));
            }
            let u = if inwards { low.u - stride } else { high.u + stride };
            match self.at(u)? {
                Some(next) if inwards => low = next,
                Some(next) => {
                    // The fold lies beyond: what is behind is no longer needed.
                    if next.log_multiplier > 0.0 || next.log_multiplier.is_nan() {
                        low = next;
                    }
                    let rise = (next.p - high.p).abs();
                    flat = rise <= 4.0 * self.curve.fineness() * next.p.abs();
                    if flat && stride >= LENGTHS.1 {
                        return Ok(Around::Plateau(Box::new(next)));
                    }
                    high = next;
                }
                // Nor can it be followed to its end.
                None if flat => return Ok(Around::Plateau(Box::new(high))),
                None => stride *= 0.25,
            }
            stride = (1.5 * stride).min(LENGTHS.1);
            if stride < LENGTHS.0 {
                break;
            }
        }
        Err(LOST)
    }

    /// The cycle of the largest D between two, by golden section.
    ///
    /// For where the multiplier does not tell: beyond critical negative damping the second swing of a
    /// cycle may begin at the very end of the sticking set. D comes out to rounding, the amplitude to
    /// about half of the digits.
    fn highest(&mut self, low: CurvePoint, high: CurvePoint) -> Result<CurvePoint, Reason> {
        /// The shorter part of a golden section.
        const GOLDEN: f64 = 0.381_966_011_250_105_2;
        /// Width in u at which D is flat to rounding.
        const FLAT: f64 = 1e-7;
        let (mut from, mut to) = (low.u, high.u);
        let mut inner = self.at(from + GOLDEN * (to - from))?.ok_or(LOST)?;
        let mut outer = self.at(to - GOLDEN * (to - from))?.ok_or(LOST)?;
        while to - from > FLAT {
            if inner.p > outer.p {
                (to, outer) = (outer.u, inner);
                inner = self.at(from + GOLDEN * (to - from))?.ok_or(LOST)?;
            } else {
                (from, inner) = (inner.u, outer);
                outer = self.at(to - GOLDEN * (to - from))?.ok_or(LOST)?;
            }
        }
        Ok(if inner.p > outer.p { inner } else { outer })
    }
}

/// One value of the second parameter, and where the basin changes its kind along D.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BorderPoint {
    /// Value of the second parameter.
    pub value: f64,
    /// The fold, where cycles fold.
    pub fold: Option<FoldPoint>,
    /// `D_F` of the first harmonic (48), for comparison.
    pub harmonic_fold: Option<f64>,
    /// `D_c`, where the cycle goes to infinity.
    pub escape: Option<f64>,
    /// Why one of them could not be computed.
    pub reason: Option<String>,
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
/// [`Reason::Interrupted`], or [`Reason::NotApplicable`] for other parameters. A point that cannot be computed
/// says why.
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
        let found = fold(&here, limits);
        let escape = escape_point(&here, limits);
        let reason = found.as_ref().err().or(escape.as_ref().err()).copied();
        if reason == Some(Reason::Interrupted) {
            return Err(Reason::Interrupted);
        }
        let (fold, cost) = found.unwrap_or_default();
        border.cost += cost;
        border.points.push(BorderPoint {
            value,
            fold,
            harmonic_fold: harmonic::fold(here.d3, here.r).map(|fold| fold.d),
            escape: escape.unwrap_or_default(),
            reason: reason.map(|reason| reason.to_string()),
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
    fn cycles_exist_below_the_fold_and_not_above_also_where_it_is_far_from_harmonic() {
        for (d2, d3) in [(0.3, 0.8), (1.0, 0.1), (0.05, 1.3), (0.5, 0.3)] {
            let d = found(d2, d3, 1.0).d;
            let count = |part: f64| {
                let parameters = Parameters { d: part * d, d2, d3, r: 1.0 };
                crate::study::cycle::cycles(&parameters, false, &Limits::PATIENT).unwrap()
            };
            assert!(!count(1.0 + 1e-4).cycles.is_empty(), "D2 = {d2}, D3 = {d3}: D_F = {d}");
            let above = count(1.0 - 1e-4);
            assert!(above.cycles.is_empty(), "D2 = {d2}, D3 = {d3}: D_F = {d}");
            assert_eq!(above.edge, crate::study::Edge::None, "D2 = {d2}, D3 = {d3}: D_F = {d}");
        }
    }

    #[test]
    fn weak_cubic_damping_folds_where_the_cycle_escapes_without_it() {
        for d2 in [0.1, 0.3, 1.0] {
            let without = Parameters { d: 0.0, d2, d3: 0.0, r: 1.0 };
            let escape = escape_point(&without, &Limits::PATIENT).unwrap().unwrap();
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
