//! What fraction of random kicks is lost.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::flow::{Cost, Reason};
use crate::model::Parameters;
use crate::portrait::basin::basin;
pub use crate::portrait::basin::stability::Share;
use crate::portrait::kicks::RandomKick;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
    /// The density of the kicks.
    pub kicks: RandomKick,
}

/// The fraction of the kicks that lead out of the basin of the sticking set.
#[derive(Clone, Debug, PartialEq)]
pub struct LostShare {
    /// The fraction and its error.
    pub share: Share,
    /// Cost of computing the basin.
    pub cost: Cost,
}

impl Question for Inputs {
    type Found = LostShare;

    fn answer(&self, means: &Resources) -> Result<LostShare, Reason> {
        let found = basin(&self.parameters, self.kicks.reach(), means.limits)?;
        Ok(LostShare { share: self.kicks.lost(&found), cost: found.cost })
    }

    fn numbers(&self) -> [f64; 8] {
        let RandomKick { q, v, .. } = self.kicks;
        numbers(&self.parameters, [q.0, q.1, v.0, v.1])
    }
}
