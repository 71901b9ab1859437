//! The console of Windows, which termina reads and divides itself.

pub use std::os::windows::io::AsHandle as Keyboard;

use termina::{Event, PlatformTerminal, Terminal};

/// Reads until the input ends.
pub fn read(_: &impl Keyboard, send: impl FnMut(Event)) {
    let Ok(console) = PlatformTerminal::new() else { return };
    std::iter::from_fn(|| console.read(|_| true).ok()).for_each(send);
}
