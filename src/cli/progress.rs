//! How far a long command is, on the last line of the terminal.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use crate::words::number::remaining;

/// A line that says how many rows are done and how long the rest will take.
#[derive(Debug)]
pub struct Progress {
    wanted: usize,
    /// Rows that were there before.
    before: usize,
    done: usize,
    started: Instant,
    written: Option<Instant>,
    shown: bool,
}

/// How often the line is written again.
const EVERY: Duration = Duration::from_millis(250);

impl Progress {
    /// The progress of `wanted` rows that begin now, after `before` that are done; `shown` if somebody
    /// sees it.
    pub fn new(wanted: usize, before: usize, shown: bool) -> Self {
        Progress { wanted, before, done: 0, started: Instant::now(), written: None, shown }
    }

    /// One row more is done.
    pub fn step(&mut self) {
        self.done += 1;
        let now = Instant::now();
        let due = self.written.unwrap_or(self.started) + EVERY;
        if self.shown && now >= due {
            self.written = Some(now);
            let left = remaining((now - self.started).as_secs_f64(), self.done, self.wanted);
            let (done, all) = (self.before + self.done, self.before + self.wanted);
            write(&format!("\r{done} of {all} rows, {left} left\x1b[K"));
        }
    }

    /// Takes the line away.
    pub fn end(&self) {
        if self.written.is_some() {
            write("\r\x1b[K");
        }
    }
}

/// Who cannot see the progress misses nothing else.
fn write(text: &str) {
    let mut out = io::stderr().lock();
    drop(out.write_all(text.as_bytes()).and_then(|()| out.flush()));
}
