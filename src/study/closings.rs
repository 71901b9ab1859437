//! All closed pairs of half swings at given parameters.
//!
//! The roots of the closing equation ([`super::closing`]) are searched for between the smallest
//! clearance that a swing past the sticking set can have and the edge of escape ([`super::search`]),
//! then polished by Newton's method in the logarithm of the clearance along the route that contracts,
//! and weighed as energy ([`super::balance`]) where the multiplier is close to 1.

use super::balance::weighed_residual;
use super::closing::{Closing, Equation, Route};
use super::half_map::Length;
use super::search::{Bracket, Node, search};
use super::weak::{is_one_way, weak_closing};
use crate::closed_form::piecewise_linear::LinearCycle;
use crate::flow::{Limits, Reason};
use crate::oscillator::Parameters;

/// Tolerance of the integration steps of the search and the polish: rounding.
pub const STEP: f64 = 1e-16;

/// Slope of the residual below which it is weighed as energy.
const FLAT: f64 = 0.3;

/// Newton steps before giving up; bisection alone needs 60.
const ITERATIONS: usize = 200;

/// All closings, from the closed form where there is one.
///
/// # Errors
/// The [`Reason`] why a swing failed.
pub fn all_closings(equation: &mut Equation, limits: &Limits) -> Result<Vec<Closing>, Reason> {
    some_closings(equation, usize::MAX, limits)
}

/// The closing of the smallest amplitude, from the closed form where there is one: half the work of
/// finding all.
///
/// # Errors
/// The [`Reason`] why a swing failed.
pub fn innermost_closing(
    equation: &mut Equation,
    limits: &Limits,
) -> Result<Option<Closing>, Reason> {
    Ok(some_closings(equation, 1, limits)?.pop())
}

/// As many closings as are wanted, by amplitude, from the closed form where there is one.
fn some_closings(
    equation: &mut Equation,
    most: usize,
    limits: &Limits,
) -> Result<Vec<Closing>, Reason> {
    let parameters = equation.parameters;
    if parameters.is_piecewise_linear() {
        let cycle = LinearCycle::new(parameters.d, parameters.r).ok();
        return Ok(cycle.iter().map(Closing::from).collect());
    }
    if let Some(closing) = weak_closing(&parameters) {
        return Ok(vec![closing]);
    }
    searched(equation, most, &[], limits)
}

impl From<&LinearCycle> for Closing {
    fn from(cycle: &LinearCycle) -> Self {
        let clearance = Length { value: cycle.clearance, log: cycle.log_clearance };
        Closing::symmetric(clearance, cycle.period, cycle.v_max)
    }
}

/// All closings, by amplitude.
///
/// # Errors
/// The [`Reason`] why a swing failed.
pub fn closings(equation: &mut Equation, limits: &Limits) -> Result<Vec<Closing>, Reason> {
    searched(equation, usize::MAX, &[], limits)
}

/// All closings outside of the intervals of `ln c0` in which all are known, by amplitude.
///
/// # Errors
/// The [`Reason`] why a swing failed.
pub fn other_closings(
    equation: &mut Equation,
    known: &[(f64, f64)],
    limits: &Limits,
) -> Result<Vec<Closing>, Reason> {
    searched(equation, usize::MAX, known, limits)
}

/// As many closings as are wanted, by amplitude, from the search outside of the `known` intervals.
fn searched(
    equation: &mut Equation,
    most: usize,
    known: &[(f64, f64)],
    limits: &Limits,
) -> Result<Vec<Closing>, Reason> {
    /// A search takes some tens of thousands of evaluations; where it takes this many on one half map,
    /// the flow is too stiff for it.
    const BUDGET: u64 = 40_000_000;
    let budget = limits.evaluations.min(BUDGET);
    let limits = &Limits { evaluations: budget, interrupted: limits.interrupted };
    if is_one_way(&equation.parameters) {
        return Ok(Vec::new());
    }
    let Some(low) = lower_end(equation, limits)? else { return Ok(Vec::new()) };
    let brackets = brackets(equation, low, most, known, limits)?;
    equation.want_fastest(true);
    let mut found = Vec::new();
    for bracket in brackets {
        let closing = polish(equation, bracket, limits)?;
        // Where the second swing would have to start at the very end of the sticking set, nothing closes.
        if closing.duration.is_finite() && found.len() < most {
            if !closing.log_multiplier(&equation.parameters).is_finite() {
                return Err(Reason::OutOfRange);
            }
            found.push(closing);
        }
    }
    Ok(found)
}

