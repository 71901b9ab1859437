//! Standard output and standard error.

use std::fmt::Display;
use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;

/// Prints a part of the answer at once. Fails if it cannot be written.
pub fn print(text: &str) -> io::Result<()> {
    if text.is_empty() {
        return Ok(());
    }
    // Not by `io::Stdout`, which takes one that is not open for writing for success.
    File::from(io::stdout().as_fd().try_clone_to_owned()?).write_all(text.as_bytes())
}

/// Tells the user a line. If that fails, nobody can be told: the exit code has to say it.
pub fn tell(line: impl Display) {
    drop(io::stderr().write_all(format!("hopfscope: {line}\n").as_bytes()));
}
