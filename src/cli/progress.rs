//! The progress of a long command, on the last line of the terminal or in a log.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use crate::numerics::real;
use crate::words::{remaining, significant};

/// Where progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outlet {
    /// Not at all.
    Nowhere,
    /// On a line of the terminal that is rewritten.
    Line,
    /// As lines of a log.
    Log,
}

/// A message that is rewritten from time to time.
pub struct StatusLine {
    place: Outlet,
    started: Instant,
    written: Option<Instant>,
}

impl StatusLine {
    /// A line on which nothing has been written.
    pub fn new(place: Outlet) -> Self {
        StatusLine { place, started: Instant::now(), written: None }
    }

    /// Writes the message if it is due; `message` makes it from the seconds since the start.
    pub fn renew(&mut self, message: impl FnOnce(f64) -> String) {
        // A log has fewer messages than a line that is rewritten.
        let pause = Duration::from_millis(if self.place == Outlet::Line { 250 } else { 10_000 });
        let now = Instant::now();
        if now < self.written.unwrap_or(self.started) + pause {
            return;
        }
        let message = message((now - self.started).as_secs_f64());
        match self.place {
            Outlet::Nowhere => return,
            Outlet::Line => write(&format!("\r{message}\x1b[K")),
            Outlet::Log => write(&format!("hopfscope: {message}\n")),
        }
        self.written = Some(now);
    }

    /// Removes the line.
    pub fn end(&self) {
        if self.written.is_some() && self.place == Outlet::Line {
            write("\r\x1b[K");
        }
    }
}

/// The message after this many seconds, in which `done` of the `wanted` rows were computed: how many are done, how fast,
/// and how long the rest will take; `before` that, others had been computed.
pub fn message(done: usize, before: usize, wanted: usize, seconds: f64) -> String {
    let rate = significant(real(done) / seconds, 2);
    let left = remaining(seconds, done, wanted);
    let (done, all) = (before + done, before + wanted);
    format!("{done} of {all} rows, {rate} rows a second, {left} left")
}

/// Errors are ignored: only the progress is lost.
fn write(text: &str) {
    let mut out = io::stderr().lock();
    drop(out.write_all(text.as_bytes()).and_then(|()| out.flush()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_were_there_count_as_done_but_not_as_fast() {
        assert_eq!(message(300, 100, 900, 10.0), "400 of 1000 rows, 30 rows a second, 20 s left");
    }
}
