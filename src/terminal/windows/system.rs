//! The terminal of Windows: a console that takes UTF-8 and control sequences while it is in raw mode.

use std::fs::File;
use std::io::{self, IsTerminal, Write};
use std::os::windows::io::AsHandle;

use ratatui::layout::Size;
use termina::{PlatformTerminal, Terminal};

/// Begins raw mode, UTF-8 and control sequences; what it returns ends that. Fails if there is no console.
pub fn raw_mode() -> io::Result<impl FnOnce() + Send> {
    let mut console = PlatformTerminal::new()?;
    console.enter_raw_mode().map(|()| || drop(console))
}

/// Standard output as a file. Fails if it is closed.
pub fn output() -> io::Result<File> {
    Ok(File::from(io::stdout().as_handle().try_clone_to_owned()?))
}

/// Writes to standard output, which translates for a console outside raw mode.
pub fn print(bytes: &[u8]) -> io::Result<()> {
    io::stdout().write_all(bytes)
}

pub fn size() -> Option<Size> {
    let (width, height) = crossterm::terminal::size().ok()?;
    io::stdout().is_terminal().then_some(Size { width, height })
}
