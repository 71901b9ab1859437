//! Requests: exactly the inputs that a layer depends on, so that equal requests need no new answer.

use crate::flow::Problem;
use crate::oscillator::{Parameters, Symbol};

/// A question to the worker. Two equal requests have the same answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// The motion on show, with points for drawing and its energy ledger.
    Trajectory(Problem),
    /// All cycles at these parameters, with their curves and the basin's edge.
    Cycles {
        /// The parameters.
        parameters: Parameters,
    },
    /// The borders of the bands of capture.
    Capture {
        /// The parameters.
        parameters: Parameters,
        /// Clearance up to which borders are followed.
        reach: f64,
        /// Bands at most.
        most: usize,
    },
    /// The cycles of N harmonics, beside the true ones.
    Balance {
        /// The parameters.
        parameters: Parameters,
        /// Number N of harmonics.
        harmonics: usize,
    },
    /// The cycles along a parameter.
    Branch {
        /// The parameters; the one that varies is set to 0 so that stepping it changes nothing here.
        parameters: Parameters,
        /// The parameter that varies.
        parameter: Symbol,
        /// From and to.
        range: (f64, f64),
        /// Relative error wanted.
        tolerance: f64,
    },
}

/// The kind of a request: at most one answer of each kind is on show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Slot {
    /// The motion.
    Trajectory,
    /// Cycles and basin edge.
    Cycles,
    /// The bands of capture.
    Capture,
    /// The diagram.
    Branch,
    /// Harmonic balance.
    Balance,
}

impl Slot {
    /// The name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Slot::Trajectory => "trajectory",
            Slot::Cycles => "cycles",
            Slot::Capture => "bands",
            Slot::Branch => "branch",
            Slot::Balance => "harmonics",
        }
    }
}

impl Request {
    /// Which kind of request this is.
    #[must_use]
    pub fn slot(&self) -> Slot {
        match self {
            Request::Trajectory(_) => Slot::Trajectory,
            Request::Cycles { .. } => Slot::Cycles,
            Request::Capture { .. } => Slot::Capture,
            Request::Balance { .. } => Slot::Balance,
            Request::Branch { .. } => Slot::Branch,
        }
    }
}
