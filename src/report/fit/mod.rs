//! What a recorded motion says: as a table to read, a document and rows.

mod document;
mod table;

pub use document::{csv, json};
pub use table::table;
