//! The terminal modes that the explorer turns on, and that are turned off again in every case.
//!
//! One [`Guard`] knows whether the terminal is taken. [`Guard::enter`] turns on the modes of [`MODES`] in their
//! order. [`Guard::leave`] turns them off once, in reverse order, from any thread: at the end of the program,
//! in the panic hook, before the process is stopped, or when a signal ends it.

use std::fs::File;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::screen::{END, PLAIN};
use super::system;

/// The sequences that turn a mode on and off.
pub struct ScreenMode {
    pub on: &'static str,
    pub off: &'static str,
}

/// The modes of the explorer, in the order in which they are turned on.
pub const MODES: [ScreenMode; 3] = [
    // Alternate screen: what was on the terminal comes back at the end.
    ScreenMode { on: "\x1b[?1049h", off: "\x1b[?1049l" },
    // Bracketed paste: a paste arrives as one message, not as keys.
    ScreenMode { on: "\x1b[?2004h", off: "\x1b[?2004l" },
    // Hidden cursor.
    ScreenMode { on: "\x1b[?25l", off: "\x1b[?25h" },
];

/// The mode that only some users want: while it is off, the mouse selects text in the terminal. Clicks and the wheel are
/// reported, with decimal coordinates.
pub const MOUSE: ScreenMode =
    ScreenMode { on: "\x1b[?1000h\x1b[?1006h", off: "\x1b[?1006l\x1b[?1000l" };

/// The sequence that `enter` writes.
fn entering(mouse: bool) -> String {
    MODES.iter().chain(mouse.then_some(&MOUSE)).map(|mode| mode.on).collect()
}

/// The sequence that `leave` writes: ends an interrupted frame, resets the colours and turns off all modes.
fn leaving(mouse: bool) -> String {
    let off = MODES.iter().chain(mouse.then_some(&MOUSE)).rev().map(|mode| mode.off);
    [END, PLAIN].into_iter().chain(off).collect()
}

/// Whether the terminal is taken, and whether mouse reports are wanted.
#[derive(Default)]
struct GuardState {
    /// What ends raw mode; `None` if the terminal is not taken.
    taken: Option<Box<dyn FnOnce() + Send>>,
    mouse: bool,
}

/// The terminal, taken or not. Clones share that state.
#[derive(Clone)]
pub struct Guard {
    state: Arc<Mutex<GuardState>>,
    /// The terminal, to write frames to.
    pub out: Arc<File>,
}

impl Guard {
    /// A guard for the terminal at standard output, not yet taken. Fails if standard output is closed.
    pub fn new() -> io::Result<Guard> {
        Ok(Guard { state: Arc::default(), out: Arc::new(system::output()?) })
    }

    /// Takes the terminal: raw mode, then [`MODES`]. Does nothing if it is taken already. Fails if the terminal
    /// cannot be switched to raw mode or written to; the terminal is then as before.
    pub fn enter(&self) -> io::Result<()> {
        let mut state = self.state();
        if state.taken.is_some() {
            return Ok(());
        }
        state.taken = Some(Box::new(system::raw_mode()?));
        let written = self.write(&entering(state.mouse));
        drop(state);
        written.inspect_err(|_| self.leave())
    }

    /// Turns mouse reports on or off; if the terminal is not taken, this has effect once it is. Fails if the
    /// terminal cannot be written to.
    pub fn mouse(&self, on: bool) -> io::Result<()> {
        let mut state = self.state();
        if state.taken.is_some() && state.mouse != on {
            self.write(if on { MOUSE.on } else { MOUSE.off })?;
        }
        state.mouse = on;
        Ok(())
    }

    fn state(&self) -> MutexGuard<'_, GuardState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Gives the terminal back. Does nothing if it is not taken. Errors are ignored, because there is nobody to
    /// report them to.
    pub fn leave(&self) {
        self.restore(|sequence| drop(self.write(sequence)));
    }

    /// Gives the terminal back without ever waiting for it: if the terminal accepts no more output, it keeps
    /// its modes, but raw mode ends.
    pub fn leave_at_once(&self, accepts: impl FnOnce(&File) -> bool) {
        self.restore(|sequence| {
            if accepts(&self.out) {
                drop(self.write(sequence));
            }
        });
    }

    fn restore(&self, write: impl FnOnce(&str)) {
        let mut state = self.state();
        if let Some(end) = state.taken.take() {
            write(&leaving(state.mouse));
            end();
        }
    }

    fn write(&self, sequence: &str) -> io::Result<()> {
        (&*self.out).write_all(sequence.as_bytes())
    }
}

impl Drop for Guard {
    /// The last clone gives the terminal back, in case nobody has done so.
    fn drop(&mut self) {
        if Arc::strong_count(&self.state) == 1 {
            self.leave();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaving_undoes_entering_in_reverse_order() {
        for mouse in [false, true] {
            let (entering, leaving) = (entering(mouse), leaving(mouse));
            let switched: Vec<&str> = entering.split('\x1b').skip(1).collect();
            let undone: Vec<&str> = leaving.split('\x1b').skip(3).collect();
            assert_eq!(switched.len(), MODES.len() + if mouse { 2 } else { 0 });
            for (on, off) in switched.iter().zip(undone.iter().rev()) {
                assert_eq!(on[..on.len() - 1], off[..off.len() - 1], "{entering:?} {leaving:?}");
                assert_ne!(on, off);
            }
            assert!(leaving.starts_with("\x1b[?2026l\x1b[m"));
        }
    }
}
