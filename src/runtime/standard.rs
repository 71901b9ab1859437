//! Standard output and standard error.

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::terminal::system;
use crate::words::printable;

/// Whether standard output was closed when the process began. The runtime of the language has put /dev/null in
/// its place before `main`, so only the program itself can know.
pub static CLOSED: AtomicBool = AtomicBool::new(false);

/// Prints a part of the answer at once, in printable characters. Fails if it cannot be written.
pub fn print(text: &str) -> io::Result<()> {
    if text.is_empty() {
        return Ok(());
    }
    if CLOSED.load(Ordering::Relaxed) {
        return Err(io::Error::other("it is closed"));
    }
    system::print(printable::lines(text).as_bytes())
}

/// Tells the user a line, in printable characters. If that fails, nobody can be told: the exit code has to say it.
pub fn tell(line: impl Display) {
    let line = format!("hopfscope: {line}");
    drop(io::stderr().write_all(format!("{}\n", printable::line(&line)).as_bytes()));
}
