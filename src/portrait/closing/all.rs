//! All closed pairs of half swings at given parameters.
//!
//! The roots of the closing equation ([`super::equation`]) are searched for between the smallest
//! clearance that a swing past the sticking set can have and the edge of escape ([`super::search`]), then polished
//! ([`mod@super::polish`]).

use super::{
    Bracket, Direction, Equation, FINER, Length, Node, RootSearch, Route, SwingPair, VAGUE,
    has_cycle, is_exact, is_one_way, natural_size, weak_closing, weighed_closing,
};
use crate::closed_form::LinearCycle;
use crate::flow::{Reason, Result};
use crate::model::Parameters;
use crate::numerics::{Twofold, ln};
use crate::portrait::polish;

/// Tolerance of the integration steps of the search and the polish: rounding.
pub const STEP: f64 = 1e-16;

/// All closings, by amplitude, from the closed form where there is one.
pub fn all_closings(equation: &mut Equation) -> Result<Vec<SwingPair>> {
    first_closings(equation, usize::MAX)
}

/// As many of them as are wanted: finding the innermost one alone is half the work.
pub fn first_closings(equation: &mut Equation, most: usize) -> Result<Vec<SwingPair>> {
    closed_form(&equation.parameters).map_or_else(|| closings(equation, most, &[]), Ok)
}

/// All closings where there is a closed form of them.
fn closed_form(parameters: &Parameters) -> Option<Vec<SwingPair>> {
    if parameters.is_piecewise_linear() {
        return Some(SwingPair::linear(parameters).into_iter().collect());
    }
    weak_closing(parameters).map(|closing| vec![closing])
}

impl SwingPair {
    /// The cycle of the piecewise linear oscillator with this damping and friction.
    pub fn linear(parameters: &Parameters) -> Option<Self> {
        let cycle = LinearCycle::new(parameters.d, parameters.r)?;
        let clearance = Length { value: cycle.clearance, log: cycle.log_clearance };
        Some(SwingPair::in_closed_form([clearance; 2], cycle.period, 0.0, cycle.v_max))
    }
}

/// As many closings as are wanted, by amplitude, from the search outside of the `known` intervals of `ln c0`, in which
/// all are known.
pub fn closings(
    equation: &mut Equation,
    most: usize,
    known: &[(f64, f64)],
) -> Result<Vec<SwingPair>> {
    /// A search takes some tens of thousands of evaluations; where it takes this many on one half map,
    /// the flow is too stiff for it.
    const BUDGET: u64 = 40_000_000;
    equation.limits = equation.limits.up_to(BUDGET);
    let parameters = equation.parameters;
    // No swing of an overdamped linear motion comes back.
    let never_back = parameters.is_piecewise_linear() && parameters.d <= -1.0;
    if never_back || is_one_way(&parameters) {
        return Ok(Vec::new());
    }
    let sought = "a limit cycle";
    let low = lower_end(equation)?;
    equation.want_fastest();
    let brackets = match low {
        Some(low) => brackets(equation, low, most, known)?,
        None => Vec::new(),
    };
    let mut found = Vec::new();
    for bracket in brackets {
        let closing = polish(equation, bracket)?;
        // Where the second swing would have to start at the very end of the sticking set, nothing closes.
        if closing.duration.is_finite() && found.len() < most {
            let log_multiplier = closing.log_multiplier(&parameters);
            if !log_multiplier.is_finite() || loses_square(&closing, &parameters) {
                return Err(Reason::OutOfRange);
            }
            if closing.uncertainty > VAGUE && is_exact(equation) {
                return Err(Reason::NoConvergence { sought, change: closing.uncertainty });
            }
            found.push(closing);
        }
    }
    if known.is_empty() && found.is_empty() && has_cycle(&parameters) {
        return Err(Reason::OutOfRange);
    }
    // Between two cycles that both attract, or both repel, lies another one.
    let stable = |closing: &SwingPair| closing.log_multiplier(&parameters) < 0.0;
    let alternate = found.windows(2).all(|pair| stable(&pair[0]) != stable(&pair[1]));
    if known.is_empty() && !alternate {
        let change = found.iter().fold(0.0, |most, it| it.uncertainty.max(most));
        return Err(Reason::NoConvergence { sought, change });
    }
    Ok(found)
}

/// Whether cubic damping matters to the multiplier of a cycle the square of whose speed is too small a number.
fn loses_square(closing: &SwingPair, parameters: &Parameters) -> bool {
    /// Smaller ones have less than seven digits left.
    const LEAST: f64 = 1e-315;
    let Parameters { d, d3, .. } = *parameters;
    let speed = closing.fastest[0].max(closing.fastest[1]);
    closing.square < LEAST && d3.abs() * speed * speed > f64::EPSILON * d.abs()
}

/// The residual of the mixed route, with a sign that can be relied on.
///
/// Where rounding reaches it, the works are weighed; where they are not decisive either, the swings are
/// computed in twice the working precision.
fn resolved(equation: &mut Equation, u: f64) -> Result<Node> {
    /// How far beyond its error bound a residual is smooth enough to be interpolated.
    const SMOOTH: f64 = 32.0;
    let closing = equation.at(Route::Mixed, u)?;
    let node = closing.node;
    let decided = |value: f64, noise: f64| value.is_nan() || value.abs() >= SMOOTH * noise;
    let known = decided(node.value, closing.noise) || !closing.duration.is_finite();
    if known || !is_exact(equation) {
        return Ok(node);
    }
    let (mut value, mut noise) = (node.value, closing.noise);
    if let Some((weighed, bound)) = weighed_closing(equation, u)?.map(|(_, weighed)| weighed)
        && bound < noise
    {
        (value, noise) = (weighed, bound);
    }
    if !decided(value, noise) && FINER * closing.noise < noise {
        let found = equation.precisely_at(Route::Mixed, Twofold::from(closing.clearances[0].value));
        // Where it is too stiff, or out of range, doubles have to do.
        value = Reason::tolerated(found)?.map_or(value, |found| found.residual);
    }
    Ok(Node { value, ..node })
}

