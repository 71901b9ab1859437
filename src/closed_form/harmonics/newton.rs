//! Newton's method on the Galerkin equations, damped so that it cannot overshoot unnoticed.

use nalgebra::{DVector, Dyn, LU};

use super::galerkin::{Ansatz, BalanceResidual, Basis};
use crate::model::Parameters;

/// A solution of the Galerkin equations.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The unknowns.
    pub ansatz: Ansatz,
    /// What it leaves of the equations.
    pub residual: BalanceResidual,
    /// Whether the determinant of the Jacobian is positive.
    ///
    /// It vanishes where two solutions meet, and every further harmonic multiplies it by about
    /// `(1 - k^2 eta^2)^2 + (2 D k eta)^2`, which is positive: so its sign is that of one harmonic,
    /// `2 D + (9/4) D3 A^2` with the sign changed, and tells unstable solutions from stable ones.
    pub unstable: bool,
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NewtonFailure {
    /// The computation was told to stop.
    Interrupted,
    /// A number left the range of floating point.
    OutOfRange,
    /// The iteration did not settle; the last change of the unknowns, relative to the amplitude.
    Unsettled(f64),
}

/// A change of the unknowns below which Newton's next step is below rounding.
const SETTLED: f64 = 1e-12;

/// Solves the Galerkin equations of a basis near `start`.
///
/// A step is damped until the next one, taken with the same Jacobian, is shorter (the natural
/// monotonicity test, which does not depend on how the equations are scaled). Whether to stop is asked
/// before each step.
///
/// # Errors
/// [`NewtonFailure`] says why it found no solution.
pub fn solve(
    parameters: &Parameters,
    basis: Basis,
    start: &Ansatz,
    interrupted: &dyn Fn() -> bool,
) -> Result<Solution, NewtonFailure> {
    /// Newton steps before giving up; sharp kinks need 20.
    const ITERATIONS: usize = 60;
    /// Smallest fraction of a step that is tried.
    const SMALLEST_PART: f64 = 1e-3;
    let mut ansatz = basis.widened(start);
    let mut residual = BalanceResidual::new(parameters, basis, &ansatz);
    let mut part: f64 = 1.0;
    let mut change = f64::INFINITY;
    for _ in 0..ITERATIONS {
        if interrupted() {
            return Err(NewtonFailure::Interrupted);
        }
        let jacobian = residual.jacobian().lu();
        let step = newton_step(&jacobian, &residual)?;
        change = relative(&step, &ansatz);
        part = (4.0 * part).min(1.0);
        loop {
            let next = basis.moved(&ansatz, &step, part);
            let next_residual = BalanceResidual::new(parameters, basis, &next);
            let shorter = newton_step(&jacobian, &next_residual)
                .is_ok_and(|next_step| next_step.amax() <= (1.0 - 0.25 * part) * step.amax());
            if shorter || change < SETTLED {
                (ansatz, residual) = (next, next_residual);
                break;
            }
            part *= 0.5;
            if part < SMALLEST_PART {
                return Err(NewtonFailure::Unsettled(change));
            }
        }
        if change < SETTLED {
            let unstable = has_positive_determinant(&residual.jacobian().lu());
            return Ok(Solution { ansatz, residual, unstable });
        }
    }
    Err(NewtonFailure::Unsettled(change))
}

/// The change of the unknowns that makes the linearised equations vanish.
fn newton_step(
    jacobian: &LU<f64, Dyn, Dyn>,
    residual: &BalanceResidual,
) -> Result<DVector<f64>, NewtonFailure> {
    let values = -residual.values();
    if !values.amax().is_finite() {
        return Err(NewtonFailure::OutOfRange);
    }
    let step = jacobian.solve(&values).filter(|step| step.iter().all(|change| change.is_finite()));
    step.ok_or(NewtonFailure::Unsettled(f64::INFINITY))
}

/// Whether the determinant is positive; its size may well overflow.
fn has_positive_determinant(decomposed: &LU<f64, Dyn, Dyn>) -> bool {
    let pivots = decomposed.u().diagonal();
    let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
    negative.is_multiple_of(2) == (decomposed.p().determinant::<f64>() > 0.0)
}

/// The largest change, relative to the amplitude (or to the frequency, about 1 and smaller).
fn relative(step: &DVector<f64>, ansatz: &Ansatz) -> f64 {
    step.amax() / ansatz.q.cosine(1).abs().max(1.0)
}
