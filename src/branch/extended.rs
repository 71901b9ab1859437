//! A fold as a root of two equations in two unknowns: the extended system.
//!
//! Where two cycles meet, the residual `F` of the closing equation vanishes, and with it the logarithm `G` of what a
//! turn makes of an error. Both are smooth in `u = ln c0` and in the logarithm of a parameter, in which folds lie on
//! nearly straight lines (`D_F` is almost a power of `r^2 D3`). Newton's method, with coarse integration steps first:
//! the slope of F in u is exact everywhere, the other derivatives are those of a fold nearby or difference quotients,
//! and are renewed on the way.
//!
//! Guarantee: what is found is a root of both, and the inner one of the two cycles is unstable. That there is no
//! other one is the argument of [`super::regime`].

use nalgebra::{Matrix2, Vector2};

use crate::branch::escape::leading_escape;
use crate::closed_form::harmonic;
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters};
use crate::numerics::{cbrt, exp, ln, powi};
use crate::portrait::{Equation, Route, SwingPair};

/// A fold: the cycle at which two meet.
pub struct FoldCycle {
    /// Where it is.
    pub place: FoldPlace,
    /// The cycle.
    pub closing: SwingPair,
}

/// A place at a fold, or near one.
#[derive(Clone, Copy)]
pub struct FoldPlace {
    pub parameters: Parameters,
    /// The unknown `ln c0`.
    pub u: f64,
    /// Along which parameter slopes are known, and the derivatives of F and G by u and by the logarithm of it.
    pub slopes: Option<(Knob, Slopes)>,
}

/// The derivatives of both functions by u and by the logarithm of a parameter.
pub type Slopes = Matrix2<f64>;

impl FoldPlace {
    /// The fold in D at these values of D2, D3 and r; `None` where there is none, or D2 bends the cycle too much.
    pub fn in_damping(parameters: &Parameters) -> Option<Self> {
        /// Largest product of D2 and the amplitude at which the estimate is any good.
        const BENT: f64 = 3.5;
        let FoldEstimate { d, u, bend } = FoldEstimate::of(parameters)?;
        let parameters = Parameters { d, ..*parameters };
        (bend <= BENT).then_some(FoldPlace { parameters, u, slopes: None })
    }

    /// The same beside a fold that is known: as far from the estimate as this one is.
    pub fn beside(known: &FoldPlace, parameters: &Parameters) -> Option<Self> {
        let (here, there) = (FoldEstimate::of(parameters)?, FoldEstimate::of(&known.parameters)?);
        let d = here.d * (known.parameters.d / there.d);
        let (parameters, u) = (Parameters { d, ..*parameters }, known.u + here.u - there.u);
        Some(FoldPlace { parameters, u, slopes: known.slopes })
    }
}

/// An estimate of a fold.
///
/// The harmonic fold (48, 49), with the leading order of the escape point, to which it tends for weak D3, and
/// turning points to second order in D2. The rest was fitted to a few per cent of computed folds: an estimate decides
/// how long the search takes, and nothing else.
struct FoldEstimate {
    d: f64,
    u: f64,
    /// D2 times the amplitude.
    bend: f64,
}

impl FoldEstimate {
    fn of(parameters: &Parameters) -> Option<Self> {
        let Parameters { d2, d3, r, .. } = *parameters;
        let harmonic = harmonic::fold(d3, r)?;
        // In units of the friction.
        let (amplitude, d2, d3) = (harmonic.amplitude / r, r * d2.abs(), r * r * d3);
        let bend = d2 * amplitude;
        let symmetric = (amplitude - 0.98 + 0.09 * d3).max(2e-3);
        let clearance = symmetric + 2.0 / 3.0 * amplitude * bend * (1.0 + 0.6 * bend);
        let farthest = 14.0 / d2;
        let d = cbrt(powi(leading_escape(d2, 1.0), 3) + powi(harmonic.d, 3));
        Some(FoldEstimate { d, u: ln(r * clearance.min(farthest)), bend })
    }
}

/// Finds the fold next to a guess while `symbol` varies, to a relative error of `tolerance` of its clearance, and its
/// square of the parameter; `None` where Newton's method leads nowhere. Fails with [`Reason::Interrupted`].
pub fn fold_near(
    guess: &FoldPlace,
    symbol: Knob,
    tolerance: f64,
    limits: &Limits,
) -> Result<(Option<FoldCycle>, Cost)> {
    let mut system = System { guess, symbol, limits, cost: Cost::default() };
    let found = system.solve(tolerance)?;
    Ok((found, system.cost))
}

/// Both functions at a place, and the exact slope of the first in u.
#[derive(Clone, Copy)]
struct Values {
    step: f64,
    /// F and G.
    both: Vector2<f64>,
    slope: f64,
    closing: SwingPair,
}

/// The two equations. A place is a value of u and the logarithm of the parameter in units of the guess.
struct System<'a> {
    guess: &'a FoldPlace,
    symbol: Knob,
    limits: &'a Limits<'a>,
    cost: Cost,
}

