//! Accuracy against cost on a motion: every method over its tolerances.

use super::kind::{Motion, Question, of_motion};
use super::resources::Resources;
pub use crate::accuracy::trade::Trade;
use crate::flow::{Limits, Reason};

/// Maximum number of evaluations for a row of the trade on the screen; the command line allows more.
const ROW: u64 = 1_000_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs(pub Motion);

impl Question for Inputs {
    type Found = Box<Trade>;

    fn answer(&self, Resources { limits, .. }: &Resources) -> Result<Self::Found, Reason> {
        let limits = Limits { evaluations: limits.evaluations.min(ROW), ..**limits };
        Trade::of(&self.0.problem(), &limits).map(Box::new)
    }

    fn numbers(&self) -> [f64; 8] {
        of_motion(&self.0.problem())
    }
}
