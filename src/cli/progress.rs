//! How far a long command is, on the last line of the terminal or in a log.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use crate::words::number::{remaining, significant};

/// Where progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outlet {
    /// Nobody wants to know.
    Nowhere,
    /// A line of the terminal that is written again and again.
    Line,
    /// Line after line of a log.
    Log,
}

impl Outlet {
    /// How often it is told.
    fn pause(self) -> Duration {
        match self {
            Outlet::Line => Duration::from_millis(250),
            Outlet::Nowhere | Outlet::Log => Duration::from_secs(10),
        }
    }
}

/// Says how many rows are done, how fast, and how long the rest will take.
#[derive(Debug)]
pub struct Progress {
    wanted: usize,
    /// Rows that were there before.
    before: usize,
    done: usize,
    started: Instant,
    written: Option<Instant>,
    place: Outlet,
}

impl Progress {
    /// The progress of `wanted` rows that begin now, after `before` that are done.
    pub fn new(wanted: usize, before: usize, place: Outlet) -> Self {
        Progress { wanted, before, done: 0, started: Instant::now(), written: None, place }
    }

    /// One row more is done.
    pub fn step(&mut self) {
        self.done += 1;
        let now = Instant::now();
        if now < self.written.unwrap_or(self.started) + self.place.pause() {
            return;
        }
        let told = self.told((now - self.started).as_secs_f64());
        match self.place {
            Outlet::Nowhere => return,
            Outlet::Line => write(&format!("\r{told}\x1b[K")),
            Outlet::Log => write(&format!("hopfscope: {told}\n")),
        }
        self.written = Some(now);
    }

    /// What is told after so many seconds.
    fn told(&self, seconds: f64) -> String {
        #[expect(clippy::cast_precision_loss, reason = "a rough number")]
        let rate = significant(self.done as f64 / seconds, 2);
        let left = remaining(seconds, self.done, self.wanted);
        let (done, all) = (self.before + self.done, self.before + self.wanted);
        format!("{done} of {all} rows, {rate} rows a second, {left} left")
    }

    /// Takes the line away.
    pub fn end(&self) {
        if self.written.is_some() && self.place == Outlet::Line {
            write("\r\x1b[K");
        }
    }
}

/// Who cannot see the progress misses nothing else.
fn write(text: &str) {
    let mut out = io::stderr().lock();
    drop(out.write_all(text.as_bytes()).and_then(|()| out.flush()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_were_there_count_as_done_but_not_as_fast() {
        let progress = Progress { done: 300, ..Progress::new(900, 100, Outlet::Log) };
        assert_eq!(progress.told(10.0), "400 of 1000 rows, 30 rows a second, 20 s left");
    }
}
