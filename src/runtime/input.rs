//! The keyboard: converts bytes from the terminal to events.
//!
//! A separate thread blocks in `read` and sends the events that it recognizes. It reads the terminal itself,
//! divides the bytes into sequences and hands each of them to termina's parser, because crossterm's reader keeps cursor position reports to itself,
//! leaves everything beyond 1,024 bytes unread until the next key (crossterm#1057), and spins when the terminal
//! hangs up (crossterm#793).

use std::io;
use std::thread;

use crossbeam_channel::Sender;
use termina::escape::csi::{Csi, Cursor};
use termina::escape::osc::{ColorOrQuery, DynamicColorNumber, Osc};
use termina::event::{
    KeyCode, KeyEvent, KeyEventKind, Modifiers, MouseButton, MouseEvent, MouseEventKind,
};
use termina::style::RgbColor;

use super::panics::caught;
use super::{Event, LoopEnd};
use crate::session::{Code, Gesture, Key, Msg};

#[cfg_attr(windows, path = "windows/keyboard.rs")]
mod keyboard;
#[cfg(unix)]
mod sequences;

use keyboard::{Keyboard, read};

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
fn listen(terminal: &impl Keyboard, events: &Sender<Event>) {
    let send = |parsed| understood(parsed).into_iter().for_each(|it| drop(events.send(it)));
    let read = caught(|| read(terminal, send));
    drop(events.send(Event::End(read.map_or_else(LoopEnd::Broken, |()| LoopEnd::Closed))));
}

/// The event for a parsed sequence; none for releases of keys and for anything that was not asked for.
fn understood(parsed: termina::Event) -> Option<Event> {
    match parsed {
        termina::Event::Paste(text) => {
            let lines = text.replace("\r\n", "\n").replace('\r', "\n");
            Some(Event::Session(Msg::Paste(lines)))
        }
        // Elsewhere than on Windows a signal tells this.
        termina::Event::WindowResized(_) => Some(Event::Resized),
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
