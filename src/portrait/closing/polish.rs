//! A closed pair of half swings, from a bracket to rounding.
//!
//! Newton's method in the logarithm of the clearance, along the route that contracts; weighed as energy
//! ([`super::balance`]) where the multiplier is close to 1, and in twice the working precision
//! ([`Equation::precisely_at`]) where doubles leave too few digits.

use super::{
    Bracket, Equation, FINER, Length, Node, Route, SwingPair, Weighed, places, weighed_closing,
};
use crate::flow::{Reason, Result};
use crate::numerics::{Twofold, exp_m1};

/// Slope of the residual below which it is weighed as energy.
const FLAT: f64 = 0.3;

/// Relative error of a clearance above which it is computed to more digits.
const SHARP: f64 = 1e-8;

/// Relative error of a clearance above which it is not an answer.
pub(crate) const VAGUE: f64 = 1e-3;

/// Newton steps without progress, all within the error bound of the residual, that are enough.
const STALLS: u8 = 4;

/// Whether rounding is what limits an equation, so that weighing works and more digits help.
pub(crate) fn is_exact(equation: &Equation) -> bool {
    equation.tolerance() <= 4.0 * f64::EPSILON && equation.is_of_one_motion()
}

/// The closing in a bracket, to rounding where doubles allow it, else in twice the working precision. Fails with
/// the [`Reason`] why a swing failed, or [`Reason::NoConvergence`].
pub fn polish(equation: &mut Equation, bracket: Bracket) -> Result<SwingPair> {
    let start = near_root(equation, &bracket)?;
    polish_from(equation, start, bracket, SHARP)
}

/// A place to begin with, and whether the residual is so flat there that it is weighed as energy.
type Guess = (f64, bool);

/// The same by Newton's method from `start`, to more digits only where doubles leave a larger relative error than
/// `sharp`.
fn polish_from(
    equation: &mut Equation,
    start: Guess,
    bracket: Bracket,
    sharp: f64,
) -> Result<SwingPair> {
    let rough = newton(equation, start, bracket)?;
    let worst = rough.spread().iter().fold(rough.uncertainty, |worst, it| worst.max(it.length));
    if worst <= sharp || !is_exact(equation) {
        return Ok(rough);
    }
    Ok(sharpen(equation, &rough, bracket)?.unwrap_or(rough))
}

/// The closing next to `u`, known to have a multiplier near this one, by [`polish`]; `None` where doubles and thirty
/// digits leave it vague. More digits than doubles have are asked for a relative error of `sharp` only.
pub fn polish_near(
    equation: &mut Equation,
    u: f64,
    log_multiplier: f64,
    sharp: f64,
) -> Result<Option<SwingPair>> {
    /// How far in `ln c0` the guess may be off: where another cycle may be near, and where none is.
    const WIDTHS: (f64, f64) = (0.05, 0.5);
    let width = if log_multiplier.abs() < 1.0 {
        WIDTHS.0
    } else {
        WIDTHS.1
    };
    let sign = log_multiplier.signum();
    let end = |side| Node::new(u + side * width, sign * side * width, 0.0, sign);
    equation.want_fastest();
    let start = (u, log_multiplier.abs() < FLAT);
    let closing = polish_from(equation, start, (end(-1.0), end(1.0)), sharp)?;
    let moved = (closing.node.at - u).abs();
    Ok(Some(closing)
        .filter(|it| it.uncertainty <= VAGUE && moved < 0.9 * width && it.duration.is_finite()))
}

