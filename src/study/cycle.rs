//! Every limit cycle at given parameters.
//!
//! The roots of the closing equation ([`super::closing`]) are searched for between the smallest
//! clearance that a swing past the sticking set can have and the edge of escape ([`super::search`]),
//! then polished by Newton's method in the logarithm of the clearance along the route that contracts,
//! and weighed as energy ([`super::balance`]) where the multiplier is close to 1.

use serde::Serialize;

use super::balance::weighed_residual;
use super::basin::Basin;
use super::closing::{Closing, Equation, Route};
use super::half_map::Length;
use super::lift::lifted;
use super::margin::Margin;
use super::search::{Bracket, Node, search};
use super::works::works as works_over;
use crate::closed_form::harmonic::{Harmonic, amplitudes};
use crate::closed_form::piecewise_linear::LinearCycle;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{Ledger, Parameters, Side, State};

/// A limit cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cycle {
    /// Whether it attracts.
    pub stable: bool,
    /// Left turning point.
    pub q_min: f64,
    /// Right turning point.
    pub q_max: f64,
    /// Smallest velocity.
    pub v_min: f64,
    /// Largest velocity.
    pub v_max: f64,
    /// Period.
    pub period: f64,
    /// Floquet multiplier; `None` where it overflows.
    pub multiplier: Option<f64>,
    /// Natural logarithm of the multiplier.
    pub log_multiplier: f64,
    /// `q_max - r`, to full relative precision; 0 where it underflows.
    pub clearance: f64,
    /// Natural logarithm of the clearance.
    pub log_clearance: f64,
    /// Estimated relative error of the clearance.
    pub error: f64,
}

/// What borders the basin of attraction of the sticking set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// Nothing: every motion is captured.
    None,
    /// An unstable limit cycle.
    Cycle,
    /// A motion that separates capture from escape.
    Separatrix,
}

/// What a picture of the basin shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The closed curve of each cycle.
    pub curves: Vec<Vec<State>>,
    /// What each source does over one turn of each cycle.
    pub works: Vec<Ledger>,
    /// The edge of the basin: a closed curve, or the separatrix as far as it was followed; else empty.
    pub edge: Vec<State>,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Radius of Lyapunov's disk (24) as a part of the margin; above 1 it promises too much, because it
    /// leaves out D2 and D3.
    pub lyapunov_share: Option<f64>,
}

/// All limit cycles, by amplitude, and what they imply for the basin.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycles {
    /// The parameters.
    pub parameters: Parameters,
    /// The cycles, smallest first.
    pub cycles: Vec<Cycle>,
    /// The first-order harmonic answer, for comparison.
    pub harmonic: Vec<Harmonic>,
    /// What borders the basin of the sticking set.
    pub edge: Edge,
    /// Curves and margins, if asked for.
    pub picture: Option<Picture>,
    /// What it cost.
    pub cost: Cost,
}

/// Tolerance of the integration steps of the search and the polish: rounding.
pub(super) const STEP: f64 = 1e-16;

/// Points drawn on each integration step of a curve.
const CURVE_POINTS: u8 = 12;

/// How far a separatrix is followed for a picture, in units of `1/abs(D2)`.
const PICTURE_REACH: f64 = 20.0;

/// Slope of the residual below which it is weighed as energy.
const FLAT: f64 = 0.3;

/// Newton steps before giving up; bisection alone needs 60.
const ITERATIONS: usize = 200;

/// Finds all limit cycles at these parameters; `curves` asks for a picture too.
///
/// The piecewise linear cycle comes from its closed form, all others from the search. Clearances are
/// computed to rounding; `error` of each cycle says what that is worth near a fold.
///
/// # Errors
/// The [`Reason`] why the search could not be completed.
pub fn cycles(parameters: &Parameters, curves: bool, limits: &Limits) -> Result<Cycles, Reason> {
    found(parameters, curves.then_some(CURVE_POINTS), limits)
}

/// The same with a picture, of so many points on each integration step of a curve.
///
/// # Errors
/// The [`Reason`] why the search could not be completed.
pub fn cycles_drawn(
    parameters: &Parameters,
    points: u8,
    limits: &Limits,
) -> Result<Cycles, Reason> {
    found(parameters, Some(points), limits)
}

