//! The claims of the paper, checked by computation.

use super::kind::Question;
use super::means::Means;
use crate::flow::Reason;
use crate::study::claims::{Examined, examine_all};

#[derive(Clone, Debug, PartialEq)]
pub struct Asked;

impl Question for Asked {
    type Found = Vec<Examined>;

    fn answer(&self, means: &Means) -> Result<Self::Found, Reason> {
        examine_all(means.limits)
    }
}