/// Where the search begins, or `None` where no swing passes the sticking set.
fn lower_end(equation: &mut Equation, limits: &Limits) -> Result<Option<f64>, Reason> {
    /// Without friction the linear terms alone decide about amplitudes this much below balance.
    const SMALL: f64 = 1e-4;
    /// A step down in the logarithm that no rounding bridges.
    const CLEARLY: f64 = 0.125;
    let Parameters { d, d2, d3, r } = equation.parameters;
    let smallest = equation.smallest_clearance(limits)?;
    let mut rim = f64::NEG_INFINITY;
    if d <= -1.0 && r > 0.0 {
        let Some(bound) = equation.rim(limits)? else { return Ok(None) };
        rim = bound;
    }
    Ok(smallest.map(|smallest| {
        if rim > smallest.log {
            rim - CLEARLY
        } else if smallest.log.is_finite() {
            // A cycle of large multiplier lies within rounding of it: begin clearly below.
            smallest.log - CLEARLY
        } else if r > 0.0 {
            // Beyond critical damping a swing passes from any clearance, however small.
            (SMALL * f64::EPSILON * r).ln()
        } else {
            let natural = (1.0 / d2.abs()).min(1.0 / d3.abs().sqrt());
            (SMALL * d.abs().sqrt().min(1.0) * natural).ln()
        }
    }))
}

/// Where the search ends if no escape ends it before.
fn upper_end(parameters: &Parameters) -> f64 {
    let Parameters { d, d2, d3, r } = *parameters;
    if d3 != 0.0 {
        f64::INFINITY
    } else if d2 != 0.0 {
        // A swing from far out forgets where it began as exp(-2 D2 c): beyond this all are one.
        (60.0 / d2.abs() + 2.0 * r).ln()
    } else {
        // The piecewise linear cycle is near 2 r/(pi abs(D)).
        (2.0 * r / d.abs()).ln() + 3.0
    }
}

/// Marches outwards in `ln c0` until the end of the domain, leaving out the `known` intervals, and collects
/// brackets of roots until there are as many as are wanted.
fn brackets(
    equation: &mut Equation,
    low: f64,
    most: usize,
    known: &[(f64, f64)],
    limits: &Limits,
) -> Result<Vec<Bracket>, Reason> {
    /// Tolerance of the steps of the search where the polish needs no coarser ones, and the blur of a
    /// residual that comes of it, in units of the tolerance; weak damping makes residuals that small and
    /// needs the steps of the polish from the beginning.
    const ROUGH: f64 = 1e-10;
    const BLUR: f64 = 1e3;
    const WEAK: f64 = 0.01;
    /// First stride and longest stride, in `ln c0`.
    const STRIDES: (f64, f64) = (0.5, 2.0);
    let high = upper_end(&equation.parameters);
    let parameters = equation.parameters;
    let fine = equation.tolerance();
    let rough = fine.max(ROUGH);
    let (step, blur) = if parameters.d.abs() < WEAK { (fine, 0.0) } else { (rough, BLUR * rough) };
    let mut rough = equation.again(step);
    let mut function = |u: f64, fine: bool| {
        let equation = if fine { &mut *equation } else { &mut rough };
        Ok(equation.at(Route::Mixed, u, limits)?.node)
    };
    let mut found = Vec::new();
    // Where the next unknown interval begins, at or beyond a place.
    let unknown = |mut at: f64| {
        while let Some(&(_, to)) = known.iter().find(|(from, to)| *from <= at && at < *to) {
            at = to;
        }
        at
    };
    let (mut here, mut stride) = (function(unknown(low), false)?, STRIDES.0);
    while here.at < high {
        let ahead = known.iter().map(|(from, _)| *from).filter(|from| *from > here.at);
        let next = function(ahead.fold((here.at + stride).min(high), f64::min), false)?;
        search(here, next, blur, &mut function, &mut found)?;
        let beyond = unknown(next.at);
        here = if beyond > next.at { function(beyond, false)? } else { next };
        // A swing that never starts out, or never ends, is no end of the domain: from further out it may.
        let escapes = here.rise == f64::INFINITY || here.fall == f64::INFINITY;
        // One of them may turn out to be no cycle.
        if found.len() > most || (found.len() == most && parameters.d > -1.0) || escapes {
            break;
        }
        stride = (1.5 * stride).min(STRIDES.1);
    }
    equation.charge(rough.cost());
    Ok(found)
}

