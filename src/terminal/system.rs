//! What the system does with a terminal: raw mode, its output, its size. `windows/system.rs` is the same for Windows.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;

use crossterm::terminal::{disable_raw_mode, enable_raw_mode};
use ratatui::layout::Size;

/// Begins raw mode, in which keys arrive one by one and nothing is echoed; what it returns ends that. Fails if there is
/// no terminal.
pub fn raw_mode() -> io::Result<impl FnOnce() + Send> {
    enable_raw_mode().map(|()| || drop(disable_raw_mode()))
}

/// Standard output as a file. Fails if it is closed.
pub fn output() -> io::Result<File> {
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// Writes to standard output. Not by `io::Stdout`, which takes one that is not open for writing for success.
pub fn print(bytes: &[u8]) -> io::Result<()> {
    output()?.write_all(bytes)
}

/// The size of the terminal at standard output, zero if it reports none; `None` if the output goes elsewhere.
pub fn size() -> Option<Size> {
    let size = rustix::termios::tcgetwinsize(rustix::stdio::stdout()).ok()?;
    Some(Size { width: size.ws_col, height: size.ws_row })
}
