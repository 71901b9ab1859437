//! The motion to more digits than any method gives: what its error is measured against.

use super::kind::{Question, of_motion};
use super::means::Means;
use crate::flow::{Limits, Problem, Reason};
use crate::oscillator::{Parameters, State};
use crate::study::accuracy::Reference;

/// Evaluations that a reference may take in the explorer: beyond, the energy ledger must do.
const REFERENCE: u64 = 4_000_000;

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
    /// Why there is none, where it would take too long.
    type Found = Result<Box<Reference>, Reason>;

    fn answer(&self, Means { limits, .. }: &Means) -> Result<Self::Found, Reason> {
        let limits = Limits { evaluations: limits.evaluations.min(REFERENCE), ..**limits };
        match Reference::of(&self.problem(), &limits) {
            Err(Reason::Interrupted) => Err(Reason::Interrupted),
            found => Ok(found.map(Box::new)),
        }
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(&self.problem())
    }
}
