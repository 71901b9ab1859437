//! Every limit cycle at given parameters.

use serde::Serialize;

use crate::closed_form::harmonic::Harmonic;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{Parameters, State};

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

/// All limit cycles, by amplitude, and what they imply for the basin.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycles {
    /// The parameters.
    pub parameters: Parameters,
    /// The cycles, smallest first.
    pub cycles: Vec<Cycle>,
    /// The closed curve of each cycle, for drawing, if asked for.
    pub curves: Vec<Vec<State>>,
    /// The first-order harmonic answer, for comparison.
    pub harmonic: Vec<Harmonic>,
    /// What borders the basin of the sticking set.
    pub edge: Edge,
    /// Polyline of the edge, for drawing, if asked for and if there is one.
    pub edge_curve: Vec<State>,
    /// What it cost.
    pub cost: Cost,
}

/// Finds all limit cycles at these parameters; `curves` asks for the drawn curves too.
///
/// # Errors
/// The [`Reason`] why the search could not be completed.
pub fn cycles(
    parameters: &Parameters,
    tolerance: f64,
    curves: bool,
    limits: &Limits,
) -> Result<Cycles, Reason> {
    let _ = (tolerance, curves, limits);
    todo!("{parameters:?}")
}
