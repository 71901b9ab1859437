//! Requests: the questions, each with its inputs, its draft (a rougher question that is answered first) and its
//! measure of likeness.

use std::sync::Arc;

use serde::Serialize;
use strum::{EnumDiscriminants, IntoStaticStr, VariantArray};

use super::{Fit, Recording};
use crate::branch::Plane;
use crate::fit::MarginQuestion;
use crate::flow::{DRAFT, Method, Problem};
use crate::model::{Belt, Knob, Parameters, Source, Tolerances};
use crate::portrait::RandomKick;
use crate::scan::{LevelTarget, Scan};

/// Every topic, the most urgent first.
pub const TOPICS: &[Topic] = Topic::VARIANTS;

impl Topic {
    /// The name on the screen.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether it is asked for each variant that a plot shows.
    pub fn is_of_variants(self) -> bool {
        matches!(self, Topic::Trajectory | Topic::Cycles | Topic::Branch)
    }
}

/// A question to the worker: exactly the inputs on which a layer depends, so that equal requests have equal
/// answers. The most urgent is the first here; [`Topic`] has the same variants without their inputs, each with its
/// name on the screen.
#[derive(Clone, Debug, PartialEq, EnumDiscriminants)]
#[strum_discriminants(name(Topic), derive(Hash, PartialOrd, Ord, IntoStaticStr, VariantArray))]
#[strum_discriminants(strum(serialize_all = "lowercase"), derive(Serialize))]
#[strum_discriminants(serde(into = "&'static str"))]
pub enum Request {
    /// The fit of the oscillator to a record, and the margin that follows.
    Fit { recording: Recording },
    /// The fit with some numbers held.
    #[strum_discriminants(strum(serialize = "fit"))]
    Refit {
        /// The fit with all numbers free.
        fit: Fit,
        /// Values at which D, D2, D3 and r are held.
        held: [Option<f64>; 4],
        /// What is to be survived if the distribution of the margin is drawn as well, which takes longer than a
        /// frame.
        drawn: Option<MarginQuestion>,
    },
    /// A motion, with points for drawing and its energy ledger.
    #[strum_discriminants(strum(serialize = "motion"))]
    Trajectory {
        /// The motion; its parameters are those of the machine's cubic expansion.
        problem: Problem,
        /// The machine whose motion it is by the whole model, in the units of the paper's oscillator.
        machine: Option<Arc<Belt>>,
    },
    /// All cycles, with their curves and the border of the basin.
    Cycles {
        /// The parameters; of a machine, those of its cubic expansion.
        parameters: Parameters,
        /// The machine, of which much is told beside its cycles.
        machine: Option<Arc<Belt>>,
        /// Whether to draw the cycles of the machine by the whole model instead of those of its expansion.
        whole: bool,
    },
    /// Starts that are certainly safe or certainly lost.
    #[strum_discriminants(strum(serialize = "certainty"))]
    Zones {
        /// What moves: the oscillator of the paper, or a machine by the whole model.
        source: Arc<Source>,
        /// How exactly its numbers are known, and what disturbs it.
        tolerances: Tolerances,
    },
    /// The fraction of random kicks that is lost.
    Kicks {
        /// What is kicked: the oscillator of the paper, or a machine by the whole model.
        source: Arc<Source>,
        /// The density of the kicks, in SI units of a machine.
        kicks: RandomKick,
    },
    /// The borders of the bands of capture.
    #[strum_discriminants(strum(serialize = "bands"))]
    Capture {
        parameters: Parameters,
        /// Largest clearance to which borders are followed.
        reach: f64,
        /// Maximum number of bands.
        most: usize,
    },
    /// The cycles along a parameter.
    Branch {
        /// The parameters; the one that varies is set to 0, so that stepping it leaves the request unchanged.
        parameters: Parameters,
        /// The parameter that varies.
        parameter: Knob,
        /// Ends of the range of that parameter.
        range: (f64, f64),
        /// Requested relative error.
        tolerance: f64,
    },
    /// The cycles by harmonic balance, beside the true ones.
    #[strum_discriminants(strum(serialize = "harmonics"))]
    Balance {
        parameters: Parameters,
        /// Number N of harmonics.
        harmonics: usize,
    },
    /// The return map.
    #[strum_discriminants(strum(serialize = "return map"))]
    ReturnMap {
        parameters: Parameters,
        /// Smallest and largest displacement.
        range: (f64, f64),
    },
    /// The fate of kicks over two parameters.
    Regimes {
        /// The parameters; the two that vary are set to 0, so that stepping them leaves the request unchanged.
        parameters: Parameters,
        /// The two varied parameters and their ranges.
        plane: Plane,
        /// Whether a draft of few lines is enough.
        rough: bool,
    },
    /// The curves over two numbers along which a column of a scan has a value.
    Level {
        /// Over both numbers, which are 0 in it where they vary in a chart.
        scan: Arc<Scan>,
        /// The column and its value.
        target: LevelTarget,
    },
    /// The cycles of a machine over one of its numbers.
    #[strum_discriminants(strum(serialize = "speeds"))]
    MachineBranch {
        /// The machine; the number that varies is set to 1, so that stepping it leaves the request unchanged.
        belt: Arc<Belt>,
        /// The number that varies.
        varied: Knob,
        /// Its smallest and largest value, in SI units; a value without an answer is left out.
        range: (f64, f64),
        /// Whether a draft of few values, without the changes between them, is enough.
        rough: bool,
    },
    /// Accuracy against cost of every method on a motion, whose own method and accuracy are the usual ones.
    Trade(Problem),
    /// The rows of a scan that are still missing.
    Scan {
        scan: Arc<Scan>,
        /// Index of the first point wanted.
        from: usize,
    },
    /// The claims of the paper, checked by computation.
    #[strum_discriminants(strum(serialize = "paper"))]
    Claims,
    /// A proof of the number of cycles. Nothing waits for it; the screen shows it once it is there.
    Proof { parameters: Parameters },
    /// The reference against which errors are measured, a motion to more digits than any method yields, its own method
    /// and accuracy being the usual ones; the least urgent.
    Reference(Problem),
}

