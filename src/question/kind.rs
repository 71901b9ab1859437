//! The trait that every kind of question implements.

use super::resources::Resources;
use crate::flow::{Problem, Reason};
use crate::model::{Parameters, State};

/// A kind of question: its fields are exactly the inputs on which the answer depends.
pub trait Question: Sized + PartialEq {
    /// The type of its answers.
    type Found;

    /// Computes the answer.
    fn answer(&self, means: &Resources) -> Result<Self::Found, Reason>;

    /// A rougher version of this question that is answered quickly and first; `None` where this one is rough
    /// already, or where roughness saves nothing.
    fn draft(&self) -> Option<Self> {
        None
    }

    /// The numbers on which the answer depends, except those that only say how finely to compute it: the more
    /// of them are equal, the more alike two questions are.
    fn numbers(&self) -> [f64; 8] {
        [0.0; 8]
    }

    /// Whether this question's answer may stand in for the `wanted` one until that arrives.
    fn compares(&self, _wanted: &Self) -> bool {
        true
    }
}

/// The parameters and up to four other numbers, as [`Question::numbers`] returns them.
pub(super) fn numbers(parameters: &Parameters, others: [f64; 4]) -> [f64; 8] {
    let Parameters { d, d2, d3, r } = *parameters;
    let [a, b, c, e] = others;
    [d, d2, d3, r, a, b, c, e]
}

/// The numbers of a motion: its parameters, its start and its end time.
pub(super) fn of_motion(problem: &Problem) -> [f64; 8] {
    let Problem { parameters, initial, until, .. } = problem;
    numbers(parameters, [initial.q, initial.v, *until, 0.0])
}

/// A motion without its method and its accuracy.
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
