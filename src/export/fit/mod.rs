//! What a recorded motion says: as a table to read, a document, rows, and pictures.

mod damping;
mod document;
mod physical;
mod pictures;
mod pieces;
mod table;
mod words;

pub use document::{csv, json};
pub use physical::{Inertia, LENGTHS, length_in_metres};
pub use pictures::figure;
pub use table::table;

use crate::fit::{Estimate, Margins, Record};

/// A fit with everything that is said about it.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The name of the file.
    pub name: String,
    /// What was read.
    pub record: Record,
    /// What was estimated.
    pub estimate: Estimate,
    /// The distribution of the margin.
    pub margins: Margins,
    /// Mass or stiffness, if known, and the unit of the displacements in m.
    pub inertia: Option<(Inertia, f64)>,
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl Fitted {
    /// The unit of the displacements as it is written behind numbers.
    fn unit(&self) -> &str {
        self.record.unit.as_deref().unwrap_or("")
    }
}
