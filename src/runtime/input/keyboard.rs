//! Bytes of the terminal as they come, divided into sequences. `windows/keyboard.rs` is the same for Windows.

pub use std::os::fd::AsFd as Keyboard;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{self, Errno, retry_on_intr};
use termina::event::{KeyCode, KeyEvent, Modifiers};
use termina::{Event, Parser};

use super::sequences::{Divider, Sequence};

/// Bytes per read.
const BUFFER: usize = 4096;

/// Reads until the input ends.
pub fn read(terminal: &impl Keyboard, mut send: impl FnMut(Event)) {
    let mut divider = Divider::default();
    let mut buffer = [0; BUFFER];
    let mut send = |sequence: Sequence| parsed(sequence).into_iter().for_each(&mut send);
    loop {
        if divider.patience().is_some_and(|time| !more(terminal, Some(time))) {
            divider.pause(&mut send);
        }
        match io::read(terminal, &mut buffer) {
            Ok(0) => return,
            Ok(count) => divider.take(&buffer[..count], &mut send),
            // Another process made the terminal non-blocking.
            Err(Errno::AGAIN) if more(terminal, None) => {}
            Err(Errno::INTR) => {}
            Err(_) => return,
        }
    }
}

/// Whether there is something to read within this time; `None` waits forever.
fn more(terminal: &impl Keyboard, time: Option<Duration>) -> bool {
    let time = time.and_then(|time| Timespec::try_from(time).ok());
    let mut waiting = [PollFd::new(terminal, PollFlags::IN)];
    retry_on_intr(|| poll(&mut waiting, time.as_ref())).is_ok_and(|ready| ready > 0)
}

/// The event of a sequence; none for what is not understood.
pub fn parsed(sequence: Sequence) -> Option<Event> {
    match sequence {
        Sequence::Whole(bytes) => {
            let mut parser = Parser::default();
            parser.parse(&bytes, false);
            parser.pop()
        }
        Sequence::Alt(byte) => {
            Some(Event::Key(KeyEvent::new(KeyCode::Char(byte.into()), Modifiers::ALT)))
        }
        Sequence::Paste(bytes) => Some(Event::Paste(String::from_utf8_lossy(&bytes).into_owned())),
    }
}