/// Newton's method on the contracting route, inside the bracket.
fn newton(equation: &mut Equation, start: Guess, bracket: Bracket) -> Result<SwingPair> {
    /// How far off coarse steps may put a cliff of the residual, such as the edge of an escape, and its slope.
    const SLACK: f64 = 1e-6;
    const STEEP: f64 = 1e3;
    /// The method takes about five evaluations, and halving to rounding about sixty.
    const EVALUATIONS: usize = 200;
    let mut ends = places(&bracket);
    if (bracket.1.value - bracket.0.value).abs() > STEEP * (ends.high - ends.low) {
        (ends.low, ends.high) = (ends.low - SLACK, ends.high + SLACK);
    }
    let route = beyond_the_end(&[bracket.0, bracket.1]);
    let mut steps = Steps { equation, route, weigh: start.1 };
    let (mut u, mut change, mut stalls) = (start.0, f64::INFINITY, 0);
    for _ in 0..EVALUATIONS {
        let (closing, value, flat) = steps.at(u)?;
        let slope = closing.node.slope;
        let last = std::mem::replace(&mut change, (u - value / slope - u).abs());
        // Rounding moves the root by an ulp, divided by the slope where the residual is a plain
        // difference. A weighed one does better: it continues while it does.
        let rounding = 4.0 * f64::EPSILON * u.abs().max(1.0);
        let blurred = change.is_finite() && change <= rounding / slope.abs().min(1.0);
        // Where rounding of the swings is larger than that, Newton's method stops making progress.
        let idle = change >= 0.5 * last;
        stalls += u8::from(idle && change <= closing.noise / slope.abs());
        let stalled = (idle && change <= 16.0 * rounding) || stalls >= STALLS;
        let settled = change <= rounding || stalled || (blurred && (!flat || idle));
        if settled && value.is_finite() {
            return Ok(closing);
        }
        let Some(next) = ends.step(u, value, slope) else { break };
        u = next;
    }
    if ends.high - ends.low > 2.0 * f64::EPSILON * u.abs() {
        return Err(Reason::NoConvergence { sought: "a limit cycle", change });
    }
    closest(equation, u)
}

/// How Newton's method computes closings.
struct Steps<'a, 'l> {
    equation: &'a mut Equation<'l>,
    route: Route,
    /// Whether the residual is to be weighed as energy next time.
    weigh: bool,
}

impl Steps<'_, '_> {
    /// The closing at `u`, its residual as well as it is known, and whether that is flat there.
    fn at(&mut self, u: f64) -> Result<(SwingPair, f64, bool)> {
        let (mut closing, mut energy) = self.closing(u)?;
        let flat = self.route == Route::Mixed && closing.node.slope.abs() < FLAT;
        self.weigh = flat && closing.duration.is_finite();
        if self.weigh && energy.is_none() {
            energy = weighed_closing(self.equation, u)?.map(|(_, energy)| energy);
        }
        // The closing keeps the plain residual.
        let Some((weighed, noise)) = energy.filter(|_| self.weigh) else {
            return Ok((closing, closing.node.value, flat));
        };
        closing.uncertainty = (weighed.abs() + noise) / closing.node.slope.abs();
        Ok((closing, weighed, flat))
    }

    /// The closing at `u` along the route that contracts, and what it is weighed as.
    fn closing(&mut self, u: f64) -> Result<(SwingPair, Option<Weighed>)> {
        let found = self.along_route(u)?;
        let (route, node) = (self.route, found.0.node);
        let finite = node.value.is_finite();
        self.route = if finite {
            Route::steadiest(found.0.growth)
        } else if route != Route::Mixed {
            Route::Mixed
        } else {
            beyond_the_end(&[node])
        };
        // Where two routes contract alike each may say that the other is better: only one of them is tried.
        let again = self.route != route && (finite || route == Route::Mixed);
        if again { self.along_route(u) } else { Ok(found) }
    }

    /// The closing at `u` along the route at hand, weighed if it is to be.
    fn along_route(&mut self, u: f64) -> Result<(SwingPair, Option<Weighed>)> {
        let weighs = self.weigh && self.route == Route::Mixed;
        match if weighs {
            weighed_closing(self.equation, u)?
        } else {
            None
        } {
            Some((closing, energy)) => Ok((closing, Some(energy))),
            None => Ok((self.equation.at(self.route, u)?, None)),
        }
    }
}

/// The route to begin with: where one swing has no end at one of these nodes, the one that runs it the other way, has a
/// value beyond its domain, and contracts there.
fn beyond_the_end(nodes: &[Node]) -> Route {
    if nodes.iter().any(|node| node.rise == f64::INFINITY) {
        Route::Backward
    } else if nodes.iter().any(|node| node.fall == f64::INFINITY) {
        Route::Forward
    } else {
        Route::Mixed
    }
}

