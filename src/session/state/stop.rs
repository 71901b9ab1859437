//! A point of a branch where a walk can stop.

use crate::branch::{BranchPoint, Special, SpecialKind};
use crate::portrait::Cycle;

/// A point of a branch where a walk can stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchStop {
    /// Index of the variant whose branch this is, if a diagram shows several.
    pub variant: usize,
    /// Value of the branch's parameter.
    pub value: f64,
    /// The cycle there; `None` where its amplitude is infinite.
    pub cycle: Option<Cycle>,
    /// The kind of special point, if it is one.
    pub special: Option<SpecialKind>,
}

impl BranchStop {
    pub fn on(variant: usize, point: &BranchPoint) -> Self {
        BranchStop { variant, value: point.value, cycle: Some(point.cycle), special: None }
    }

    /// A special point of the branch of a variant.
    pub fn at(variant: usize, point: &Special) -> Self {
        BranchStop { variant, value: point.value, cycle: point.cycle, special: Some(point.kind) }
    }
}
