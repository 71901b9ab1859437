//! The results of fitting a recorded motion, as a table, a document, rows and a page.

mod document;
mod page;
mod table;

pub use document::{csv, json};
pub use page::page;
pub use table::table;