/// Where the search begins, or `None` where no swing passes the sticking set.
fn lower_end(equation: &mut Equation) -> Result<Option<f64>> {
    /// Without friction the linear terms alone decide about amplitudes this much below balance.
    const SMALL: f64 = 1e-4;
    /// A step down in the logarithm that no rounding bridges.
    const CLEARLY: f64 = 0.125;
    let Parameters { d, d2, d3, r } = equation.parameters;
    // The preimage of the far end of the sticking set: no cycle starts with less. It is infinite where no swing of any
    // clearance passes the set: every motion is captured.
    let mut least = equation.swing(0, Direction::Backward, Length::new(2.0 * r))?.end.log;
    if d <= -1.0 && r > 0.0 {
        least = least.max(equation.rim()?);
    }
    if least == f64::INFINITY {
        return Ok(None);
    }
    Ok(Some(if least.is_finite() {
        // A cycle of large multiplier lies within rounding of it: begin clearly below.
        least - CLEARLY
    } else if r > 0.0 {
        // Beyond critical damping a swing passes from any clearance, however small.
        ln(SMALL * f64::EPSILON * r)
    } else {
        ln(SMALL * d.abs().sqrt().min(1.0) * natural_size(d2, d3))
    }))
}

/// Where the search ends if no escape ends it before.
pub fn upper_end(parameters: &Parameters) -> f64 {
    let Parameters { d, d2, d3, r } = *parameters;
    if d3 != 0.0 {
        f64::INFINITY
    } else if d2 != 0.0 {
        // A swing from far out forgets where it began as exp(-2 D2 c): beyond this all are one.
        ln(60.0 / d2.abs() + 2.0 * r)
    } else {
        // The piecewise linear cycle is near 2 r/(pi abs(D)).
        ln(2.0 * r / d.abs()) + 3.0
    }
}

/// Marches outwards in `ln c0` until the end of the domain, leaving out the `known` intervals, and collects
/// brackets of roots until there are as many as are wanted.
fn brackets(
    equation: &mut Equation,
    low: f64,
    most: usize,
    known: &[(f64, f64)],
) -> Result<Vec<Bracket>> {
    /// Tolerance of the steps of the search where the polish needs no coarser ones, and the blur of a
    /// residual that comes of it, in units of the tolerance; weak damping makes residuals that small and
    /// needs the steps of the polish from the beginning.
    const ROUGH: f64 = 1e-8;
    const BLUR: f64 = 1e3;
    const WEAK: f64 = 0.01;
    /// Half of the shortest intervals, in `ln c0`.
    const FINEST: f64 = 1e-4;
    /// First stride and longest stride, in `ln c0`.
    const STRIDES: (f64, f64) = (0.5, 2.0);
    let parameters = equation.parameters;
    let high = upper_end(&parameters);
    let fine = equation.tolerance();
    let rough = fine.max(ROUGH);
    let (step, blur) = if parameters.d.abs() < WEAK {
        (fine, 0.0)
    } else {
        (rough, BLUR * rough)
    };
    let mut rough = equation.again(step);
    let mut function = |u: f64, fine: bool| {
        if fine {
            resolved(equation, u)
        } else {
            Ok(rough.at(Route::Mixed, u)?.node)
        }
    };
    let mut search = RootSearch { finest: FINEST, ..RootSearch::default() };
    // Where the next unknown interval begins, at or beyond a place.
    let unknown = |mut at: f64| {
        while let Some(&(_, to)) = known.iter().find(|(from, to)| *from <= at && at < *to) {
            at = to;
        }
        at
    };
    let exact = blur == 0.0;
    let (mut here, mut stride) = (function(unknown(low), exact)?, STRIDES.0);
    while here.at < high {
        let ahead = known.iter().map(|(from, _)| *from).filter(|from| *from > here.at);
        let next = function(ahead.fold((here.at + stride).min(high), f64::min), exact)?;
        search.between(here, next, blur, &mut function)?;
        let beyond = unknown(next.at);
        here = if beyond > next.at {
            function(beyond, exact)?
        } else {
            next
        };
        // A swing that never starts out, or never ends, is not an end of the domain: from further out it may.
        let escapes = here.rise == f64::INFINITY || here.fall == f64::INFINITY;
        // One of them may turn out to be no cycle.
        let enough = search.found.len() >= most.saturating_add(usize::from(parameters.d <= -1.0));
        if enough || escapes {
            break;
        }
        stride = (1.5 * stride).min(STRIDES.1);
    }
    equation.charge(rough.cost());
    Ok(search.found)
}

/// The bracket of the innermost closing, without any use of closed forms or of the parameters' D2: it serves an
/// equation whose damping differs by side.
pub(crate) fn innermost_bracket(equation: &mut Equation) -> Result<Option<Bracket>> {
    let Some(low) = lower_end(equation)? else { return Ok(None) };
    Ok(brackets(equation, low, 1, &[])?.into_iter().next())
}
