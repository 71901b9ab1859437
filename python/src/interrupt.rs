//! Ctrl-C while the library computes without Python's lock.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use hopfscope::flow::Limits;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// How often Python is asked for signals.
const EVERY: Duration = Duration::from_millis(20);

/// Stack of a thread that computes, as large as that of a program's first thread.
const STACK: usize = 8 << 20;

/// When Python was last asked, and the exception that it then raised.
struct Heard {
    asked: Instant,
    raised: Option<PyErr>,
}

/// What `compute` returns within the limits of a question, on this thread, unless a signal raises an exception.
pub fn hearing<T: Send>(py: Python<'_>, compute: impl FnOnce(&Limits) -> T + Send) -> PyResult<T> {
    let owner = thread::current().id();
    let heard = Mutex::new(Heard { asked: Instant::now(), raised: None });
    let interrupted = || is_interrupted(owner, &heard);
    let limits = Limits { interrupted: &interrupted, ..Limits::PATIENT };
    let computed = py.detach(|| compute(&limits));
    let heard = heard.into_inner().unwrap_or_else(PoisonError::into_inner);
    heard.raised.map_or(Ok(computed), Err)
}

/// Whether a signal has raised an exception; only the thread that Python runs on can ask.
#[expect(
    clippy::redundant_closure_for_method_calls,
    reason = "the method itself is of one lifetime"
)]
fn is_interrupted(owner: ThreadId, heard: &Mutex<Heard>) -> bool {
    let mut heard = heard.lock().unwrap_or_else(PoisonError::into_inner);
    if heard.raised.is_none() && heard.asked.elapsed() > EVERY && thread::current().id() == owner {
        heard.raised = Python::attach(|py| py.check_signals()).err();
        heard.asked = Instant::now();
    }
    heard.raised.is_some()
}

/// What `compute` returns on all cores, while this thread listens; it is told to stop, and left alone, when a signal
/// raises an exception.
pub fn on_all_cores<T: Send + 'static>(
    py: Python<'_>,
    compute: impl FnOnce(Arc<AtomicBool>) -> T + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let (told, (done, mut found)) = (Arc::clone(&stop), channel());
    pool()?.spawn(move || drop(done.send(compute(told))));
    loop {
        let waiting = &mut found;
        match py.detach(move || waiting.recv_timeout(EVERY)) {
            Ok(computed) => return Ok(computed),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                stop.store(true, Ordering::Relaxed);
            })?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("internal error: a computation panicked"));
            }
        }
    }
}

/// The threads of this process, which a process that was forked has not inherited.
fn pool() -> PyResult<Arc<ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let (mut held, own) = (POOL.lock().unwrap_or_else(PoisonError::into_inner), std::process::id());
    if let Some((_, pool)) = held.as_ref().filter(|(process, _)| *process == own) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new().stack_size(STACK).panic_handler(|_| {}).build();
    let pool = Arc::new(pool.map_err(|why| PyRuntimeError::new_err(why.to_string()))?);
    // Threads that a fork has left behind can not be joined: the pool that names them is never dropped.
    std::mem::forget(held.replace((own, Arc::clone(&pool))));
    Ok(pool)
}
