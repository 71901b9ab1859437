//! JSON documents: numbers in the shortest form that reads back exactly, `null` for a value that does not exist;
//! what is not printable is escaped.

use serde::Serialize;

use crate::flow::Cost;
use crate::words::printable;

/// The cost of an answer, counted and timed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CountedCost {
    #[serde(flatten)]
    pub counted: Cost,
    /// Wall-clock seconds inside the process.
    pub seconds: f64,
}

/// The cost of an answer in time alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Seconds {
    /// Wall-clock seconds inside the process.
    pub seconds: f64,
}

/// The document on one line, with a newline.
///
/// # Panics
/// Never: strings, numbers and structs of them can always be written, and keys are strings.
pub fn text(document: &impl Serialize) -> String {
    match serde_json::to_string(document) {
        Ok(text) => printable::json(&text).into_owned() + "\n",
        Err(error) => unreachable!("a document cannot be written: {error}"),
    }
}
