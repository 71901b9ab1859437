//! A press that waits for an answer.

use crate::scene::Request;
use crate::session::replay::script::Instruction;

/// A press that waits, and for which answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Waiting {
    pub step: Instruction,
    /// The question that must be answered first.
    pub request: Request,
}