fn found(parameters: &Parameters, points: Option<u8>, limits: &Limits) -> Result<Cycles, Reason> {
    if let Some((lifted, unit)) = lifted(parameters) {
        return Ok(found(&lifted, points, limits)?.times_power(-unit));
    }
    let mut equation = Equation::new(parameters, STEP);
    let closings = all_closings(&mut equation, limits)?;
    let describe = |closing: &Closing| closing.describe(parameters, equation.side);
    let stable: Vec<bool> =
        closings.iter().map(|closing| closing.log_multiplier(parameters) < 0.0).collect();
    let mut answer = Cycles {
        parameters: *parameters,
        cycles: closings.iter().map(describe).collect(),
        harmonic: amplitudes(parameters),
        edge: Edge::around(parameters, &stable),
        picture: None,
        cost: equation.cost(),
    };
    if let Some(points) = points {
        let reach = PICTURE_REACH / parameters.d2.abs().max(f64::MIN_POSITIVE);
        let basin = Basin::around(parameters, &closings, reach, limits)?;
        answer.cost += basin.cost;
        answer.picture = Some(Picture::of(&basin, points));
    }
    Ok(answer)
}

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
    searched(equation, most, &[], limits)
}

impl From<&LinearCycle> for Closing {
    fn from(cycle: &LinearCycle) -> Self {
        let clearance = Length { value: cycle.clearance, log: cycle.log_clearance };
        Closing::symmetric(clearance, cycle.period, cycle.v_max)
    }
}

impl Picture {
    fn of(basin: &Basin, points: u8) -> Self {
        let mut curves: Vec<Vec<State>> =
            basin.borders.iter().map(|border| border.curve(points)).collect();
        let works = basin.borders.iter().skip(usize::from(basin.edge == Edge::Separatrix));
        let works = works.filter_map(|border| works_over(border, &basin.parameters)).collect();
        let edge = match basin.edge {
            Edge::None => Vec::new(),
            Edge::Cycle => curves.first().cloned().unwrap_or_default(),
            Edge::Separatrix => curves.remove(0),
        };
        Picture {
            curves,
            works,
            edge,
            margin: basin.margin(),
            area: basin.area(),
            lyapunov_share: basin.lyapunov_share(),
        }
    }
}

impl From<&LinearCycle> for Cycle {
    /// The cycle of the piecewise linear oscillator, in closed form.
    fn from(cycle: &LinearCycle) -> Self {
        Cycle {
            stable: false,
            q_min: -cycle.q_max,
            q_max: cycle.q_max,
            v_min: -cycle.v_max,
            v_max: cycle.v_max,
            period: cycle.period,
            multiplier: cycle.multiplier,
            log_multiplier: cycle.log_multiplier,
            clearance: cycle.clearance,
            log_clearance: cycle.log_clearance,
            error: 4.0 * f64::EPSILON,
        }
    }
}

