//! The results of fitting a recorded motion, as a table, a document and rows.

mod document;
mod table;

pub use document::{csv, json};
pub use table::table;
