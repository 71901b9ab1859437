//! The motion to more digits than any method yields: the reference against which errors are measured.

use super::kind::{Motion, Question, of_motion};
use super::means::Means;
use crate::flow::{Limits, Reason};
use crate::study::accuracy::Reference;

/// Maximum number of evaluations for a reference in the explorer; beyond it, the energy ledger must do.
const REFERENCE: u64 = 4_000_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Asked(pub Motion);

impl Question for Asked {
    /// The error says why there is no reference, for example because it would take too long.
    type Found = Result<Box<Reference>, Reason>;

    fn answer(&self, Means { limits, .. }: &Means) -> Result<Self::Found, Reason> {
        let limits = Limits { evaluations: limits.evaluations.min(REFERENCE), ..**limits };
        match Reference::of(&self.0.problem(), &limits) {
            Err(Reason::Interrupted) => Err(Reason::Interrupted),
            found => Ok(found.map(Box::new)),
        }
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(&self.0.problem())
    }
}
