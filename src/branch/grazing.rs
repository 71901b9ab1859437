//! Where the stable cycle grazes the sticking set, instead of meeting an unstable one.
//!
//! Below `D = -1` motions leave the end of the set along one curve. The cycle ends where this curve comes back to the
//! other end.

use super::fold_point::FoldPoint;
use crate::flow::{Cost, Limits, Reason};
use crate::model::Parameters;
use crate::numerics::root::{PlaceTolerance, illinois};
use crate::portrait::closing::all::{STEP, all_closings};
use crate::portrait::closing::equation::Equation;
use crate::portrait::closing::rim::WayFromRim;

/// Just beyond critical damping, and the largest damping tried.
const CRITICAL: f64 = -1.0 - 1e-3;
const LARGEST: f64 = -1e6;

/// The damping at which the stable cycle grazes the sticking set, and that cycle; `None` where none does below
/// `D = -1`, or it cannot be told. Fails with [`Reason::Interrupted`].
pub fn grazing(
    parameters: &Parameters,
    limits: &Limits,
) -> Result<(Option<FoldPoint>, Cost), Reason> {
    let mut cost = Cost::default();
    match found(parameters, limits, &mut cost) {
        Err(Reason::Interrupted) => Err(Reason::Interrupted),
        found => Ok((found.unwrap_or_default(), cost)),
    }
}

fn found(
    parameters: &Parameters,
    limits: &Limits,
    cost: &mut Cost,
) -> Result<Option<FoldPoint>, Reason> {
    /// How far above it cycles are looked for, as a fraction of the damping.
    const BESIDE: f64 = 1e-9;
    let Some((d, way)) = damping(parameters, limits, cost)? else { return Ok(None) };
    // Above it no motion leaves the end of the set: a cycle further out means that two meet.
    let mut clear = Equation::new(&Parameters { d: (1.0 - BESIDE) * d, ..*parameters }, STEP);
    let beyond = all_closings(&mut clear, limits);
    *cost += clear.cost();
    if !beyond?.is_empty() {
        return Ok(None);
    }
    // The cycle starts at the end of the set, and takes forever to leave it.
    Ok(Some(FoldPoint { d, q_max: way.q_max, period: f64::INFINITY, grazes: true }))
}

/// Where the curve that leaves the end of the set begins to come back beyond the other end, to rounding.
fn damping(
    parameters: &Parameters,
    limits: &Limits,
    cost: &mut Cost,
) -> Result<Option<(f64, WayFromRim)>, Reason> {
    const ROUNDING: f64 = 2.0 * f64::EPSILON;
    let mut way = |d: f64| {
        let mut equation = Equation::new(&Parameters { d, ..*parameters }, STEP);
        let way = equation.way_from_rim(limits);
        *cost += equation.cost();
        way
    };
    let mut above = (CRITICAL, way(CRITICAL)?.excess);
    if above.1 > 0.0 {
        return Ok(None);
    }
    let mut below = (2.0 * CRITICAL, way(2.0 * CRITICAL)?.excess);
    while below.1 <= 0.0 {
        above = below;
        below = (2.0 * below.0, way(2.0 * below.0)?.excess);
        if below.0 < LARGEST {
            return Ok(None);
        }
    }
    let excess = |d: f64| way(d).map(|way| way.excess);
    let [(d, _), _] = illinois([below, above], 0.0, PlaceTolerance::Relative(ROUNDING), excess)?;
    Ok(Some((d, way(d)?)))
}
