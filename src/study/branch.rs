//! Limit cycles along a parameter, with the special points of their branches.

use serde::Serialize;

use super::cycle::Cycle;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{Parameters, Symbol};

/// A cycle and the parameter value at which it lives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BranchPoint {
    /// Value of the branch's parameter.
    pub value: f64,
    /// The cycle there.
    #[serde(flatten)]
    pub cycle: Cycle,
}

/// What makes a point of a branch special.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialKind {
    /// Two cycles meet and vanish.
    Fold,
    /// The cycle goes to infinity.
    Escape,
    /// The steady state changes its stability (r = 0).
    Hopf,
    /// The branch crosses the value zero of its parameter.
    ZeroCrossing,
}

/// A special point of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Special {
    /// What it is.
    pub kind: SpecialKind,
    /// Value of the parameter there.
    pub value: f64,
    /// Right turning point of the cycle there; `None` where it is infinite.
    pub q_max: Option<f64>,
}

/// The cycles along a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The parameter that varies.
    pub parameter: Symbol,
    /// Connected pieces, each in order along the curve.
    pub pieces: Vec<Vec<BranchPoint>>,
    /// The special points, by value.
    pub special: Vec<Special>,
    /// What it cost.
    pub cost: Cost,
}

/// Follows the cycles while `parameter` runs over `range`, at about `count` points a piece.
///
/// # Errors
/// The [`Reason`] why the branch could not be completed.
pub fn branch(
    parameters: &Parameters,
    parameter: Symbol,
    range: (f64, f64),
    count: usize,
    tolerance: f64,
    limits: &Limits,
) -> Result<Branch, Reason> {
    let _ = (parameter, range, count, tolerance, limits);
    todo!("{parameters:?}")
}
