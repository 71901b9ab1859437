//! Answers as the worker returns them.

use super::request::{Answer, Request};
use crate::flow::Reason;

/// An answer with its question and its computing time, as the worker returns it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// The question.
    pub request: Request,
    /// The answer, or why there is none.
    pub result: Result<Answer, NoAnswer>,
    /// Wall-clock seconds taken so far.
    pub seconds: f64,
    /// Whether the answer is final; a long question is answered in pieces.
    pub complete: bool,
}

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum NoAnswer {
    /// The computation gave up.
    Reason(Reason),
    /// The computation panicked with this message: a defect of the program.
    Panic(String),
}

impl std::fmt::Display for NoAnswer {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoAnswer::Reason(reason) => write!(out, "{reason}"),
            NoAnswer::Panic(message) => write!(out, "internal error: {message}"),
        }
    }
}
