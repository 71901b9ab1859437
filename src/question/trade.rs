//! What accuracy costs on a motion: every method over its tolerances.

use super::kind::{Question, of_motion};
use super::means::Means;
use crate::flow::{Limits, Problem, Reason};
use crate::oscillator::{Parameters, State};
use crate::study::trade::Trade;

/// Evaluations that a row of the trade may take on the screen; the command line waits longer.
const ROW: u64 = 1_000_000;

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The parameters.
    pub parameters: Parameters,
    /// The start.
    pub initial: State,
    /// The end time.
    pub until: f64,
}

impl Asked {
    fn problem(&self) -> Problem {
        let Asked { parameters, initial, until } = *self;
        Problem { parameters, initial, until, ..Problem::default() }
    }
}

impl Question for Asked {
    type Found = Box<Trade>;

    fn answer(&self, Means { limits, .. }: &Means) -> Result<Self::Found, Reason> {
        let limits = Limits { evaluations: limits.evaluations.min(ROW), ..**limits };
        Trade::of(&self.problem(), &limits).map(Box::new)
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(&self.problem())
    }
}
