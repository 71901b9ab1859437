//! The claims of the paper, checked by computation.

use super::kind::Question;
use super::resources::Resources;
use crate::flow::Reason;
use crate::paper::{ClaimResult, examine_all};

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs;

impl Question for Inputs {
    type Found = Vec<ClaimResult>;

    fn answer(&self, means: &Resources) -> Result<Self::Found, Reason> {
        examine_all(means.limits)
    }
}