/// The bracket of the innermost closing, without any use of closed forms or of the parameters' D2: it serves an
/// equation whose damping differs by side.
///
/// # Errors
/// The [`Reason`] why a swing failed.
pub(super) fn innermost_bracket(
    equation: &mut Equation,
    limits: &Limits,
) -> Result<Option<Bracket>, Reason> {
    let Some(low) = lower_end(equation, limits)? else { return Ok(None) };
    Ok(brackets(equation, low, 1, &[], limits)?.into_iter().next())
}

/// Newton's method on the contracting route, inside the bracket.
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn polish(
    equation: &mut Equation,
    bracket: Bracket,
    limits: &Limits,
) -> Result<Closing, Reason> {
    let rising = bracket.1.value() > bracket.0.value();
    let (mut low, mut high) = (bracket.0.at, bracket.1.at);
    let mut route = beyond_the_end(&bracket);
    let mut switched = false;
    let mut u = secant(&bracket);
    let mut change = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let closing = equation.at(route, u, limits)?;
        let mut node = closing.node;
        let contracting = Route::contracting(closing.log_multiplier(&equation.parameters));
        // Beyond the domain of one swing a route that runs it the other way has a value.
        if !node.value().is_finite() && !switched {
            if route == Route::Mixed {
                let first = node.rise == f64::INFINITY;
                route = if first { Route::Backward } else { Route::Forward };
                switched = true;
                continue;
            }
            route = Route::Mixed;
        }
        // Where two routes contract alike each may say that the other is better: move on regardless.
        if node.value().is_finite() && contracting != route && !switched {
            (route, switched) = (contracting, true);
            continue;
        }
        switched = false;
        let ends = closing.duration.is_finite();
        let flat = route == Route::Mixed && node.slope.abs() < FLAT;
        if flat
            && ends
            && let Some(weighed) = weighed_residual(equation, u, limits)?
        {
            node = Node { rise: weighed, fall: 0.0, ..node };
        }
        if (node.value() > 0.0) == rising {
            high = u;
        } else {
            low = u;
        }
        let newton = u - node.value() / node.slope;
        let last = std::mem::replace(&mut change, (newton - u).abs());
        // Rounding moves the root by an ulp, divided by the slope where the residual is a plain
        // difference. A weighed one does better: it goes on while it does.
        let rounding = 4.0 * f64::EPSILON * u.abs().max(1.0);
        let blurred = change.is_finite() && change <= rounding / node.slope.abs().min(1.0);
        // Where rounding of the swings is larger than that, Newton's method stops making progress.
        let stalled = change >= 0.5 * last && change <= 16.0 * rounding;
        let settled = change <= rounding || stalled || (blurred && (!flat || change >= 0.5 * last));
        if settled && node.value().is_finite() {
            return Ok(closing);
        }
        if high - low <= f64::EPSILON * u.abs() {
            return closest(equation, u, limits);
        }
        u = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
    }
    Err(Reason::NoConvergence { sought: "a limit cycle", change })
}

/// The route to begin with: where one swing has no end on one side of the bracket, the one that runs it the
/// other way, and contracts there.
fn beyond_the_end((low, high): &Bracket) -> Route {
    if low.rise == f64::INFINITY || high.rise == f64::INFINITY {
        Route::Backward
    } else if low.fall == f64::INFINITY || high.fall == f64::INFINITY {
        Route::Forward
    } else {
        Route::Mixed
    }
}

/// The closing at an unknown known to rounding, by the route on which it closes best.
///
/// A swing that magnifies rounding beyond its own size, such as one along the border of escape, is of no
/// use forward: backward it contracts.
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`] where no route closes.
fn closest(equation: &mut Equation, u: f64, limits: &Limits) -> Result<Closing, Reason> {
    /// Residual, relative to the clearance, that is rounding seen through a steep map.
    const CLOSED: f64 = 1e-6;
    let mut best: Option<Closing> = None;
    for route in [Route::Mixed, Route::Backward, Route::Forward] {
        let closing = equation.at(route, u, limits)?;
        let residual = |closing: &Closing| closing.node.value().abs();
        if residual(&closing) < best.as_ref().map_or(f64::INFINITY, residual) {
            best = Some(closing);
        }
    }
    let change = best.as_ref().map_or(f64::INFINITY, |best| best.node.value().abs());
    best.filter(|_| change <= CLOSED)
        .ok_or(Reason::NoConvergence { sought: "a limit cycle", change })
}

/// Where the line through both ends of a bracket vanishes; its middle where an end is infinite.
fn secant((low, high): &Bracket) -> f64 {
    let middle = 0.5 * (low.at + high.at);
    let secant = low.at - low.value() * (high.at - low.at) / (high.value() - low.value());
    if secant > low.at && secant < high.at { secant } else { middle }
}
