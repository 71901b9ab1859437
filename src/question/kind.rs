//! What every kind of question has.

use super::means::Means;
use crate::flow::{Problem, Reason};
use crate::oscillator::{Parameters, State};

/// A kind of question; what is asked are its fields, exactly the inputs that the answer depends on.
pub trait Question: Sized + PartialEq {
    /// What answers it.
    type Found;

    /// Computes the answer.
    fn answer(&self, means: &Means) -> Result<Self::Found, Reason>;

    /// The same question, to be answered quickly and roughly first; `None` where it is rough already, or
    /// where roughness saves nothing.
    fn draft(&self) -> Option<Self> {
        None
    }

    /// The numbers that it depends on, except for those that say how finely it is to be answered: two questions
    /// are the more alike the more of them are equal.
    fn numbers(&self) -> [f64; 8] {
        [0.0; 8]
    }

    /// Whether its answer may stand in for the wanted one until that is there.
    fn compares(&self, _wanted: &Self) -> bool {
        true
    }
}

/// The parameters, and up to four other numbers.
pub(super) fn numbers(parameters: &Parameters, others: [f64; 4]) -> [f64; 8] {
    let Parameters { d, d2, d3, r } = *parameters;
    let [a, b, c, e] = others;
    [d, d2, d3, r, a, b, c, e]
}

/// The numbers of a motion.
pub(super) fn of_motion(problem: &Problem) -> [f64; 8] {
    let Problem { parameters, initial, until, .. } = problem;
    numbers(parameters, [initial.q, initial.v, *until, 0.0])
}

/// A motion, whatever method follows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub parameters: Parameters,
    pub initial: State,
    pub until: f64,
}

impl Motion {
    pub(super) fn problem(&self) -> Problem {
        let Motion { parameters, initial, until } = *self;
        Problem { parameters, initial, until, ..Problem::default() }
    }
}
