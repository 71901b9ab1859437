//! Harmonic balance of N harmonics (equations 34 to 36), with the friction projected exactly.
//!
//! The paper approximates a cycle by `q = A0 + sum of a_k cos(k eta tau) + b_k sin(k eta tau)` and then
//! takes N = 1. Here N is chosen freely. [`harmonic_cycle`] begins at a first-order answer
//! ([`super::harmonic`]) and follows it: first in the *strength* of damping and friction, then in N.
//! With `D, D2, D3, r` all multiplied by a strength s, the first-order amplitude stays what it is and
//! becomes exact as `s -> 0`, so that every first-order answer is the beginning of one branch of
//! N-harmonic answers. Where that branch ends before `s = 1`, as it does between the first-order fold
//! and the fold of N harmonics, there is no answer, and this is said.
//!
//! Friction jumps where the velocity changes its sign, so that q has jumps in its second derivative and
//! its series converges slowly: the error of the amplitude falls as `1/N^2`, that of the frequency, which
//! feels the shift of the sign changes themselves, as `1/N`. Without friction both fall exponentially.
//!
//! - [`fourier`]: finite series and their products; [`mod@sign_changes`]: their roots, none missed.
//! - [`galerkin`]: the equations and their Jacobian; [`newton`]: their solution.

pub mod fourier;
pub mod galerkin;
pub mod newton;
pub mod sign_changes;

use std::f64::consts::TAU;
use std::fmt;

use nalgebra::Complex;
use serde::Serialize;

use self::fourier::{Fourier, factor};
use self::galerkin::{Ansatz, BalanceResidual, Basis};
use self::newton::{NewtonFailure, Solution, solve};
use self::sign_changes::sign_changes;
use super::harmonic::Harmonic;
use crate::model::{Parameters, State};
use crate::numerics::scaling::{exponent, times_power};

/// Maximum number of harmonics: the linear algebra costs as their cube.
pub const MOST: usize = 255;

/// A cycle as N harmonics have it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HarmonicCycle {
    /// Number N of harmonics.
    pub harmonics: usize,
    /// Whether it attracts; the branch inherits that from the first-order answer.
    pub stable: bool,
    /// Left turning point.
    pub q_min: f64,
    /// Right turning point.
    pub q_max: f64,
    /// Smallest velocity.
    pub v_min: f64,
    /// Largest velocity.
    pub v_max: f64,
    /// Mean displacement A0.
    pub mean: f64,
    /// Frequency eta.
    pub frequency: f64,
    /// `2 pi/eta`.
    pub period: f64,
    /// Instants of a turn at which `v = 0`. A cycle has two; more say that N harmonics do not describe
    /// what is there, or that nothing is there to be described.
    pub crossings: usize,
    /// The most that any Galerkin equation leaves, relative to the largest term in them.
    pub residual: f64,
    /// Displacement over the angle `eta tau`.
    #[serde(skip)]
    pub displacement: Fourier,
}

/// Why a first-order answer has no counterpart of N harmonics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "why")]
pub enum Lost {
    /// The computation was told to stop.
    Interrupted,
    /// A number left the range of floating point.
    OutOfRange,
    /// The branch that begins at the first-order answer could not be followed.
    Ends {
        /// Number of harmonics.
        harmonics: usize,
        /// Part of damping and friction up to which it was followed.
        strength: f64,
    },
}

impl fmt::Display for Lost {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Lost::Interrupted => write!(out, "interrupted"),
            Lost::OutOfRange => write!(out, "left the range of floating-point numbers"),
            Lost::Ends { harmonics, strength } => write!(
                out,
                "no cycle of {harmonics} harmonics: the first-order answer was lost at {:.0} % of the damping and friction",
                100.0 * strength
            ),
        }
    }
}

impl std::error::Error for Lost {}

