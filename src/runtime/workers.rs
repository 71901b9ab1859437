//! The computations in progress: a thread for each request that is wanted now, and one that writes a figure.
//!
//! [`Workers::ask`] replaces the set of wanted requests. A job whose request is no longer among them is told to
//! stop, notices that at its next step, and tells nothing any more. The system divides the processors among the
//! threads, so that neither a scan of minutes nor a slow layer comes between a key and its picture. A request that
//! merely refines a draft begins when the draft is there. A long job reports its results in pieces: each is reported at
//! once, with `complete: false`, and only the last one completes the answer. An answer on its way is not computed
//! again: its job counts as in progress until [`Workers::arrived`] says that the session has it. A request that panics
//! becomes a [`NoAnswer::Panic`].

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Instant;

use super::panics::caught;
use super::{Files, Readers};
use crate::flow::{Limits, Reason, Result};
use crate::question::NoAnswer;
use crate::scene::{Finding, Reply, Request};
use crate::session::Msg;

/// Called by a job with its results so far; its return value is the last piece.
pub type Tell<'a> = dyn Fn(Finding) + 'a;

/// Computes the answer to a request.
pub type Compute = dyn Fn(&Request, &Limits, &Tell) -> Result<Finding> + Send + Sync;

/// Takes the messages for the session.
pub type Report = dyn Fn(Msg) + Send + Sync;

/// Makes files, or says in one line why it cannot.
pub type Work = Box<dyn FnOnce(&Limits) -> Result<Vec<(PathBuf, Vec<u8>)>, String> + Send>;

/// The jobs in progress. Dropping it stops them, and waits for the end of the figure that is being written, so that no
/// file is left incomplete.
pub struct Workers {
    answer: Arc<Compute>,
    report: Arc<Report>,
    jobs: Vec<Job>,
    /// The thread that writes a figure, or has written the last one, unless it is to stop.
    figure: Option<Stop>,
    writer: Option<JoinHandle<()>>,
}

/// A request in progress.
struct Job {
    request: Request,
    _stop: Stop,
}

/// Tells a thread to stop once it is dropped.
#[derive(Default)]
struct Stop(Arc<AtomicBool>);

impl Drop for Stop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Starts a thread, whose limits say when the returned [`Stop`] was dropped.
fn start(
    name: &str,
    work: impl FnOnce(&Limits) + Send + 'static,
) -> io::Result<(Stop, JoinHandle<()>)> {
    let stop = Stop::default();
    let is_over = Arc::clone(&stop.0);
    let thread = thread::Builder::new().name(name.to_owned()).spawn(move || {
        let interrupted = || is_over.load(Ordering::Relaxed);
        work(&Limits { interrupted: &interrupted, ..Limits::PATIENT });
    })?;
    Ok((stop, thread))
}

impl Workers {
    /// No job yet. `answer` computes; `report` gets a message for every answer that is still wanted.
    pub fn new(answer: Arc<Compute>, report: Arc<Report>) -> Workers {
        Workers { answer, report, jobs: Vec::new(), figure: None, writer: None }
    }

    /// Sets the requests that are wanted now and not answered yet.
    pub fn ask(&mut self, wanted: &[Request]) {
        self.jobs.retain(|job| wanted.contains(&job.request));
        for request in wanted {
            let refines = request.draft().is_some_and(|draft| wanted.contains(&draft));
            if !refines && self.asked().all(|asked| asked != request) {
                self.begin(request.clone());
            }
        }
    }

    /// Begins to compute an answer. Where the system provides no thread, that is the answer.
    fn begin(&mut self, request: Request) {
        let (answer, report) = (Arc::clone(&self.answer), Arc::clone(&self.report));
        let asked = request.clone();
        let begun = start("worker", move |limits| {
            let started = Instant::now();
            let tell = |result, complete| {
                if !(limits.interrupted)() {
                    let (request, seconds) = (asked.clone(), started.elapsed().as_secs_f64());
                    let reply = Reply { request, result, seconds, complete };
                    report(Msg::Answered(Box::new(reply)));
                }
            };
            let piece = |piece| tell(Ok(piece), false);
            let found = caught(|| answer(&asked, limits, &piece));
            let found = found.map_err(NoAnswer::Panic);
            tell(found.and_then(|found| found.map_err(NoAnswer::Reason)), true);
        });
        if let Ok((stop, _)) = begun {
            self.jobs.push(Job { request, _stop: stop });
        } else {
            let why = Reason::NotApplicable { needs: "a thread, and the system gives none" };
            (self.report)(Msg::answered(request, Err(NoAnswer::Reason(why)), 0.0));
        }
    }

    /// The requests in progress, and those whose answers are on their way.
    pub fn asked(&self) -> impl Iterator<Item = &Request> {
        self.jobs.iter().map(|job| &job.request)
    }

    /// Notes a message that has arrived at the session: the request that it answers completely is no longer
    /// asked.
    pub fn arrived(&mut self, msg: &Msg) {
        if let Msg::Answered(reply) = msg
            && reply.complete
        {
            self.jobs.retain(|job| job.request != reply.request);
        }
        // The thread has no more to do, whether it has ended already or not.
        if let Msg::Written(_) = msg {
            self.writer = None;
        }
    }

    /// Begins to make and write files, the first of which is this one; [`Msg::Written`] reports the result. Fails with one
    /// line if others are being written, or the system provides no thread.
    pub fn write(&mut self, path: &Path, replace: bool, work: Work) -> Result<(), String> {
        let failed = format!("{} not written", path.display());
        if self.writer.as_ref().is_some_and(|thread| !thread.is_finished()) {
            return Err(format!("{failed}: another file is still being written"));
        }
        let (report, told) = (Arc::clone(&self.report), failed.clone());
        let begun = start("figures", move |limits| {
            let write = |(path, content): (PathBuf, Vec<u8>)| {
                Files::write(&path, content, replace, Readers::Usual)
            };
            let made = caught(|| work(limits));
            let written = match made {
                _ if (limits.interrupted)() => Ok(format!("{told}: stopped")),
                Ok(made) => made.and_then(|files| {
                    let lines: Result<Vec<_>, _> = files.into_iter().map(write).collect();
                    Ok(lines?.join(", "))
                }),
                Err(why) => Err(format!("{told}: internal error: {why}")),
            };
            report(Msg::Written(written.into()));
        });
        let (stop, thread) = begun.map_err(|why| format!("{failed}: {why}"))?;
        (self.figure, self.writer) = (Some(stop), Some(thread));
        Ok(())
    }

    /// Stops the figure in progress, if any; [`Msg::Written`] follows.
    pub fn stop_writing(&mut self) {
        self.figure = None;
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        self.stop_writing();
        // The thread has already reported its result.
        drop(self.writer.take().map(JoinHandle::join));
    }
}

#[cfg(test)]
mod tests;
