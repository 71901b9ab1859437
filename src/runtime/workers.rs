//! Two workers and a writer of figures: one worker for what the next picture needs, one for what takes long.
//!
//! A scan of minutes must not come between a key and its picture. So long requests have a separate worker,
//! which continues while the other one answers.

use std::path::PathBuf;
use std::sync::Arc;

use super::figure_writer::{FigureWriter, Work};
use super::panics::Notes;
use super::worker::{Tell, Worker};
use crate::flow::{Limits, Reason};
use crate::scene::{Answer, Request};
use crate::session::Msg;

/// Both workers, used as one, and the writer of figures.
#[derive(Debug)]
pub struct Workers {
    quick: Worker,
    long: Worker,
    asked: Vec<Request>,
    figures: FigureWriter,
}

impl Workers {
    /// Starts the workers; see [`Worker::start`]. Each reports [`Msg::Idle`] separately; [`Workers::is_idle`]
    /// says whether both are idle. Fails if the system provides no threads.
    pub fn start(
        answer: impl Fn(&Request, &Limits, &Tell) -> Result<Answer, Reason> + Send + Sync + 'static,
        notes: Notes,
        report: impl Fn(Msg) + Clone + Send + Sync + 'static,
    ) -> std::io::Result<Workers> {
        let answer = Arc::new(answer);
        let other = Arc::clone(&answer);
        let quick =
            move |request: &Request, limits: &Limits, tell: &Tell| answer(request, limits, tell);
        let long =
            move |request: &Request, limits: &Limits, tell: &Tell| other(request, limits, tell);
        Ok(Workers {
            asked: Vec::new(),
            figures: FigureWriter::new(Arc::new(report.clone()), notes.clone()),
            quick: Worker::start(quick, notes.clone(), report.clone())?,
            long: Worker::start(long, notes, report)?,
        })
    }

    /// Sets the requests that are wanted now and not answered yet, the most urgent first.
    pub fn ask(&mut self, wanted: Vec<Request>) {
        if wanted == self.asked {
            return;
        }
        self.asked.clone_from(&wanted);
        let (long, quick) = wanted.into_iter().partition(Request::is_long);
        self.quick.submit(quick);
        self.long.submit(long);
    }

    /// The requests asked last that are not answered yet.
    pub fn asked(&self) -> &[Request] {
        &self.asked
    }

    /// Notes a message that has arrived at the session: the request that it answers completely is no longer
    /// asked.
    pub fn arrived(&mut self, msg: &Msg) {
        if let Msg::Answered(answered) = msg
            && answered.complete
        {
            let request = &answered.request;
            let worker = if request.is_long() { &self.long } else { &self.quick };
            worker.taken(request);
            self.asked.retain(|asked| asked != request);
        }
    }

    /// Begins to write a figure; see [`FigureWriter::begin`]. Fails with one line that says why it cannot.
    pub fn write(&mut self, path: PathBuf, replace: bool, work: Work) -> Result<(), String> {
        self.figures.begin(path, replace, work)
    }

    /// Stops the figure in progress.
    pub fn stop_writing(&self) {
        self.figures.stop();
    }

    /// Whether nothing is in progress and nothing waits.
    pub fn is_idle(&self) -> bool {
        self.quick.is_idle() && self.long.is_idle()
    }
}