/// The cycle of `count` harmonics (at least 1, at most [`MOST`]) that begins at a first-order answer.
///
/// One harmonic is the first-order answer itself. Guarantee: the Galerkin equations hold to rounding;
/// how far the cycle is from the true one is another question, which `study::harmonic_error` answers. The
/// mirrored oscillator has the mirrored cycle, to the last bit.
///
/// # Errors
/// [`Lost`] says why there is none.
pub fn harmonic_cycle(
    parameters: &Parameters,
    first: &Harmonic,
    count: usize,
    interrupted: &dyn Fn() -> bool,
) -> Result<HarmonicCycle, Lost> {
    // Where N is too small for the cycle, rounding decides between branches: only one of the mirror images is computed.
    let mirrored = parameters.d2 < 0.0;
    let (parameters, first) = if mirrored {
        (parameters.mirrored(), Harmonic { mean: -first.mean, ..*first })
    } else {
        (*parameters, *first)
    };
    let cycle = Followed::new(&parameters, &first, interrupted).cycle(count.clamp(1, MOST))?;
    Ok(if mirrored { cycle.mirrored() } else { cycle })
}

/// The branch of solutions that begins at one first-order answer, in units of a power of two that makes
/// the first-order amplitude about 1.
struct Followed<'a> {
    parameters: Parameters,
    first: Ansatz,
    stable: bool,
    /// Exponent of the unit of length.
    unit: i32,
    interrupted: &'a dyn Fn() -> bool,
}

/// Harmonics that are enough to follow a branch in the strength.
const COARSE: usize = 7;

impl<'a> Followed<'a> {
    fn new(parameters: &Parameters, first: &Harmonic, interrupted: &'a dyn Fn() -> bool) -> Self {
        let Parameters { d, d2, d3, r } = *parameters;
        let unit = exponent(first.amplitude);
        let scaled = Parameters {
            d,
            d2: times_power(d2, unit),
            d3: times_power(times_power(d3, unit), unit),
            r: times_power(r, -unit),
        };
        let mean = Complex::from(times_power(first.mean, -unit));
        let wave = Complex::from(0.5 * times_power(first.amplitude, -unit));
        let first_order = Ansatz { frequency: 1.0, q: Fourier { coefficients: vec![mean, wave] } };
        Followed { parameters: scaled, first: first_order, stable: first.stable, unit, interrupted }
    }

    fn cycle(&self, count: usize) -> Result<HarmonicCycle, Lost> {
        if count == 1 {
            let residual = BalanceResidual::new(
                &self.parameters,
                Basis::new(&self.parameters, count),
                &self.first,
            );
            return self.describe(count, &self.first, &residual);
        }
        let mut solution = match self.strengthened(count.min(COARSE)) {
            // The folds of few and of many harmonics differ a little.
            Err(Lost::Ends { .. }) if count > COARSE => self.strengthened(count)?,
            other => other?,
        };
        while solution.ansatz.q.degree() < count {
            let more = (2 * solution.ansatz.q.degree() + 1).min(count);
            solution = match self.solve(&self.parameters, more, &solution.ansatz) {
                Err(NewtonFailure::Unsettled(_)) => self.strengthened(count)?,
                Err(failure) => return Err(lost(failure, more, 1.0)),
                Ok(solution) => solution,
            };
        }
        let Solution { ansatz, residual, .. } = solution;
        self.describe(count, &ansatz, &residual)
    }

    /// Follows the branch from no damping and friction to all of it, with secants as predictors.
    fn strengthened(&self, count: usize) -> Result<Solution, Lost> {
        /// Smallest step.
        const SMALLEST: f64 = 1.0 / 256.0;
        let Parameters { d, d2, d3, r } = self.parameters;
        let (mut here, mut step) = ((0.0, self.first.clone()), 1.0);
        let mut before: Option<(f64, Ansatz)> = None;
        loop {
            let s = f64::min(here.0 + step, 1.0);
            let weaker = Parameters { d: s * d, d2: s * d2, d3: s * d3, r: s * r };
            let start = match &before {
                Some(before) => secant(before, &here, s),
                None if here.0 == 0.0 => self.first_order_at(s),
                None => here.1.clone(),
            };
            match self.solve(&weaker, count, &start) {
                Ok(solution) if s == 1.0 => return Ok(solution),
                Ok(solution) => {
                    let was = std::mem::replace(&mut here, (s, solution.ansatz));
                    before = (was.0 > 0.0).then_some(was);
                    step *= 2.0;
                }
                Err(NewtonFailure::Unsettled(_)) if step > SMALLEST => step *= 0.5,
                Err(failure) => return Err(lost(failure, count, here.0)),
            }
        }
    }

