//! Limit cycles as data: one, and all of them with a picture of the basin.

use crate::closed_form::harmonic::Harmonic;
use crate::flow::Cost;
use crate::model::{Ledger, Parameters, State};
use crate::portrait::{Border, Cycle, Margin};

/// What a picture of the basin shows.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinPicture {
    /// The closed curve of each cycle.
    pub curves: Vec<Vec<State>>,
    /// What each source does over one turn of each cycle.
    pub works: Vec<Ledger>,
    /// The border of the basin: a closed curve, or the separatrix as far as it was followed; else empty.
    pub border: Vec<State>,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Radius of Lyapunov's disk (24) as a fraction of the margin; above 1 it promises too much, because it
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
    pub border: Border,
    /// Curves and margins, if asked for.
    pub picture: Option<BasinPicture>,
    /// What it cost.
    pub cost: Cost,
}
