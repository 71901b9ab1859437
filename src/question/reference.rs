//! The motion to more digits than any method yields: the reference against which errors are measured.

use super::kind::{Motion, Question, of_motion};
use super::resources::Resources;
use crate::accuracy::reference::Reference;
use crate::flow::{Limits, Reason};

/// Maximum number of evaluations for a reference in the explorer; beyond it, the energy ledger must do.
const REFERENCE: u64 = 4_000_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs(pub Motion);

impl Question for Inputs {
    /// The error says why there is no reference, for example because it would take too long.
    type Found = Result<Box<Reference>, Reason>;

    fn answer(&self, Resources { limits, .. }: &Resources) -> Result<Self::Found, Reason> {
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
