//! Requests: exactly the inputs that a layer depends on, so that equal requests need no new answer.

use std::sync::Arc;

use super::recording::Recording;
use crate::flow::quality::DRAFT;
use crate::flow::{Method, Problem};
use crate::oscillator::{Belt, Parameters, State, Symbol};
use crate::study::chart::Plane;
use crate::study::scan::Scan;

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
    /// The motion of a machine by the whole model, in the units of the paper's oscillator.
    Machine {
        /// The machine.
        belt: Arc<Belt>,
        /// Start, end time and tolerance; the parameters are those of the cubic expansion.
        problem: Problem,
    },
    /// All cycles of a machine and the border of its basin.
    Portrait {
        /// The machine.
        belt: Arc<Belt>,
        /// Its cubic expansion.
        parameters: Parameters,
        /// Whether the cycles of the expansion are to be drawn, and not those of the whole model.
        cubic: bool,
    },
    /// The cycles of a machine over the speed of its belt.
    Speeds {
        /// The machine; its own speed is put to 1 so that stepping it changes nothing here.
        belt: Arc<Belt>,
        /// From and to, in m/s.
        range: (f64, f64),
        /// Speeds that are looked at.
        count: usize,
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
    /// From turning points to the next ones.
    ReturnMap {
        /// The parameters.
        parameters: Parameters,
        /// Displacements, from and to.
        range: (f64, f64),
    },
    /// What becomes of kicks, over two parameters.
    Regimes {
        /// The parameters; the two that vary are set to 0 so that stepping them changes nothing here.
        parameters: Parameters,
        /// The two that vary, and their ranges.
        plane: Plane,
        /// Whether few lines are enough for now.
        rough: bool,
    },
    /// The same question for each of several variants that a plot shows.
    Family {
        /// Which kind: one of the three of variants.
        slot: Slot,
        /// The question for each variant.
        members: Vec<Request>,
    },
    /// What accuracy costs on this motion: every method over its tolerances.
    Trade {
        /// The parameters.
        parameters: Parameters,
        /// The start.
        initial: State,
        /// The end time.
        until: f64,
    },
    /// The motion to more digits than any method gives: what its error is measured against.
    Reference {
        /// The parameters.
        parameters: Parameters,
        /// The start.
        initial: State,
        /// The end time.
        until: f64,
    },
    /// The rows of a scan that are not there yet.
    Scan {
        /// The scan.
        scan: Arc<Scan>,
        /// Number of the first point wanted.
        from: usize,
    },
    /// The claims of the paper against computation.
    Claims,
    /// The oscillator that a record is of, and the margin that follows.
    Fit {
        /// The record.
        recording: Recording,
    },
}

/// Speeds of the belt that are looked at, and in a draft.
pub const SPEEDS: usize = 81;
const ROUGH: usize = 11;

/// The kind of a request.
///
/// Of most kinds one answer is on show, which all plots share. An answer that depends on what a plot
/// looks at is that plot's own ([`Slot::is_own`]).
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
    /// The return map.
    ReturnMap,
    /// The chart of regimes.
    Regimes,
    /// The motion of each variant that a plot shows.
    VariantMotions,
    /// Cycles and basin edge of each.
    VariantCycles,
    /// The diagram of each.
    VariantBranches,
    /// The cycles over the speed of the belt.
    Speeds,
    /// What accuracy costs.
    Trade,
    /// The scan.
    Scan,
    /// The claims of the paper.
    Claims,
    /// The fit of a record.
    Fit,
    /// What errors are measured against: wanted last of all.
    Reference,
}

/// Every kind, the most urgent first.
pub const SLOTS: [Slot; 16] = [
    Slot::Fit,
    Slot::Trajectory,
    Slot::VariantMotions,
    Slot::Cycles,
    Slot::VariantCycles,
    Slot::Capture,
    Slot::Branch,
    Slot::VariantBranches,
    Slot::Balance,
    Slot::ReturnMap,
    Slot::Regimes,
    Slot::Speeds,
    Slot::Trade,
    Slot::Scan,
    Slot::Claims,
    Slot::Reference,
];

/// What can be asked of each variant, and the kind of the question that does.
const OF_VARIANTS: [(Slot, Slot); 3] = [
    (Slot::Trajectory, Slot::VariantMotions),
    (Slot::Cycles, Slot::VariantCycles),
    (Slot::Branch, Slot::VariantBranches),
];

impl Slot {
    /// Whether the question depends on the axes or the window of the plot that asks it.
    #[must_use]
    pub fn is_own(self) -> bool {
        matches!(
            self,
            Slot::Capture
                | Slot::Branch
                | Slot::ReturnMap
                | Slot::Regimes
                | Slot::Speeds
                | Slot::VariantMotions
                | Slot::VariantCycles
                | Slot::VariantBranches
        )
    }

    /// The kind that asks this of each variant; `None` where variants have no such answer.
    #[must_use]
    pub fn of_variants(self) -> Option<Slot> {
        let (_, of_variants) = OF_VARIANTS.iter().find(|(one, _)| *one == self)?;
        Some(*of_variants)
    }

