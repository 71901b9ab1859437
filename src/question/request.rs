//! Requests: exactly the inputs that a layer depends on, so that equal requests need no new answer.

use super::answer::{Answer, Whole};
use super::kind::Question;
use super::means::{Fineness, Means, Rows};
use super::topic::Topic;
use super::{
    balance, branch, capture, claims, cycles, fit, machine, machine_zones, portrait, proof,
    reference, regimes, return_map, scan, speeds, trade, zones,
};
use crate::flow::{Limits, Problem, Reason};
use crate::study::scan::Scan;

/// The table of questions: each with what it asks, what it is about, and what its answer becomes.
macro_rules! requests {
    ($($(#[$doc:meta])* $name:ident($asked:ty) about $topic:ident, answered by $answer:expr;)*) => {
        /// A question to the worker. Two equal requests have the same answer.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Request {
            $($(#[$doc])* $name($asked),)*
        }

        impl Request {
            /// What this asks about.
            #[must_use]
            pub fn topic(&self) -> Topic {
                match self {
                    $(Request::$name(_) => Topic::$topic,)*
                }
            }

            /// The same question, to be answered quickly and roughly first; `None` where it is rough
            /// already, or where roughness saves nothing.
            #[must_use]
            pub fn draft(&self) -> Option<Request> {
                match self {
                    $(Request::$name(asked) => asked.draft().map(Request::$name),)*
                }
            }

            fn numbers(&self) -> [f64; 8] {
                match self {
                    $(Request::$name(asked) => asked.numbers(),)*
                }
            }

            fn compares(&self, wanted: &Request) -> bool {
                match (self, wanted) {
                    $((Request::$name(mine), Request::$name(wanted)) => mine.compares(wanted),)*
                    _ => self.topic() == wanted.topic(),
                }
            }
        }

        /// Answers a request: the only place where a question becomes a computation.
        ///
        /// # Errors
        /// The [`Reason`] why there is no answer.
        pub fn answer_by(request: &Request, means: &Means) -> Result<Answer, Reason> {
            match request {
                $(Request::$name(asked) => asked.answer(means).map($answer),)*
            }
        }
    };
}

requests! {
    /// The motion on show.
    Trajectory(Problem) about Trajectory, answered by Answer::Trajectory;
    /// The motion of a machine by the whole model.
    Machine(machine::Asked) about Trajectory, answered by Whole::motion;
    /// All cycles at some parameters.
    Cycles(cycles::Asked) about Cycles, answered by Answer::Cycles;
    /// All cycles of a machine and the border of its basin.
    Portrait(portrait::Asked) about Cycles, answered by Whole::cycles;
    /// How many cycles there are for certain.
    Proof(proof::Asked) about Proof, answered by Answer::Proof;
    /// What is safe and what is lost for certain.
    Zones(zones::Asked) about Zones, answered by Answer::Zones;
    /// The same of a machine by the whole model.
    MachineZones(machine_zones::Asked) about Zones, answered by Answer::Zones;
    /// The borders of the bands of capture.
    Capture(capture::Asked) about Capture, answered by Answer::Capture;
    /// The cycles of N harmonics.
    Balance(balance::Asked) about Balance, answered by Answer::Balance;
    /// The cycles along a parameter.
    Branch(branch::Asked) about Branch, answered by Answer::Branch;
    /// From turning points to the next ones.
    ReturnMap(return_map::Asked) about ReturnMap, answered by Answer::ReturnMap;
    /// What becomes of kicks, over two parameters.
    Regimes(regimes::Asked) about Regimes, answered by Answer::Regimes;
    /// The cycles of a machine over the speed of its belt.
    Speeds(speeds::Asked) about Speeds, answered by Answer::Speeds;
    /// What accuracy costs.
    Trade(trade::Asked) about Trade, answered by Answer::Trade;
    /// What errors are measured against.
    Reference(reference::Asked) about Reference, answered by Answer::Reference;
    /// The rows of a scan that are not there yet.
    Scan(scan::Asked) about Scan, answered by Answer::Rows;
    /// The claims of the paper.
    Claims(claims::Asked) about Claims, answered by Answer::Claims;
    /// The oscillator that a record is of, and the margin that follows.
    Fit(fit::Asked) about Fit, answered by Answer::Fit;
}

impl Request {
    /// Whether it may take long and must not keep others waiting.
    #[must_use]
    pub fn is_long(&self) -> bool {
        matches!(self, Request::Scan(_) | Request::Proof(_))
    }

    /// How alike this is to a question: how many of their numbers are equal. `None` where its answer must
    /// not stand in for the wanted one, not even until that is there.
    #[must_use]
    pub fn likeness(&self, wanted: &Request) -> Option<usize> {
        let pairs = || self.numbers().into_iter().zip(wanted.numbers());
        self.compares(wanted).then(|| pairs().filter(|(mine, wanted)| mine == wanted).count())
    }
}

/// Answers a request for the screen, on this thread.
///
/// # Errors
/// The [`Reason`] why there is no answer.
pub fn answer(request: &Request, limits: &Limits) -> Result<Answer, Reason> {
    answer_for(request, Fineness::SCREEN, limits)
}

/// The same with curves of another fineness.
///
/// # Errors
/// The [`Reason`] why there is no answer.
pub fn answer_for(
    request: &Request,
    fineness: Fineness,
    limits: &Limits,
) -> Result<Answer, Reason> {
    let rows = |scan: &Scan, first: usize| {
        let rows = (first..scan.points()).map(|index| scan.row(index, limits));
        Ok(Rows { first, rows: rows.collect::<Result<_, _>>()? })
    };
    answer_by(request, &Means { fineness, limits, rows: &rows })
}