/// The closing at an unknown known to rounding, by the route on which it is known best.
///
/// A swing that magnifies rounding beyond its own size, such as one along the border of escape, is of no
/// use forward: backward it contracts.
fn closest(equation: &mut Equation, u: f64) -> Result<SwingPair> {
    let worst = |it: &SwingPair| {
        if it.node.value.is_finite() {
            it.uncertainty
        } else {
            f64::INFINITY
        }
    };
    let mut best = equation.at(Route::Mixed, u)?;
    for route in [Route::Backward, Route::Forward] {
        let closing = equation.at(route, u)?;
        best = if worst(&closing) < worst(&best) {
            closing
        } else {
            best
        };
    }
    Ok(best)
}

/// The same closing in twice the working precision; `None` where that is not possible either.
///
/// Newton's method, then secants, in the bracket, along the route on which rounding grows least.
fn sharpen(
    equation: &mut Equation,
    rough: &SwingPair,
    bracket: Bracket,
) -> Result<Option<SwingPair>> {
    /// Steps, and the relative change of the last one.
    const STEPS: usize = 20;
    const SETTLED: f64 = 1e-17;
    let route = Route::steadiest(rough.growth);
    let mut slope = equation.at(route, rough.node.at)?.node.slope;
    // The unknown is the start of the rough closing times e^s.
    let start = Twofold::from(Length::from_log(rough.node.at).value);
    // The ends of the bracket were decided by doubles, which may have been too few.
    let slack = 2.0 * rough.uncertainty.min(1.0);
    let mut ends = places(&bracket);
    ends.low = (ends.low - rough.node.at).min(-slack);
    ends.high = (ends.high - rough.node.at).max(slack);
    let (mut s, mut last) = (0.0, None);
    for _ in 0..STEPS {
        let first = start + start.times(exp_m1(s));
        let found = Reason::tolerated(equation.precisely_at(route, first))?;
        let Ok(found) = found else { break };
        if let Some((before, residual)) = last.replace((s, found.residual)) {
            slope = (found.residual - residual) / (s - before);
        }
        let change = found.residual / slope;
        let settled = (s - change - s).abs() <= SETTLED;
        if let Some(next) = ends.step(s, found.residual, slope).filter(|_| !settled) {
            s = next;
            continue;
        }
        let closing = equation.from(route, Length::new(first.value()))?;
        let uncertainty = change.abs() + FINER * closing.noise / slope.abs();
        let passed = FINER * closing.errors[1][0].length;
        return Ok(Some(closing.sharpened(first.value(), &found, [uncertainty, passed])));
    }
    Ok(None)
}

/// A place near the root in a bracket, by Newton's method with integration steps that are coarser than those of the
/// equation and cost half as much.
fn near_root(equation: &mut Equation, bracket: &Bracket) -> Result<Guess> {
    /// Tolerance of the coarse steps, how many of them, and the change of the unknown that is theirs.
    const COARSE: f64 = 1e-8;
    const STEPS: usize = 3;
    const SETTLED: f64 = 1e-4;
    let (mut u, mut flat) = (secant(bracket), false);
    if !is_exact(equation) {
        return Ok((u, flat));
    }
    let (mut coarse, route) = (equation.again(COARSE), beyond_the_end(&[bracket.0, bracket.1]));
    for _ in 0..STEPS {
        let node = coarse.at(route, u)?.node;
        let change = -node.value / node.slope;
        let inside = u + change > bracket.0.at && u + change < bracket.1.at;
        if !inside {
            break;
        }
        u += change;
        flat = node.slope.abs() < FLAT;
        if change.abs() <= SETTLED {
            break;
        }
    }
    equation.charge(coarse.cost());
    Ok((u, flat))
}

/// Where the line through both ends of a bracket vanishes; its middle where an end is infinite.
fn secant(bracket: &Bracket) -> f64 {
    let (low, high) = bracket;
    let rise = (high.at - low.at) / (high.value - low.value);
    places(bracket).inside(low.at - low.value * rise)
}
