//! Two workers and a writer of figures: one worker for what the next picture needs, one for what takes long.
//!
//! A scan of minutes must not come between a key and its picture. So long requests have a separate worker,
//! which continues while the other one answers. One figure at a time is computed and written on a thread of its
//! own.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use super::effects::Files;
use super::new_file::Readers;
use super::panics::{self, Notes};
use super::worker::{Compute, Report, TURN, Worker};
use crate::flow::Limits;
use crate::scene::Request;
use crate::session::{Msg, Notice};

/// Makes the content of a file, or says in one line why it cannot.
pub type Work = Box<dyn FnOnce(&Limits) -> Result<Vec<u8>, String> + Send>;

/// Both workers, used as one, and the writer of figures. Dropping it stops the figure in progress and waits for
/// its thread to end, so that no file is left incomplete.
pub struct Workers {
    quick: Worker,
    long: Worker,
    asked: Vec<Request>,
    report: Arc<Report>,
    notes: Notes,
    /// The thread that writes a figure, or has written the last one.
    figure: Option<JoinHandle<()>>,
    /// Set when the figure in progress is to be stopped.
    stop: Arc<AtomicBool>,
}

impl Workers {
    /// Starts the workers; see [`Worker::start`]. Each reports [`Msg::Idle`] separately; [`Workers::is_idle`]
    /// says whether both are idle. Fails if the system provides no threads.
    pub fn start(answer: Arc<Compute>, notes: Notes, report: Arc<Report>) -> io::Result<Workers> {
        let worker = |answer| Worker::start(TURN, answer, notes.clone(), Arc::clone(&report));
        let (quick, long) = (worker(Arc::clone(&answer))?, worker(answer)?);
        let (asked, stop) = (Vec::new(), Arc::default());
        Ok(Workers { quick, long, asked, report, notes, figure: None, stop })
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

    /// Whether nothing is in progress and nothing waits.
    pub fn is_idle(&self) -> bool {
        self.quick.is_idle() && self.long.is_idle()
    }

    /// Begins to write a figure; [`Msg::Written`] reports the result. Fails with one line if another one is being
    /// written, or the system provides no thread.
    pub fn write(&mut self, path: PathBuf, replace: bool, work: Work) -> Result<(), String> {
        let name = path.display().to_string();
        if self.is_writing() {
            return Err(format!("{name} not written: another file still is"));
        }
        self.stop = Arc::default();
        let (stop, report, notes) =
            (Arc::clone(&self.stop), Arc::clone(&self.report), self.notes.clone());
        let failed = format!("{name} not written");
        let writes = move || {
            let stopped = || stop.load(Ordering::Relaxed);
            let limits = Limits { interrupted: &stopped, ..Limits::PATIENT };
            let made = catch_unwind(AssertUnwindSafe(|| work(&limits)));
            report(Msg::Written(match made {
                _ if stopped() => {
                    Notice { error: false, text: format!("{name} not written: stopped") }
                }
                Ok(Ok(content)) => Files::write(&path, &content, replace, Readers::Usual),
                Ok(Err(text)) => Notice { error: true, text },
                Err(panic) => {
                    let why = notes.take().unwrap_or_else(|| panics::message(&*panic));
                    let text = format!("{name} not written: internal error: {why}");
                    Notice { error: true, text }
                }
            }));
        };
        let thread = thread::Builder::new().name("figures".to_owned()).spawn(writes);
        self.figure = Some(thread.map_err(|why| format!("{failed}: {why}"))?);
        Ok(())
    }

    /// Stops the figure in progress, if any; [`Msg::Written`] follows.
    pub fn stop_writing(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    fn is_writing(&self) -> bool {
        self.figure.as_ref().is_some_and(|thread| !thread.is_finished())
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        self.stop_writing();
        // The thread has already reported its result.
        drop(self.figure.take().map(JoinHandle::join));
    }
}

#[cfg(test)]
mod tests {
    use crossbeam_channel::{Receiver, bounded, unbounded};

    use super::*;
    use crate::flow::Reason;
    use crate::runtime::worker::Tell;

    fn workers() -> (Workers, Receiver<Msg>) {
        let (send, messages) = unbounded();
        let report = Arc::new(move |msg| drop(send.send(msg)));
        let nothing = Arc::new(|_: &Request, _: &Limits, _: &Tell| Err(Reason::OutOfRange));
        (Workers::start(nothing, Notes::default(), report).unwrap(), messages)
    }

    fn notice(messages: &Receiver<Msg>) -> Notice {
        match messages.recv().unwrap() {
            Msg::Written(notice) => notice,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_figure_that_cannot_be_made_leaves_its_file_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        std::fs::write(&path, b"curves").unwrap();
        for (work, why) in [
            (Box::new(|_: &Limits| Err("no curves".to_owned())) as Work, "no curves"),
            (Box::new(|_: &Limits| panic!("a defect")), "internal error: a defect"),
        ] {
            let (mut workers, messages) = workers();
            workers.write(path.clone(), true, work).unwrap();
            let told = notice(&messages);
            assert!(told.error && told.text.contains(why), "{told:?}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"curves");
    }

    #[test]
    fn a_figure_that_is_stopped_writes_nothing_and_one_is_written_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        let (mut workers, messages) = workers();
        let (start, started) = bounded(0);
        let endless = move |limits: &Limits| {
            start.send(()).unwrap();
            while !(limits.interrupted)() {
                thread::yield_now();
            }
            Ok(b"half of the curves".to_vec())
        };
        workers.write(path.clone(), false, Box::new(endless)).unwrap();
        started.recv().unwrap();
        let other = workers.write(folder.path().join("other.svg"), false, Box::new(|_| Ok(vec![])));
        assert!(other.unwrap_err().contains("other.svg not written: another"));
        workers.stop_writing();
        let told = notice(&messages);
        assert!(!told.error && told.text.contains("stopped"), "{told:?}");
        drop(workers);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
