//! A caller in this process: what it asks may be interrupted, and its answer is not printed.

use std::sync::{Mutex, PoisonError};

use crate::flow::Limits;
use crate::report::Answer;

/// Where a caller waits for an answer.
pub struct Call {
    interrupted: Box<dyn Fn() -> bool + Send + Sync>,
    answer: Mutex<Option<Answer>>,
}

impl Call {
    /// A call that ends when `interrupted` says so.
    pub fn new(interrupted: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Call { interrupted: Box::new(interrupted), answer: Mutex::default() }
    }

    /// What a question may cost.
    pub fn limits(&self) -> Limits<'_> {
        Limits { interrupted: &*self.interrupted, ..Limits::PATIENT }
    }

    /// Puts down what would be printed; returns what was there.
    pub fn replace(&self, answer: Option<Answer>) -> Option<Answer> {
        std::mem::replace(&mut *self.answer.lock().unwrap_or_else(PoisonError::into_inner), answer)
    }
}