impl Edge {
    /// What borders the basin: the innermost cycle, else a separatrix where motions can escape.
    #[must_use]
    pub fn around(parameters: &Parameters, stable: &[bool]) -> Self {
        let self_excited_node = parameters.d <= -1.0 && parameters.r > 0.0;
        // Without friction a rest that repels has no basin, and nothing borders it.
        let repels = parameters.r == 0.0 && parameters.d < 0.0;
        let escapes = parameters.d3 == 0.0 && parameters.d2 != 0.0 && !repels;
        // Positive cubic damping bounds every motion: where no cycle is left for it, it comes to rest.
        let bounded = parameters.d3 > 0.0;
        match stable.first() {
            Some(false) => Edge::Cycle,
            Some(true) if !self_excited_node => Edge::None,
            None if bounded || !(escapes || self_excited_node) => Edge::None,
            _ => Edge::Separatrix,
        }
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
    let Parameters { d, d3, r, .. } = equation.parameters;
    // The first integral of D2 decreases along every motion (`K` of [`super::balance`]), or increases.
    if d >= 0.0 && d3 >= 0.0 || r == 0.0 && d <= 0.0 && d3 <= 0.0 {
        return Ok(Vec::new());
    }
    let Some(low) = lower_end(equation, limits)? else { return Ok(Vec::new()) };
    let brackets = brackets(equation, low, most, known, limits)?;
    equation.want_fastest(true);
    brackets.into_iter().take(most).map(|bracket| polish(equation, bracket, limits)).collect()
}

/// Where the search begins, or `None` where no swing passes the sticking set.
fn lower_end(equation: &mut Equation, limits: &Limits) -> Result<Option<f64>, Reason> {
    /// Without friction the linear terms alone decide about amplitudes this much below balance.
    const SMALL: f64 = 1e-4;
    /// A step down in the logarithm that no rounding bridges.
    const CLEARLY: f64 = 0.125;
    let Parameters { d, d2, d3, r } = equation.parameters;
    let smallest = equation.smallest_clearance(limits)?;
    Ok(smallest.map(|smallest| {
        if smallest.log.is_finite() {
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
    /// Tolerance of the steps of the search, and the blur of a residual that comes of it; weak damping
    /// makes residuals that small and needs steps to rounding from the beginning.
    const ROUGH: (f64, f64) = (1e-10, 1e-7);
    const WEAK: f64 = 0.01;
    /// First stride and longest stride, in `ln c0`.
    const STRIDES: (f64, f64) = (0.5, 2.0);
    let high = upper_end(&equation.parameters);
    let (parameters, side) = (equation.parameters, equation.side);
    let (step, blur) = if parameters.d.abs() < WEAK { (STEP, 0.0) } else { ROUGH };
    let mut rough = Equation::on_side(&parameters, side, step);
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
        if found.len() >= most || escapes {
            break;
        }
        stride = (1.5 * stride).min(STRIDES.1);
    }
    equation.charge(rough.cost());
    Ok(found)
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
    let mut route = Route::Mixed;
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
        let flat = route == Route::Mixed && node.slope.abs() < FLAT;
        if flat && let Some(weighed) = weighed_residual(equation, u, limits)? {
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
        let blurred = change <= rounding / node.slope.abs().min(1.0);
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

/// The cycle with its right turning point near `q_max`, without a search for others; `None` where no
/// cycle is that near.
///
/// # Errors
/// The [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn cycle_near(
    parameters: &Parameters,
    q_max: f64,
    limits: &Limits,
) -> Result<Option<Cycle>, Reason> {
    /// How near, in the logarithm of the clearance.
    const NEAR: f64 = 0.05;
    let mut equation = Equation::new(parameters, STEP);
    let Some(first) = equation.first_clearance(q_max, limits)? else { return Ok(None) };
    let mut node = |u: f64| equation.at(Route::Mixed, u, limits).map(|closing| closing.node);
    let bracket = (node(first.log - NEAR)?, node(first.log + NEAR)?);
    if (bracket.0.value() > 0.0) == (bracket.1.value() > 0.0) {
        return Ok(None);
    }
    equation.want_fastest(true);
    let closing = polish(&mut equation, bracket, limits)?;
    Ok(Some(closing.describe(parameters, equation.side)))
}

/// Where the line through both ends of a bracket vanishes; its middle where an end is infinite.
fn secant((low, high): &Bracket) -> f64 {
    let middle = 0.5 * (low.at + high.at);
    let secant = low.at - low.value() * (high.at - low.at) / (high.value() - low.value());
    if secant > low.at && secant < high.at { secant } else { middle }
}

impl Closing {
    /// The cycle that this closed pair of swings is; the first swing runs on `side`.
    #[must_use]
    pub fn describe(&self, parameters: &Parameters, side: Side) -> Cycle {
        let r = parameters.r;
        let log_multiplier = self.log_multiplier(parameters);
        let multiplier = log_multiplier.exp();
        let slope = self.node.slope.abs();
        let turning = [self.first, self.second];
        // The first swing starts on the far side of the half plane that it crosses.
        let ([left, right], [up, down]) = match side {
            Side::Upper => (turning, self.fastest),
            Side::Lower => ([turning[1], turning[0]], [self.fastest[1], self.fastest[0]]),
        };
        Cycle {
            stable: log_multiplier < 0.0,
            q_min: -(r + left.value),
            q_max: r + right.value,
            v_min: -down,
            v_max: up,
            period: self.duration,
            multiplier: multiplier.is_finite().then_some(multiplier),
            log_multiplier,
            clearance: right.value,
            log_clearance: right.log,
            // Near critical damping the time next to the centre depends on the last digits of the state.
            error: 8.0 * f64::EPSILON
                / (slope.min(1.0) * (1.0 - parameters.d.abs()).abs().min(1.0)),
        }
    }
}
