//! Every limit cycle at given parameters, described: extremes, period, multiplier, and what borders the
//! basin. The closed pairs of half swings behind them are found in [`super::closings`].

use serde::Serialize;

use super::basin::Basin;
use super::closing::{Closing, Equation, Route, share};
use super::closings::{STEP, all_closings, polish};
use super::lift::lifted;
use super::margin::Margin;
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
    /// Largest relative error of these numbers. A multiplier that under- or overflows counts by its logarithm.
    pub error: f64,
    /// The error of each.
    pub errors: CycleErrors,
}

/// Bounds on the absolute errors of the numbers of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CycleErrors {
    /// Of the left turning point.
    pub q_min: f64,
    /// Of the right turning point.
    pub q_max: f64,
    /// Of the smallest velocity.
    pub v_min: f64,
    /// Of the largest velocity.
    pub v_max: f64,
    /// Of the period.
    pub period: f64,
    /// Of the logarithm of the multiplier: a relative error of the multiplier.
    pub log_multiplier: f64,
    /// Of the logarithm of the clearance: a relative error of the clearance.
    pub log_clearance: f64,
}

impl Cycle {
    /// Whether its multiplier is far below the 1 at which two cycles meet.
    #[must_use]
    pub fn is_stable_beyond_doubt(&self) -> bool {
        /// Where two cycles meet, the logarithm vanishes to about half of the digits.
        const FAR: f64 = -1.0;
        self.log_multiplier < FAR
    }
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

/// Points drawn on each integration step of a curve.
const CURVE_POINTS: u16 = 12;

/// How far a separatrix is followed for a picture, in units of `1/abs(D2)`.
const PICTURE_REACH: f64 = 20.0;

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
    points: u16,
    limits: &Limits,
) -> Result<Cycles, Reason> {
    found(parameters, Some(points), limits)
}

fn found(parameters: &Parameters, points: Option<u16>, limits: &Limits) -> Result<Cycles, Reason> {
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

impl Picture {
    fn of(basin: &Basin, points: u16) -> Self {
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
            error: 0.0,
            errors: CycleErrors::default(),
        }
        .rounded()
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

impl Closing {
    /// The cycle that this closed pair of swings is; the first swing runs on `side`.
    #[must_use]
    pub fn describe(&self, parameters: &Parameters, side: Side) -> Cycle {
        let Parameters { d, d3, r, .. } = *parameters;
        let log_multiplier = self.log_multiplier(parameters);
        let multiplier = log_multiplier.exp();
        let spread = self.spread();
        let turning = [(self.first, spread.clearance[0]), (self.second, spread.clearance[1])];
        let fastest = [(self.fastest[0], spread.fastest[0]), (self.fastest[1], spread.fastest[1])];
        // The first swing starts on the far side of the half plane that it crosses.
        let ([left, right], [up, down]) = match side {
            Side::Upper => (turning, fastest),
            Side::Lower => ([turning[1], turning[0]], [fastest[1], fastest[0]]),
        };
        let unshared = turning.map(|(clearance, error)| error * (1.0 - share(clearance, 2.0 * r)));
        let dampings = 2.0 * d.abs() * spread.duration + 3.0 * (d3.abs() * spread.square);
        Cycle {
            stable: log_multiplier < 0.0,
            q_min: -(r + left.0.value),
            q_max: r + right.0.value,
            v_min: -down.0,
            v_max: up.0,
            period: self.duration,
            multiplier: multiplier.is_finite().then_some(multiplier),
            log_multiplier,
            clearance: right.0.value,
            log_clearance: right.0.log,
            error: 0.0,
            errors: CycleErrors {
                q_min: left.1 * left.0.value,
                q_max: right.1 * right.0.value,
                v_min: down.1,
                v_max: up.1,
                period: spread.duration,
                log_multiplier: unshared[0]
                    + unshared[1]
                    + dampings
                    + f64::EPSILON * self.log_terms(parameters),
                log_clearance: right.1,
            },
        }
        .rounded()
    }
}

impl Cycle {
    /// With the rounding of each number itself added to its error, and the largest relative error.
    fn rounded(mut self) -> Self {
        let rounded = |value: f64| 2.0 * f64::EPSILON * value.abs();
        let errors = &mut self.errors;
        let lengths = [
            (&mut errors.q_min, self.q_min),
            (&mut errors.q_max, self.q_max),
            (&mut errors.v_min, self.v_min),
            (&mut errors.v_max, self.v_max),
            (&mut errors.period, self.period),
        ];
        let mut largest = 0.0_f64;
        for (error, value) in lengths {
            *error += rounded(value);
            largest = largest.max(*error / value.abs());
        }
        errors.log_multiplier += rounded(self.log_multiplier);
        errors.log_clearance += rounded(self.log_clearance.abs().max(1.0));
        let multiplier = match self.multiplier {
            Some(multiplier) if multiplier.is_normal() => errors.log_multiplier.exp_m1(),
            _ => errors.log_multiplier / self.log_multiplier.abs(),
        };
        self.error = largest.max(errors.log_clearance).max(multiplier);
        self
    }
}
