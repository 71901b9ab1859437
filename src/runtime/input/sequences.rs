//! Divides the bytes of the terminal into what termina's parser understands: keys, reports, pastes.
//!
//! Some keys begin like a longer sequence: Esc, and Alt with `[`, `]`, `P` or `O`. Only time tells them apart,
//! so a sequence whose end does not come is given up: after [`ESCAPE_TIME`] it is the keys that a person can
//! have pressed, or nothing where it has parameters, which only a machine writes that fast.
//!
//! Over a slow line a pause can also cut a reply of the terminal in two. What a pause has cut off is therefore
//! remembered: what arrives next at once, several bytes long, and continues a reply of the terminal belongs to
//! it. A single byte is a key, unless it ends such a reply.

use std::time::Duration;

use termina::event::{KeyCode, KeyEvent, Modifiers};
use termina::{Event, Parser};

/// How long an unfinished sequence may wait for its rest: over a slow line, `ESC` and `[A` can arrive separately
/// (crossterm#993).
pub const ESCAPE_TIME: Duration = Duration::from_millis(50);

/// How long an unfinished paste may wait for its rest, which over a slow line takes longer than a key.
const PASTE_TIME: Duration = Duration::from_secs(1);

/// The byte that Ctrl-C sends; typed by a person, it arrives in a separate read.
const INTERRUPT: &[u8] = b"\x03";

const PASTE_BEGIN: &[u8] = b"\x1b[200~";

const ESCAPE: u8 = 0x1b;
const BELL: u8 = 0x07;

/// The bytes that wait for their rest.
#[derive(Debug, Default)]
pub struct Divider {
    parser: Parser,
    /// What the parser has got since the last event: the beginning of a sequence, or what it has refused.
    open: Vec<u8>,
    /// What a pause has cut off.
    cut: Vec<u8>,
}

impl Divider {
    /// How long to wait for the rest of what has arrived; `None` if nothing is unfinished.
    pub fn patience(&self) -> Option<Duration> {
        let time = if self.open.starts_with(PASTE_BEGIN) { PASTE_TIME } else { ESCAPE_TIME };
        (!self.open.is_empty()).then_some(time)
    }

    /// Takes the bytes of one read and sends the events that they complete.
    pub fn take(&mut self, bytes: &[u8], send: &mut impl FnMut(Event)) {
        if bytes == INTERRUPT {
            // It also gets the user out of a paste that does not end.
            self.forget();
        }
        let cut = std::mem::take(&mut self.cut);
        let joined = [&cut, bytes].concat();
        let continues = match reply(&joined).filter(|_| !cut.is_empty()) {
            Some(whole) => whole || bytes.len() > 1,
            None => cut == PASTE_BEGIN && is_several(bytes),
        };
        for byte in if continues { &joined } else { bytes } {
            self.add(*byte, send);
        }
        if !continues && !cut.is_empty() && reply(&joined).is_some() {
            self.cut = joined;
        }
    }

    /// Gives up waiting for the rest of what has arrived.
    pub fn pause(&mut self, send: &mut impl FnMut(Event)) {
        if self.open.starts_with(PASTE_BEGIN) {
            self.cut = PASTE_BEGIN.to_vec();
        } else if self.cut.is_empty() {
            self.cut.clone_from(&self.open);
        }
        while !self.open.is_empty() {
            self.give_up(send);
        }
    }

    fn forget(&mut self) -> Vec<u8> {
        self.parser = Parser::default();
        std::mem::take(&mut self.open)
    }

    /// Adds a byte. An escape begins a sequence, whatever has begun before it, except at the end of a control string and in
    /// a paste.
    fn add(&mut self, byte: u8, send: &mut impl FnMut(Event)) {
        let is_string = matches!(self.open[..], [ESCAPE, b']' | b'P', ..]);
        if is_string && byte != b'\\' && self.open.ends_with(&[ESCAPE]) {
            self.open.pop();
            self.give_up(send);
            self.add(ESCAPE, send);
        } else if byte == ESCAPE && !is_string && !self.open.starts_with(PASTE_BEGIN) {
            self.give_up(send);
        }
        self.open.push(byte);
        self.parser.parse(&[byte], true);
        if let Some(event) = self.parser.pop() {
            self.open.clear();
            send(event);
        }
    }

    /// Sends what the beginning of a sequence is without its rest.
    fn give_up(&mut self, send: &mut impl FnMut(Event)) {
        let open = self.forget();
        match open[..] {
            [ESCAPE] => send(Event::Key(KeyCode::Escape.into())),
            [ESCAPE, second, ref rest @ ..] if is_typed(&open) => {
                send(Event::Key(KeyEvent::new(KeyCode::Char(second.into()), Modifiers::ALT)));
                for byte in rest {
                    self.add(*byte, send);
                }
            }
            _ => {
                if let Some(text) = open.strip_prefix(PASTE_BEGIN) {
                    send(Event::Paste(String::from_utf8_lossy(text).into_owned()));
                }
            }
        }
    }
}

/// Whether these bytes are more than one key.
fn is_several(bytes: &[u8]) -> bool {
    let mut parser = Parser::default();
    let ends = |byte: &u8| {
        parser.parse(&[*byte], true);
        parser.pop().is_some()
    };
    bytes.iter().position(ends).is_some_and(|end| end + 1 < bytes.len())
}

/// Whether an unfinished sequence can be what a person has pressed: it has no parameters.
fn is_typed(open: &[u8]) -> bool {
    match open {
        [ESCAPE, b'[', then, ..] => matches!(then, b'[' | b'M'),
        [ESCAPE, b']', then, ..] => !then.is_ascii_digit(),
        [ESCAPE, second, ..] => b"[]PO".contains(second),
        _ => false,
    }
}

/// How far some bytes are a reply that the program asks for, a cursor position or a colour: `Some(true)` if they
/// begin with a whole one, `Some(false)` if they are surely the beginning of one.
fn reply(bytes: &[u8]) -> Option<bool> {
    let span = |text: &[u8], is_part: fn(&u8) -> bool| {
        text.iter().position(|byte| !is_part(byte)).unwrap_or(text.len())
    };
    if let Some(text) = bytes.strip_prefix(b"\x1b[") {
        let (numbers, end) = text.split_at(span(text, |it| it.is_ascii_digit() || *it == b';'));
        let is_pair = numbers.contains(&b';') && numbers[0] != b';';
        return match end.first() {
            None => is_pair.then_some(false),
            Some(b'R') => (is_pair && !numbers.ends_with(b";")).then_some(true),
            Some(_) => None,
        };
    }
    let text = bytes.strip_prefix(b"\x1b]11;")?;
    let (color, end) = text.split_at(span(text, u8::is_ascii_graphic));
    let is_color = color.split(|byte| *byte == b'/').count() >= 3;
    match end {
        [] | [ESCAPE] => Some(false),
        [BELL, ..] | [ESCAPE, b'\\', ..] => is_color.then_some(true),
        _ => None,
    }
}
