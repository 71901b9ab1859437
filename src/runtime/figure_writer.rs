//! Computes and writes one figure at a time on a separate thread, so that an expensive one does not delay the
//! keys.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use super::effects::Files;
use super::new_file::Readers;
use super::panics::{self, Notes};
use crate::flow::Limits;
use crate::session::{Msg, Notice};

/// Makes the content of a file, or says in one line why it cannot.
pub type Work = Box<dyn FnOnce(&Limits) -> Result<Vec<u8>, String> + Send>;

/// Called when a file was written or could not be.
pub type Report = Arc<dyn Fn(Msg) + Send + Sync>;

/// The handle of the thread. Dropping it stops the figure in progress and waits for the thread to end, so that
/// no file is left incomplete.
pub struct FigureWriter {
    report: Report,
    notes: Notes,
    task: Option<FigureTask>,
}

/// A file that is being written.
struct FigureTask {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl std::fmt::Debug for FigureWriter {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("FigureWriter")
            .field("writing", &self.is_writing())
            .finish_non_exhaustive()
    }
}

impl FigureWriter {
    /// A writer without work.
    pub fn new(report: Report, notes: Notes) -> FigureWriter {
        FigureWriter { report, notes, task: None }
    }

    /// Begins to write a file; [`Msg::Written`] reports the result. Fails with one line if another file is
    /// being written, or the system provides no thread.
    pub fn begin(&mut self, path: PathBuf, replace: bool, work: Work) -> Result<(), String> {
        if self.is_writing() {
            return Err(format!("{} not written: another file still is", path.display()));
        }
        let stop = Arc::new(AtomicBool::new(false));
        let (theirs, report, notes) =
            (Arc::clone(&stop), Arc::clone(&self.report), self.notes.clone());
        let failed = format!("{} not written", path.display());
        let writes = move || {
            let stopped = || theirs.load(Ordering::Relaxed);
            let limits = Limits { interrupted: &stopped, ..Limits::PATIENT };
            let name = path.display();
            let made = catch_unwind(AssertUnwindSafe(|| work(&limits)));
            report(Msg::Written(match made {
                _ if stopped() => {
                    Notice { error: false, text: format!("{name} not written: stopped") }
                }
                Ok(Ok(content)) => Files::write(&path, &content, replace, Readers::Usual),
                Ok(Err(text)) => Notice { error: true, text },
                Err(panic) => {
                    let why = notes.take().unwrap_or_else(|| panics::message(&*panic));
                    Notice {
                        error: true,
                        text: format!("{name} not written: internal error: {why}"),
                    }
                }
            }));
        };
        let thread = thread::Builder::new().name("figures".to_owned()).spawn(writes);
        let thread = thread.map_err(|why| format!("{failed}: {why}"))?;
        self.task = Some(FigureTask { stop, thread });
        Ok(())
    }

    /// Stops the figure in progress, if any; [`Msg::Written`] follows.
    pub fn stop(&self) {
        if let Some(task) = &self.task {
            task.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Whether a file is being written.
    pub fn is_writing(&self) -> bool {
        self.task.as_ref().is_some_and(|task| !task.thread.is_finished())
    }
}

impl Drop for FigureWriter {
    fn drop(&mut self) {
        self.stop();
        if let Some(task) = self.task.take() {
            // The thread has already reported its result.
            drop(task.thread.join());
        }
    }
}

#[cfg(test)]
mod tests {
    use crossbeam_channel::{Receiver, bounded, unbounded};

    use super::*;

    fn writer() -> (FigureWriter, Receiver<Msg>) {
        let (send, messages) = unbounded();
        (FigureWriter::new(Arc::new(move |msg| drop(send.send(msg))), Notes::default()), messages)
    }

    fn notice(messages: &Receiver<Msg>) -> Notice {
        match messages.recv().unwrap() {
            Msg::Written(notice) => notice,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn what_is_made_is_written_and_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        let (mut writer, messages) = writer();
        writer.begin(path.clone(), false, Box::new(|_| Ok(b"curves".to_vec()))).unwrap();
        let told = notice(&messages);
        assert!(!told.error && told.text.contains("written to"), "{told:?}");
        assert_eq!(std::fs::read(&path).unwrap(), b"curves");
        drop(writer);

        for (work, why) in [
            (Box::new(|_: &Limits| Err("no curves".to_owned())) as Work, "no curves"),
            (
                Box::new(|_: &Limits| -> Result<Vec<u8>, String> { panic!("a defect") }),
                "internal error: a defect",
            ),
        ] {
            let (mut writer, messages) = self::writer();
            writer.begin(path.clone(), true, work).unwrap();
            let told = notice(&messages);
            assert!(told.error && told.text.contains(why), "{told:?}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"curves", "left as it was");
    }

    #[test]
    fn what_is_stopped_writes_nothing_and_one_file_is_written_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("figure.svg");
        let (mut writer, messages) = writer();
        let (start, started) = bounded(0);
        let endless = move |limits: &Limits| {
            start.send(()).unwrap();
            while !(limits.interrupted)() {
                thread::yield_now();
            }
            Ok(b"half of the curves".to_vec())
        };
        writer.begin(path.clone(), false, Box::new(endless)).unwrap();
        started.recv().unwrap();
        assert!(writer.is_writing());
        let other = writer.begin(folder.path().join("other.svg"), false, Box::new(|_| Ok(vec![])));
        assert!(other.unwrap_err().contains("other.svg not written: another"));
        writer.stop();
        let told = notice(&messages);
        assert!(!told.error && told.text.contains("stopped"), "{told:?}");
        drop(writer);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
