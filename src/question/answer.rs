//! Answers to questions.

use super::capture::Borders;
use super::fit::Fit;
use super::means::Rows;
use super::speeds::Speeds;
use super::whole::{Course, Kinds};
use super::zones::Zones;
use crate::flow::{Cost, Reason, Trajectory};
use crate::proof::Proof;
use crate::study::accuracy::Reference;
use crate::study::chart::Chart;
use crate::study::claims::Examined;
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::trade::Trade;
use crate::study::{Branch, Cycles, ReturnMap};

/// The table of answers, each with what it cost.
macro_rules! answers {
    ($($(#[$doc:meta])* $name:ident($found:ty) costs |$answer:pat_param| $cost:expr;)*) => {
        /// What the worker found.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Answer {
            $($(#[$doc])* $name($found),)*
        }

        impl Answer {
            /// What the computation cost, counted.
            #[must_use]
            pub fn cost(&self) -> Cost {
                match self {
                    $(Answer::$name($answer) => $cost,)*
                }
            }
        }
    };
}

answers! {
    Trajectory(Trajectory) costs |answer| answer.cost;
    Cycles(Cycles) costs |answer| answer.cost;
    /// To [`Request::Machine`](super::request::Request::Machine) and `Portrait`.
    Whole(Box<Whole>) costs |answer| answer.drawn.cost();
    Speeds(Speeds) costs |answer| answer.cost;
    Proof(Proof) costs |_| Cost::default();
    /// To [`Request::Zones`](super::request::Request::Zones) and `MachineZones`.
    Zones(Zones) costs |answer| answer.cost;
    Capture(Borders) costs |answer| answer.cost;
    Balance(HarmonicBalance) costs |answer| answer.cost;
    Branch(Branch) costs |answer| answer.cost;
    ReturnMap(ReturnMap) costs |answer| answer.cost;
    Regimes(Chart) costs |answer| answer.cost;
    Trade(Box<Trade>) costs |answer| answer.cost();
    /// To [`Request::Reference`](super::request::Request::Reference); why there is none, where it would take too long.
    Reference(Result<Box<Reference>, Reason>) costs |answer|
        answer.as_ref().map_or_else(|_| Cost::default(), |found| found.cost);
    Claims(Vec<Examined>) costs |_| Cost::default();
    Fit(Fit) costs |_| Cost::default();
    /// To [`Request::Scan`](super::request::Request::Scan): some more rows.
    Rows(Rows) costs |answer| answer.cost();
}

/// An answer by the whole model, with what the paper's oscillator has no place for.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// The motion or the cycles, as views draw them.
    pub drawn: Answer,
    /// What a motion becomes, and where it rides on the belt.
    pub motion: Option<Course>,
    /// What the cycles are like; `None` where the whole model has no answer and its expansion is drawn.
    pub cycles: Option<Kinds>,
}

impl Whole {
    /// The answer to the question for a motion.
    pub(super) fn motion((drawn, course): (Trajectory, Course)) -> Answer {
        let drawn = Answer::Trajectory(drawn);
        Answer::Whole(Box::new(Whole { drawn, motion: Some(course), cycles: None }))
    }

    /// The answer to the question for cycles.
    pub(super) fn cycles((drawn, cycles): (Cycles, Option<Kinds>)) -> Answer {
        let drawn = Answer::Cycles(drawn);
        Answer::Whole(Box::new(Whole { drawn, motion: None, cycles }))
    }
}