    /// The first-order answer at a strength: only its mean (equation 40) depends on it.
    fn first_order_at(&self, strength: f64) -> Ansatz {
        let mut ansatz = self.first.clone();
        ansatz.q.coefficients[0] *= strength;
        ansatz
    }

    /// A solution on this branch, not on another one.
    fn solve(
        &self,
        parameters: &Parameters,
        count: usize,
        start: &Ansatz,
    ) -> Result<Solution, NewtonFailure> {
        /// Part of the first-order amplitude below which a solution is the steady state.
        const VANISHED: f64 = 1e-6;
        let basis = Basis::new(parameters, count);
        let solution = solve(parameters, basis, start, self.interrupted)?;
        let amplitude = solution.ansatz.q.cosine(1);
        if solution.unstable == self.stable
            || amplitude < VANISHED
            || solution.ansatz.frequency <= 0.0
        {
            return Err(NewtonFailure::Unsettled(amplitude));
        }
        Ok(solution)
    }

    /// Reads everything out, in the units of the question.
    fn describe(
        &self,
        count: usize,
        ansatz: &Ansatz,
        residual: &BalanceResidual,
    ) -> Result<HarmonicCycle, Lost> {
        let sized = |value| times_power(value, self.unit);
        let frequency = ansatz.frequency;
        let (q_min, q_max) = extremes(&ansatz.q);
        let (p_min, p_max) = extremes(&ansatz.q.derivative());
        let cycle = HarmonicCycle {
            harmonics: count,
            stable: self.stable,
            q_min: sized(q_min),
            q_max: sized(q_max),
            v_min: sized(frequency * p_min),
            v_max: sized(frequency * p_max),
            mean: sized(ansatz.q.mean()),
            frequency,
            period: TAU / frequency,
            crossings: residual.crossings(),
            residual: residual.relative(),
            displacement: ansatz.q.map(sized),
        };
        let numbers =
            [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.mean, cycle.period];
        if numbers.iter().all(|number| number.is_finite()) {
            Ok(cycle)
        } else {
            Err(Lost::OutOfRange)
        }
    }
}

fn lost(failure: NewtonFailure, harmonics: usize, strength: f64) -> Lost {
    match failure {
        NewtonFailure::Interrupted => Lost::Interrupted,
        NewtonFailure::OutOfRange => Lost::OutOfRange,
        NewtonFailure::Unsettled(_) => Lost::Ends { harmonics, strength },
    }
}

/// The line through two solutions, at strength `s`.
fn secant(before: &(f64, Ansatz), here: &(f64, Ansatz), s: f64) -> Ansatz {
    let ahead = (s - here.0) / (here.0 - before.0);
    let mut next = here.1.clone();
    next.frequency += ahead * (here.1.frequency - before.1.frequency);
    for (k, coefficient) in next.q.coefficients.iter_mut().enumerate() {
        *coefficient += (*coefficient - before.1.q.coefficient(k.cast_signed())) * ahead;
    }
    next
}

/// Smallest and largest value: those at the roots of the derivative.
fn extremes(function: &Fourier) -> (f64, f64) {
    let turns = sign_changes(&function.derivative());
    let values = turns.iter().map(|turn| function.at(turn.angle).value);
    values.fold((function.mean(), function.mean()), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

impl HarmonicCycle {
    /// Half of what lies between the turning points.
    pub fn amplitude(&self) -> f64 {
        0.5 * (self.q_max - self.q_min)
    }

    /// The cycle with the opposite displacement, half a turn later, where its phase is again that of the paper.
    fn mirrored(mut self) -> Self {
        for even in self.displacement.coefficients.iter_mut().step_by(2) {
            *even = -*even;
        }
        HarmonicCycle {
            q_min: -self.q_max,
            q_max: -self.q_min,
            v_min: -self.v_max,
            v_max: -self.v_min,
            mean: -self.mean,
            ..self
        }
    }

    /// The closed curve in the phase plane, with `points` points evenly spaced in time and the first one
    /// repeated at the end.
    pub fn curve(&self, points: usize) -> Vec<State> {
        let state = |index: usize| {
            let jet = self.displacement.at(TAU * (factor(index % points) / factor(points)));
            State { q: jet.value, v: self.frequency * jet.slope }
        };
        (0..=points).map(state).collect()
    }
}

#[cfg(test)]
mod tests;
