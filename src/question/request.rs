//! Requests, topics and answers: types derived from the table of questions.

use serde::{Serialize, Serializer};

use super::kind::Question;
use super::resources::{Fineness, Resources, Rows};
use super::whole::{Course, WholeCycles};
use crate::flow::{Cost, Limits, Reason, Trajectory};
use crate::portrait::Cycles;
use crate::scan::grid::Scan;

/// Makes these types from the table of questions.
macro_rules! types {
    ($(
        $(#[$doc:meta])* $topic:ident($module:ident) $name:literal costs |$found:pat_param| $cost:expr
        $(, or $request:ident($its:ident) answered by $answer:path)?;
    )*) => {
        /// A question to the worker: exactly the inputs on which a layer depends, so that equal requests have
        /// equal answers.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Request {
            $($(#[$doc])* $topic(super::$module::Inputs),
            $(/// The same question about a machine, by the whole model.
            $request(super::$its::Inputs),)?)*
        }

        /// The subject of a request.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Topic {
            $($(#[$doc])* $topic,)*
        }

        /// The answer of the worker.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Answer {
            $($(#[$doc])* $topic(<super::$module::Inputs as Question>::Found),)*
            /// A motion or cycles by the whole model.
            Whole(Box<Whole>),
        }

        /// Every topic, the most urgent first.
        pub const TOPICS: &[Topic] = &[$(Topic::$topic),*];

        impl Topic {
            /// The name on the screen.
            pub fn name(self) -> &'static str {
                match self {
                    $(Topic::$topic => $name,)*
                }
            }
        }

        impl Answer {
            /// Counted cost of the computation.
            pub fn cost(&self) -> Cost {
                match self {
                    $(Answer::$topic($found) => $cost,)*
                    Answer::Whole(whole) => whole.drawn.cost(),
                }
            }
        }

        impl Request {
            /// The subject of this request.
            pub fn topic(&self) -> Topic {
                match self {
                    $(Request::$topic(_) $(| Request::$request(_))? => Topic::$topic,)*
                }
            }

            /// A rougher version of this request that is answered quickly and first; `None` where this one is
            /// rough already, or where roughness saves nothing.
            pub fn draft(&self) -> Option<Request> {
                match self {
                    $(Request::$topic(asked) => asked.draft().map(Request::$topic),
                    $(Request::$request(asked) => asked.draft().map(Request::$request),)?)*
                }
            }

            fn numbers(&self) -> [f64; 8] {
                match self {
                    $(Request::$topic(asked) => asked.numbers(),
                    $(Request::$request(asked) => asked.numbers(),)?)*
                }
            }

            fn compares(&self, wanted: &Request) -> bool {
                match (self, wanted) {
                    $((Request::$topic(mine), Request::$topic(wanted)) => mine.compares(wanted),
                    $((Request::$request(mine), Request::$request(wanted)) => mine.compares(wanted),)?)*
                    _ => self.topic() == wanted.topic(),
                }
            }
        }

        /// Answers a request: the only place where a question becomes a computation.
        pub fn answer_by(request: &Request, means: &Resources) -> Result<Answer, Reason> {
            match request {
                $(Request::$topic(asked) => asked.answer(means).map(Answer::$topic),
                $(Request::$request(asked) => asked.answer(means).map($answer),)?)*
            }
        }
    };
}

questions!(types);

impl Serialize for Topic {
    /// Serializes as the name on the screen.
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.name())
    }
}

impl Topic {
    /// Whether it is asked for each variant that a plot shows.
    pub fn is_of_variants(self) -> bool {
        matches!(self, Topic::Trajectory | Topic::Cycles | Topic::Branch)
    }
}

/// An answer by the whole model, with what has no counterpart in the paper's oscillator.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// The motion or the cycles in the form that views draw.
    pub drawn: Answer,
    /// Fate of the motion, and where it rides on the belt.
    pub motion: Option<Course>,
    /// Properties of the cycles; `None` where the whole model has no answer and its expansion is drawn.
    pub cycles: Option<WholeCycles>,
}

impl Whole {
    /// Wraps the answer to a question for a motion.
    fn motion((drawn, course): (Trajectory, Course)) -> Answer {
        let drawn = Answer::Trajectory(drawn);
        Answer::Whole(Box::new(Whole { drawn, motion: Some(course), cycles: None }))
    }

    /// Wraps the answer to a question for cycles.
    fn cycles((drawn, cycles): (Cycles, Option<WholeCycles>)) -> Answer {
        let drawn = Answer::Cycles(drawn);
        Answer::Whole(Box::new(Whole { drawn, motion: None, cycles }))
    }
}

impl Request {
    /// Whether it may take so long that it must not keep others waiting.
    pub fn is_long(&self) -> bool {
        matches!(self, Request::Scan(_) | Request::Proof(_) | Request::Fit(_))
    }

    /// Likeness to the `wanted` request: how many of their numbers are equal. `None` where its answer must not
    /// stand in for that one, not even until it arrives.
    pub fn likeness(&self, wanted: &Request) -> Option<usize> {
        let pairs = || self.numbers().into_iter().zip(wanted.numbers());
        self.compares(wanted).then(|| pairs().filter(|(mine, wanted)| mine == wanted).count())
    }
}

/// Answers a request on this thread, with the fineness of the screen.
pub fn answer(request: &Request, limits: &Limits) -> Result<Answer, Reason> {
    answer_for(request, Fineness::SCREEN, limits)
}

/// Answers a request on this thread, with curves of this fineness.
pub fn answer_for(
    request: &Request,
    fineness: Fineness,
    limits: &Limits,
) -> Result<Answer, Reason> {
    let rows = |scan: &Scan, first: usize| {
        let rows = (first..scan.points()).map(|index| scan.row(index, limits));
        Ok(Rows { first, rows: rows.collect::<Result<_, _>>()? })
    };
    answer_by(request, &Resources { fineness, limits, rows: &rows })
}