    /// The kind that this asks of each variant; `None` where it is not of variants.
    #[must_use]
    pub fn of_one(self) -> Option<Slot> {
        let (one, _) = OF_VARIANTS.iter().find(|(_, of_variants)| *of_variants == self)?;
        Some(*one)
    }

    /// The name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Slot::Trajectory => "motion",
            Slot::Cycles => "cycles",
            Slot::Capture => "bands",
            Slot::Branch => "branch",
            Slot::Balance => "harmonics",
            Slot::ReturnMap => "return map",
            Slot::Regimes => "regimes",
            Slot::VariantMotions => "motions",
            Slot::VariantCycles => "cycles each",
            Slot::VariantBranches => "branches",
            Slot::Speeds => "speeds",
            Slot::Trade => "trade",
            Slot::Reference => "reference",
            Slot::Scan => "scan",
            Slot::Claims => "paper",
            Slot::Fit => "fit",
        }
    }
}

impl Request {
    /// Which kind of request this is.
    #[must_use]
    pub fn slot(&self) -> Slot {
        match self {
            Request::Trajectory(_) | Request::Machine { .. } => Slot::Trajectory,
            Request::Cycles { .. } | Request::Portrait { .. } => Slot::Cycles,
            Request::Capture { .. } => Slot::Capture,
            Request::Balance { .. } => Slot::Balance,
            Request::Branch { .. } => Slot::Branch,
            Request::ReturnMap { .. } => Slot::ReturnMap,
            Request::Regimes { .. } => Slot::Regimes,
            Request::Speeds { .. } => Slot::Speeds,
            Request::Family { slot, .. } => *slot,
            Request::Trade { .. } => Slot::Trade,
            Request::Reference { .. } => Slot::Reference,
            Request::Scan { .. } => Slot::Scan,
            Request::Claims => Slot::Claims,
            Request::Fit { .. } => Slot::Fit,
        }
    }

    /// The same question, to be answered quickly and roughly first; `None` where it is rough already, or
    /// where roughness saves nothing.
    #[must_use]
    pub fn draft(&self) -> Option<Request> {
        match self {
            Request::Trajectory(problem) => {
                let (rough, linear) =
                    (problem.at(&DRAFT), problem.parameters.is_piecewise_linear());
                let closed = matches!(problem.method, Method::Exact)
                    || (problem.method == Method::Auto && linear);
                let finer = problem.setting() < rough.setting();
                (finer && !closed).then_some(Request::Trajectory(rough))
            }
            Request::Branch { parameters, parameter, range, tolerance } => {
                (*tolerance < DRAFT.tolerance).then_some(Request::Branch {
                    parameters: *parameters,
                    parameter: *parameter,
                    range: *range,
                    tolerance: DRAFT.tolerance,
                })
            }
            Request::Regimes { parameters, plane, rough } => {
                let (parameters, plane) = (*parameters, *plane);
                (!rough).then_some(Request::Regimes { parameters, plane, rough: true })
            }
            Request::Speeds { belt, range, count } => (*count > ROUGH).then(|| Request::Speeds {
                belt: Arc::clone(belt),
                range: *range,
                count: ROUGH,
            }),
            Request::Family { slot, members } => {
                let drafts: Vec<_> = members.iter().map(Request::draft).collect();
                let rough = |(draft, member): (Option<Request>, &Request)| {
                    draft.unwrap_or_else(|| member.clone())
                };
                drafts.iter().any(Option::is_some).then(|| Request::Family {
                    slot: *slot,
                    members: drafts.into_iter().zip(members).map(rough).collect(),
                })
            }
            Request::Cycles { .. }
            | Request::Machine { .. }
            | Request::Portrait { .. }
            | Request::Capture { .. }
            | Request::Balance { .. }
            | Request::ReturnMap { .. }
            | Request::Trade { .. }
            | Request::Scan { .. }
            | Request::Reference { .. }
            | Request::Fit { .. }
            | Request::Claims => None,
        }
    }

    /// Whether it may take long, is answered in pieces, and must not keep others waiting.
    #[must_use]
    pub fn is_long(&self) -> bool {
        matches!(self, Request::Scan { .. })
    }

    /// Whether the answer to this may stand in for that to `wanted` until that is there.
    #[must_use]
    pub fn resembles(&self, wanted: &Request) -> bool {
        match (self, wanted) {
            (Request::Branch { parameter: mine, .. }, Request::Branch { parameter, .. }) => {
                mine == parameter
            }
            (Request::Regimes { plane: mine, .. }, Request::Regimes { plane, .. }) => {
                (mine.right, mine.up) == (plane.right, plane.up)
            }
            (Request::Family { members: mine, .. }, Request::Family { members: wanted, .. }) => {
                let mut pairs = mine.iter().zip(wanted);
                mine.len() == wanted.len() && pairs.all(|(mine, wanted)| mine.resembles(wanted))
            }
            _ => self.slot() == wanted.slot(),
        }
    }
}
