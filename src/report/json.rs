//! JSON documents: numbers in shortest round-trip form, `null` where a value does not exist.

use serde::Serialize;

use crate::flow::Cost;

/// What an answer cost, counted and timed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CountedCost {
    #[serde(flatten)]
    pub counted: Cost,
    /// Wall-clock seconds inside the process.
    pub seconds: f64,
}

/// What an answer cost that has nothing to count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Seconds {
    /// Wall-clock seconds inside the process.
    pub seconds: f64,
}

/// A document and a newline.
///
/// # Panics
/// Never: strings, numbers and structs of them have no way to fail, and keys are strings.
pub fn text(document: &impl Serialize) -> String {
    match serde_json::to_string(document) {
        Ok(text) => text + "\n",
        Err(error) => unreachable!("a document cannot be written: {error}"),
    }
}
