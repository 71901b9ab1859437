//! The keyboard: converts bytes from the terminal to events.
//!
//! A separate thread blocks in `read` and sends the events that it recognizes. It reads the terminal itself,
//! divides the bytes into sequences and hands each of them to termina's parser, because crossterm's reader keeps cursor position reports to itself,
//! leaves everything beyond 1,024 bytes unread until the next key (crossterm#1057), and spins when the terminal
//! hangs up (crossterm#793).

use std::io;
use std::os::fd::AsFd;
use std::thread;
use std::time::Duration;

use crossbeam_channel::Sender;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{Errno, retry_on_intr};
use termina::Parser;
use termina::escape::csi::{Csi, Cursor};
use termina::escape::osc::{ColorOrQuery, DynamicColorNumber, Osc};
use termina::event::{
    KeyCode, KeyEvent, KeyEventKind, Modifiers, MouseButton, MouseEvent, MouseEventKind,
};
use termina::style::RgbColor;

use super::panics::caught;
use super::{Event, LoopEnd};
use crate::session::{Code, Gesture, Key, Msg};

mod sequences;

use sequences::{Divider, Sequence};

/// Bytes per read.
const BUFFER: usize = 4096;

/// Starts the thread that reads the terminal at standard input until it is gone. Fails if the system provides
/// no thread.
pub fn start(events: Sender<Event>) -> io::Result<()> {
    thread::Builder::new()
        .name("input".to_owned())
        .spawn(move || listen(&io::stdin(), &events))
        .map(drop)
}

/// Sends what is read, and the end of the input however that comes: a program that cannot be quit by a key must
/// not continue.
fn listen(terminal: &impl AsFd, events: &Sender<Event>) {
    let read = caught(|| read(terminal, |event| drop(events.send(event))));
    drop(events.send(Event::End(read.map_or_else(LoopEnd::Broken, |()| LoopEnd::Closed))));
}

/// Reads until the input ends.
fn read(terminal: &impl AsFd, mut send: impl FnMut(Event)) {
    let mut divider = Divider::default();
    let mut buffer = [0; BUFFER];
    let mut send = |sequence: Sequence| event(sequence).into_iter().for_each(&mut send);
    loop {
        if divider.patience().is_some_and(|time| !more(terminal, Some(time))) {
            divider.pause(&mut send);
        }
        match rustix::io::read(terminal, &mut buffer) {
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
fn more(terminal: &impl AsFd, time: Option<Duration>) -> bool {
    let time = time.and_then(|time| Timespec::try_from(time).ok());
    let mut waiting = [PollFd::new(terminal, PollFlags::IN)];
    retry_on_intr(|| poll(&mut waiting, time.as_ref())).is_ok_and(|ready| ready > 0)
}

/// The event for a sequence; none for what is not understood or was not asked for.
fn event(sequence: Sequence) -> Option<Event> {
    match sequence {
        Sequence::Whole(bytes) => {
            let mut parser = Parser::default();
            parser.parse(&bytes, false);
            parser.pop().and_then(understood)
        }
        Sequence::Alt(byte) => {
            let key = Key { alt: true, ..Key::plain(Code::Char(byte.into())) };
            Some(Event::Session(Msg::Key(key)))
        }
        Sequence::Paste(bytes) => {
            let text = String::from_utf8_lossy(&bytes);
            let lines = text.replace("\r\n", "\n").replace('\r', "\n");
            Some(Event::Session(Msg::Paste(lines)))
        }
    }
}

/// The event for a parsed sequence; none for releases of keys and for anything that was not asked for.
fn understood(parsed: termina::Event) -> Option<Event> {
    match parsed {
        termina::Event::Key(pressed) => key(pressed).map(|key| Event::Session(Msg::Key(key))),
        termina::Event::Mouse(MouseEvent { kind, column, row, .. }) => {
            let gesture = match kind {
                MouseEventKind::Down(MouseButton::Left) => Gesture::Click,
                MouseEventKind::ScrollUp => Gesture::Nearer,
                MouseEventKind::ScrollDown => Gesture::Farther,
                _ => return None,
            };
            Some(Event::Mouse { gesture, column, row })
        }
        termina::Event::Csi(Csi::Cursor(Cursor::ActivePositionReport { .. })) => Some(Event::Shown),
        termina::Event::Osc(Osc::ChangeDynamicColors(
            DynamicColorNumber::TextBackgroundColor,
            colors,
        )) => colors.iter().find_map(|color| match color {
            ColorOrQuery::Color(color) => Some(Event::Background { is_light: is_light(*color) }),
            ColorOrQuery::Query => None,
        }),
        _ => None,
    }
}

/// Whether a colour is nearer to white than to black, by the weights of ITU-R BT.601.
fn is_light(RgbColor { red, green, blue }: RgbColor) -> bool {
    299 * u32::from(red) + 587 * u32::from(green) + 114 * u32::from(blue) > 127_500
}

fn key(event: KeyEvent) -> Option<Key> {
    let code = match event.code {
        KeyCode::Char(char) => Code::Char(char),
        KeyCode::Function(number @ 1..=12) => Code::F(number),
        KeyCode::Tab | KeyCode::BackTab => Code::Tab,
        KeyCode::Left => Code::Left,
        KeyCode::Right => Code::Right,
        KeyCode::Up => Code::Up,
        KeyCode::Down => Code::Down,
        KeyCode::Enter => Code::Enter,
        KeyCode::Escape => Code::Esc,
        KeyCode::Backspace => Code::Backspace,
        KeyCode::Delete => Code::Delete,
        KeyCode::Insert => Code::Insert,
        KeyCode::Home => Code::Home,
        KeyCode::End => Code::End,
        KeyCode::PageUp => Code::PageUp,
        KeyCode::PageDown => Code::PageDown,
        _ => return None,
    };
    let held = |modifier| event.modifiers.contains(modifier);
    let [control, alt, shift] = [Modifiers::CONTROL, Modifiers::ALT, Modifiers::SHIFT].map(held);
    (event.kind != KeyEventKind::Release).then(|| Key::new(code, control, alt, shift))
}

#[cfg(test)]
mod tests;
