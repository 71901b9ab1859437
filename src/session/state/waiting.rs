//! A press that waits for an answer.

use crate::scene::Request;
use crate::session::replay::script::Instruction;

/// A press that waits, and the request whose answer it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Waiting {
    pub step: Instruction,
    /// The request that must be answered first.
    pub request: Request,
}
