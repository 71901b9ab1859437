//! Requests: exactly the inputs that a layer depends on, so that equal requests need no new answer.

use std::sync::Arc;

use super::recording::Recording;
use crate::flow::quality::DRAFT;
use crate::flow::{Method, Problem};
use crate::machine::Tolerances;
use crate::oscillator::{Belt, ParameterBox, Parameters, State, Symbol};
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
    /// What is safe and what is lost for certain.
    Zones {
        /// Where the parameters lie.
        known: ParameterBox,
        /// Bound on the disturbance.
        disturbance: f64,
    },
    /// The same of a machine by the whole model.
    MachineZones {
        /// The machine.
        belt: Arc<Belt>,
        /// Its tolerances, and the disturbance.
        tolerances: Tolerances,
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

/// What a request asks about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Topic {
    /// The fit of a record.
    Fit,
    /// The motion.
    Trajectory,
    /// Cycles and basin edge.
    Cycles,
    /// What is safe and what is lost for certain.
    Zones,
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
    /// The cycles over the speed of the belt.
    Speeds,
    /// What accuracy costs.
    Trade,
    /// The scan.
    Scan,
    /// The claims of the paper.
    Claims,
    /// What errors are measured against: wanted last of all.
    Reference,
}

/// Every topic, the most urgent first.
pub const TOPICS: [Topic; 14] = [
    Topic::Fit,
    Topic::Trajectory,
    Topic::Cycles,
    Topic::Zones,
    Topic::Capture,
    Topic::Branch,
    Topic::Balance,
    Topic::ReturnMap,
    Topic::Regimes,
    Topic::Speeds,
    Topic::Trade,
    Topic::Scan,
    Topic::Claims,
    Topic::Reference,
];

impl Topic {
    /// Whether it is asked of each variant that a plot shows.
    #[must_use]
    pub fn is_of_variants(self) -> bool {
        matches!(self, Topic::Trajectory | Topic::Cycles | Topic::Branch)
    }

    /// The name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Topic::Trajectory => "motion",
            Topic::Cycles => "cycles",
            Topic::Zones => "certainty",
            Topic::Capture => "bands",
            Topic::Branch => "branch",
            Topic::Balance => "harmonics",
            Topic::ReturnMap => "return map",
            Topic::Regimes => "regimes",
            Topic::Speeds => "speeds",
            Topic::Trade => "trade",
            Topic::Reference => "reference",
            Topic::Scan => "scan",
            Topic::Claims => "paper",
            Topic::Fit => "fit",
        }
    }
}

impl Request {
    /// What this asks about.
    #[must_use]
    pub fn topic(&self) -> Topic {
        match self {
            Request::Trajectory(_) | Request::Machine { .. } => Topic::Trajectory,
            Request::Cycles { .. } | Request::Portrait { .. } => Topic::Cycles,
            Request::Zones { .. } | Request::MachineZones { .. } => Topic::Zones,
            Request::Capture { .. } => Topic::Capture,
            Request::Balance { .. } => Topic::Balance,
            Request::Branch { .. } => Topic::Branch,
            Request::ReturnMap { .. } => Topic::ReturnMap,
            Request::Regimes { .. } => Topic::Regimes,
            Request::Speeds { .. } => Topic::Speeds,
            Request::Trade { .. } => Topic::Trade,
            Request::Reference { .. } => Topic::Reference,
            Request::Scan { .. } => Topic::Scan,
            Request::Claims => Topic::Claims,
            Request::Fit { .. } => Topic::Fit,
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
            Request::Cycles { .. }
            | Request::Machine { .. }
            | Request::Portrait { .. }
            | Request::Zones { .. }
            | Request::MachineZones { .. }
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

    /// How alike this is to a question: how many of their numbers are equal. `None` where its answer must
    /// not stand in for the wanted one, not even until that is there.
    #[must_use]
    pub fn likeness(&self, wanted: &Request) -> Option<usize> {
        let comparable = match (self, wanted) {
            (Request::Branch { parameter: mine, .. }, Request::Branch { parameter, .. }) => {
                mine == parameter
            }
            (Request::Regimes { plane: mine, .. }, Request::Regimes { plane, .. }) => {
                (mine.right, mine.up) == (plane.right, plane.up)
            }
            _ => self.topic() == wanted.topic(),
        };
        let pairs = || self.numbers().into_iter().zip(wanted.numbers());
        comparable.then(|| pairs().filter(|(mine, wanted)| mine == wanted).count())
    }

    /// The numbers that it depends on, but for those that say how finely it is to be answered.
    fn numbers(&self) -> [f64; 8] {
        let of = |parameters: &Parameters, rest: [f64; 4]| {
            let Parameters { d, d2, d3, r } = *parameters;
            let [a, b, c, e] = rest;
            [d, d2, d3, r, a, b, c, e]
        };
        match self {
            Request::Trajectory(problem) | Request::Machine { problem, .. } => {
                let Problem { parameters, initial, until, .. } = problem;
                of(parameters, [initial.q, initial.v, *until, 0.0])
            }
            Request::Trade { parameters, initial, until }
            | Request::Reference { parameters, initial, until } => {
                of(parameters, [initial.q, initial.v, *until, 0.0])
            }
            Request::Cycles { parameters }
            | Request::Portrait { parameters, .. }
            | Request::Balance { parameters, .. } => of(parameters, [0.0; 4]),
            Request::Zones { known, disturbance } => {
                of(&known.middle(), [*disturbance, 0.0, 0.0, 0.0])
            }
            Request::MachineZones { belt, tolerances } => {
                [belt.belt_speed, tolerances.disturbance, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
            }
            Request::Capture { parameters, reach, .. } => of(parameters, [*reach, 0.0, 0.0, 0.0]),
            Request::Branch { parameters, range: (from, to), .. }
            | Request::ReturnMap { parameters, range: (from, to) } => {
                of(parameters, [*from, *to, 0.0, 0.0])
            }
            Request::Regimes { parameters, plane, .. } => {
                let ((left, right), (low, high)) = (plane.right_range, plane.up_range);
                of(parameters, [left, right, low, high])
            }
            Request::Speeds { range: (from, to), .. } => [*from, *to, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            Request::Scan { .. } | Request::Claims | Request::Fit { .. } => [0.0; 8],
        }
    }
}
