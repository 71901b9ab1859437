//! A point of a branch where a walk can stop.

use crate::study::{BranchPoint, Cycle, Special, SpecialKind};

/// A point of a branch where a walk can stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchStop {
    /// Whose branch it is, of several that a diagram shows.
    pub variant: usize,
    /// Value of the branch's parameter.
    pub value: f64,
    /// The cycle there; `None` where it has gone to infinity.
    pub cycle: Option<Cycle>,
    /// What is special about the point, if anything is.
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
