//! The rows of a scan that are still missing.

use std::sync::Arc;

use super::kind::Question;
use super::resources::{Resources, Rows};
use crate::flow::Reason;
use crate::scan::grid::Scan;

#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    pub scan: Arc<Scan>,
    /// Index of the first point wanted.
    pub from: usize,
}

impl Question for Inputs {
    type Found = Rows;

    fn answer(&self, means: &Resources) -> Result<Rows, Reason> {
        (means.rows)(&self.scan, self.from)
    }
}
