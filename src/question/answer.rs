//! Answers to questions.

use super::capture::Borders;
use super::fit::Fit;
use super::means::Rows;
use super::speeds::Speeds;
use super::whole::{Course, Kinds};
use super::zones::Zones;
use crate::flow::{Cost, Reason, Trajectory};
use crate::study::accuracy::Reference;
use crate::study::chart::Chart;
use crate::study::claims::Examined;
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::trade::Trade;
use crate::study::{Branch, Cycles, ReturnMap};

/// What the worker found.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// To [`Request::Trajectory`](super::request::Request::Trajectory).
    Trajectory(Trajectory),
    /// To [`Request::Cycles`](super::request::Request::Cycles).
    Cycles(Cycles),
    /// To [`Request::Machine`](super::request::Request::Machine) and `Portrait`.
    Whole(Box<Whole>),
    /// To [`Request::Speeds`](super::request::Request::Speeds).
    Speeds(Speeds),
    /// To [`Request::Zones`](super::request::Request::Zones) and `MachineZones`.
    Zones(Zones),
    /// To [`Request::Capture`](super::request::Request::Capture).
    Capture(Borders),
    /// To [`Request::Balance`](super::request::Request::Balance).
    Balance(HarmonicBalance),
    /// To [`Request::Branch`](super::request::Request::Branch).
    Branch(Branch),
    /// To [`Request::ReturnMap`](super::request::Request::ReturnMap).
    ReturnMap(ReturnMap),
    /// To [`Request::Regimes`](super::request::Request::Regimes).
    Regimes(Chart),
    /// To [`Request::Trade`](super::request::Request::Trade).
    Trade(Box<Trade>),
    /// To [`Request::Reference`](super::request::Request::Reference); why there is none, where it would take too long.
    Reference(Result<Box<Reference>, Reason>),
    /// To [`Request::Claims`](super::request::Request::Claims).
    Claims(Vec<Examined>),
    /// To [`Request::Fit`](super::request::Request::Fit).
    Fit(Fit),
    /// To [`Request::Scan`](super::request::Request::Scan): some more rows.
    Rows(Rows),
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

impl Answer {
    /// What the computation cost, counted.
    #[must_use]
    pub fn cost(&self) -> Cost {
        match self {
            Answer::Trajectory(answer) => answer.cost,
            Answer::Cycles(answer) => answer.cost,
            Answer::Whole(answer) => answer.drawn.cost(),
            Answer::Speeds(answer) => answer.cost,
            Answer::Zones(answer) => answer.cost,
            Answer::Capture(answer) => answer.cost,
            Answer::Balance(answer) => answer.cost,
            Answer::Branch(answer) => answer.cost,
            Answer::ReturnMap(answer) => answer.cost,
            Answer::Regimes(answer) => answer.cost,
            Answer::Trade(answer) => answer.cost(),
            Answer::Reference(answer) => {
                answer.as_ref().map_or(Cost::default(), |found| found.cost)
            }
            Answer::Rows(answer) => answer.rows.iter().fold(Cost::default(), |mut sum, row| {
                sum += row.cost;
                sum
            }),
            Answer::Claims(_) | Answer::Fit(_) => Cost::default(),
        }
    }
}
