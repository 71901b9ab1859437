//! The return map.

use super::kind::{Question, numbers};
use super::resources::Resources;
use crate::flow::Reason;
use crate::model::Parameters;
use crate::portrait::ReturnMap;
use crate::portrait::closing::return_map::return_map;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub parameters: Parameters,
    /// Smallest and largest displacement.
    pub range: (f64, f64),
}

impl Question for Inputs {
    type Found = ReturnMap;

    fn answer(&self, means: &Resources) -> Result<ReturnMap, Reason> {
        return_map(&self.parameters, self.range, means.fineness.map, means.limits)
    }

    fn numbers(&self) -> [f64; 8] {
        numbers(&self.parameters, [self.range.0, self.range.1, 0.0, 0.0])
    }
}
