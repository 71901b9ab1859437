//! Answers, which become Python objects when somebody looks at them, and what is raised where there is none.

use std::sync::{Mutex, PoisonError};

use hopfscope::flow::Reason;
use hopfscope::runtime::Failure;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use serde_json::Value;

use crate::columns::object;

pyo3::import_exception!(hopfscope._answers, Error);
pyo3::import_exception!(hopfscope._answers, InputError);

/// What the program would say about a failure.
pub fn failed(failure: Failure) -> PyErr {
    match failure {
        Failure::Usage(line) => InputError::new_err(line),
        other => Error::new_err(other.to_string()),
    }
}

/// The same of a computation that has no answer.
pub fn unanswered(what: &str) -> impl Fn(Reason) -> PyErr {
    move |why| failed(Failure::unanswered(what, why))
}

/// Makes the document of an answer.
type Make = Box<dyn FnOnce() -> Value + Send>;

/// An answer of the library, whose document is made when it is asked for.
#[pyclass(frozen)]
pub struct Found {
    make: Mutex<Option<Make>>,
    made: PyOnceLock<Py<PyAny>>,
}

impl Found {
    pub fn new(make: impl FnOnce() -> Value + Send + 'static) -> Self {
        Found { make: Mutex::new(Some(Box::new(make))), made: PyOnceLock::new() }
    }
}

#[pymethods]
impl Found {
    /// The document, with arrays in place of lists.
    fn document(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let make = || {
            let make = self.make.lock().unwrap_or_else(PoisonError::into_inner).take();
            object(py, &make.map_or(Value::Null, |make| py.detach(make)))
        };
        self.made.get_or_try_init(py, make).map(|made| made.clone_ref(py))
    }
}