impl Request {
    /// The subject of this request.
    pub fn topic(&self) -> Topic {
        self.into()
    }

    /// Whether it may take so long that it must not keep others waiting.
    pub fn is_long(&self) -> bool {
        matches!(self.topic(), Topic::Scan | Topic::Level | Topic::Proof | Topic::Fit)
    }

    /// A rougher version of this request that is answered quickly and first; `None` where this one is rough
    /// already, or where roughness saves nothing.
    pub fn draft(&self) -> Option<Request> {
        let mut draft = self.clone();
        match &mut draft {
            Request::Trajectory { problem, machine: None } => {
                let linear = problem.parameters.is_piecewise_linear();
                let closed =
                    problem.method == Method::Exact || (problem.method == Method::Auto && linear);
                let rougher = problem.at(&DRAFT);
                if closed || problem.setting() >= rougher.setting() {
                    return None;
                }
                *problem = rougher;
            }
            Request::Branch { tolerance, .. } if *tolerance < DRAFT.tolerance => {
                *tolerance = DRAFT.tolerance;
            }
            Request::Regimes { rough, .. } | Request::MachineBranch { rough, .. } if !*rough => {
                *rough = true;
            }
            _ => return None,
        }
        Some(draft)
    }

    /// Likeness to the `wanted` request: how many of their numbers are equal. `None` where its answer must not
    /// stand in for that one, not even until it arrives.
    pub fn likeness(&self, wanted: &Request) -> Option<usize> {
        let pairs = || self.numbers().into_iter().zip(wanted.numbers());
        self.compares(wanted).then(|| pairs().filter(|(mine, wanted)| mine == wanted).count())
    }

    /// Whether this request's answer may stand in for the `wanted` one until that arrives.
    fn compares(&self, wanted: &Request) -> bool {
        match (self, wanted) {
            (Request::Refit { fit, .. }, Request::Refit { fit: wanted, .. }) => fit == wanted,
            (Request::Level { target, .. }, Request::Level { target: wanted, .. })
                if target != wanted =>
            {
                false
            }
            // A proof at other parameters proves nothing at these.
            (Request::Proof { .. }, _) => false,
            _ => self.topic() == wanted.topic() && self.varied() == wanted.varied(),
        }
    }

    /// The numbers over which it goes.
    fn varied(&self) -> [Option<Knob>; 2] {
        match self {
            Request::Branch { parameter: varied, .. } | Request::MachineBranch { varied, .. } => {
                [Some(*varied), None]
            }
            Request::Regimes { plane, .. } => [plane.right, plane.up].map(Some),
            Request::Level { scan, .. } => [0, 1].map(|it| Some(scan.over().get(it)?.symbol)),
            _ => [None; 2],
        }
    }

    /// The numbers on which the answer depends, except those that only say how finely to compute it: the more
    /// of them are equal, the more alike two requests are.
    fn numbers(&self) -> Vec<f64> {
        let with = |it: Parameters, others: &[f64]| [&it.numbers(), others].concat();
        match self {
            Request::Trajectory { problem, .. }
            | Request::Trade(problem)
            | Request::Reference(problem) => {
                let Problem { parameters, initial, until, .. } = *problem;
                with(parameters, &[initial.q, initial.v, until])
            }
            Request::Cycles { parameters, .. }
            | Request::Proof { parameters }
            | Request::Balance { parameters, .. } => with(*parameters, &[]),
            Request::Zones { source, tolerances } => {
                let numbers = source.numbers().map(|(_, value)| value);
                numbers.chain([tolerances.disturbance]).collect()
            }
            Request::Kicks { source, kicks: RandomKick { q, v, .. } } => {
                let numbers = source.numbers().map(|(_, value)| value);
                numbers.chain([q.0, q.1, v.0, v.1]).collect()
            }
            Request::Capture { parameters, reach, .. } => with(*parameters, &[*reach]),
            Request::Branch { parameters, range, .. }
            | Request::ReturnMap { parameters, range } => with(*parameters, &[range.0, range.1]),
            Request::Regimes { parameters, plane, .. } => {
                let ((left, right), (low, high)) = (plane.right_range, plane.up_range);
                with(*parameters, &[left, right, low, high])
            }
            Request::Refit { held, .. } => held.map(Option::unwrap_or_default).to_vec(),
            Request::MachineBranch { range, .. } => vec![range.0, range.1],
            Request::Fit { .. }
            | Request::Scan { .. }
            | Request::Level { .. }
            | Request::Claims => Vec::new(),
        }
    }
}