impl System<'_> {
    fn parameters_at(&self, z: f64) -> Parameters {
        let guess = &self.guess.parameters;
        guess.with(self.symbol, guess.value(self.symbol) * exp(z))
    }

    /// `None` where a swing does not end, or takes too long.
    fn at(&mut self, place: Vector2<f64>, step: f64) -> Result<Option<Values>> {
        /// Evaluations of one swing, some dozens of times the usual.
        const BUDGET: u64 = 5_000;
        let [u, z] = place.into();
        let limits = Limits { evaluations: BUDGET, ..*self.limits };
        let mut equation = Equation::new(&self.parameters_at(z), step, &limits);
        equation.want_fastest();
        let closing = equation.at(Route::Mixed, u);
        self.cost += equation.cost();
        let Ok(closing) = Reason::tolerated(closing)? else { return Ok(None) };
        let both = Vector2::new(closing.node.value, closing.growth[0] + closing.growth[1]);
        let slope = closing.node.slope;
        let finite = slope.is_finite() && is_finite(both);
        Ok(finite.then_some(Values { step, both, slope, closing }))
    }

    fn solve(&mut self, tolerance: f64) -> Result<Option<FoldCycle>> {
        /// Steps before giving up.
        const STEPS: usize = 16;
        /// Tolerance of coarse integration steps, and the change for which they are too coarse.
        const COARSE: f64 = 1e-8;
        const ROUGHLY: f64 = 1e-4;
        /// Smallest changes of u and of the logarithm of the parameter that matter: an error of u counts by its square.
        const SMALL: [f64; 2] = [1e-9, 1e-13];
        /// Largest changes of both for Newton's method.
        const LONGEST: Vector2<f64> = Vector2::new(1.0, 0.4);
        /// Largest change that can be due to rounding, beside weak damping.
        const ROUNDING: f64 = 1e-7;
        let fine = 1e-2 * (tolerance * tolerance).max(1e-13);
        let mut step = fine.max(COARSE);
        let mut place = Vector2::new(self.guess.u, 0.0);
        let Some(mut here) = self.at(place, step)? else { return Ok(None) };
        let known = self.guess.slopes.filter(|(symbol, _)| *symbol == self.symbol);
        let slopes = match known {
            Some((_, slopes)) => Some(slopes),
            None => self.quotients(place, &here)?,
        };
        let Some(mut slopes) = slopes else { return Ok(None) };
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            slopes[(0, 0)] = here.slope;
            let solved = slopes.lu().solve(&-here.both);
            let Some(change) = solved.filter(|it| is_finite(*it)) else { return Ok(None) };
            let [du, dz] = change.abs().into();
            let small = du <= SMALL[0].max(tolerance) && dz <= SMALL[1].max(tolerance * tolerance);
            let length = du.max(dz);
            let stands = length <= ROUNDING && length >= 0.5 * last;
            if step == fine && (small || stands) {
                let place = FoldPlace {
                    parameters: self.parameters_at(place.y + change.y),
                    u: place.x + change.x,
                    slopes: Some((self.symbol, slopes)),
                };
                let fold = FoldCycle { place, closing: here.closing };
                // The inner one of both cycles is unstable there.
                return Ok((slopes[(1, 0)] < 0.0).then_some(fold));
            }
            last = if step == fine { length } else { f64::INFINITY };
            if length <= ROUGHLY {
                step = fine;
            }
            let change = change / change.abs().component_div(&LONGEST).max().max(1.0);
            place += change;
            let Some(next) = self.at(place, step)? else { return Ok(None) };
            learn(&mut slopes, change, (&here, &next));
            here = next;
        }
        Ok(None)
    }

    /// The derivatives as difference quotients.
    fn quotients(&mut self, place: Vector2<f64>, here: &Values) -> Result<Option<Slopes>> {
        /// Large beside the noise of coarse steps, small beside the bend of the functions.
        const STRIDE: f64 = 1e-3;
        let [aside, above] = [Vector2::x(), Vector2::y()].map(|axis| place + STRIDE * axis);
        let Some(aside) = self.at(aside, here.step)? else { return Ok(None) };
        let Some(above) = self.at(above, here.step)? else { return Ok(None) };
        let changes = [aside, above].map(|there| there.both - here.both);
        Ok(Some(Matrix2::from_columns(&changes) / STRIDE))
    }
}

fn is_finite(both: Vector2<f64>) -> bool {
    both.iter().all(|it| it.is_finite())
}

/// Learns from a step: of F what its exact slopes in u leave to the parameter, of G the least change of its slopes
/// that explains it (Broyden). Differences over too little would say more about rounding than about slopes.
fn learn(slopes: &mut Slopes, change: Vector2<f64>, (from, to): (&Values, &Values)) {
    const LEAST: [f64; 2] = [1e-5, 1e-8];
    if from.step != to.step {
        return;
    }
    let (gained, foretold) = (to.both - from.both, *slopes * change);
    if change.y.abs() >= LEAST[1] {
        let in_u = 0.5 * (from.slope + to.slope) * change.x;
        slopes[(0, 1)] = (gained.x - in_u) / change.y;
    }
    if change.x.abs() >= LEAST[0] {
        let missed = (gained.y - foretold.y) / change.norm_squared();
        let mut of_g = slopes.row_mut(1);
        of_g += missed * change.transpose();
    }
}
