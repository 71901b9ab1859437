//! Divides the bytes of the terminal into sequences: keys, reports, pastes.
//!
//! Some keys begin like a longer sequence: Esc, and Alt with `[`, `]`, `P` or `O`. Only time tells them apart,
//! so a sequence whose end does not come is given up: after [`ESCAPE_TIME`] it is the keys that a person can
//! have pressed, or nothing where it has parameters, which only a machine writes that fast.
//!
//! Over a slow line a pause can also cut a reply of the terminal in two. What a pause has cut off is therefore
//! remembered: what arrives next at once, several bytes long, and continues a reply of the terminal belongs to
//! it. A single byte is a key, unless it ends such a reply.

use std::time::Duration;

/// How long an unfinished sequence may wait for its rest: over a slow line, `ESC` and `[A` can arrive separately
/// (crossterm#993).
pub const ESCAPE_TIME: Duration = Duration::from_millis(50);

/// How long an unfinished paste may wait for its rest, which over a slow line takes longer than a key.
const PASTE_TIME: Duration = Duration::from_secs(1);

/// The byte that Ctrl-C sends; typed by a person, it arrives in a separate read.
const INTERRUPT: &[u8] = b"\x03";

const PASTE_BEGIN: &[u8] = b"\x1b[200~";
const PASTE_END: &[u8] = b"\x1b[201~";

const ESCAPE: u8 = 0x1b;
const BELL: u8 = 0x07;

/// A part of the input that has a meaning of its own.
#[derive(Clone, Debug)]
pub enum Sequence {
    /// A character or a whole control sequence.
    Whole(Vec<u8>),
    /// Alt with this character, which otherwise begins a longer sequence.
    Alt(u8),
    /// Pasted bytes.
    Paste(Vec<u8>),
}

/// The bytes that wait for their rest.
#[derive(Default)]
pub struct Divider {
    /// The beginning of a sequence.
    open: Vec<u8>,
    /// A paste whose end has not come.
    paste: Option<Vec<u8>>,
    /// What a pause has cut off.
    cut: Vec<u8>,
}

/// What the first bytes of some input are.
enum FirstBytes {
    Whole,
    /// Two bytes: Alt with the second one.
    Alt,
    PasteBegin,
    /// Nothing that has a meaning.
    Noise,
}

/// What some input begins with, and how many bytes of it; `None` for the beginning of a sequence, as far as it has
/// arrived.
type Begin = Option<(FirstBytes, usize)>;

const ALT: Begin = Some((FirstBytes::Alt, 2));

impl Divider {
    /// How long to wait for the rest of what has arrived; `None` if nothing is unfinished.
    pub fn patience(&self) -> Option<Duration> {
        if self.paste.is_some() {
            Some(PASTE_TIME)
        } else {
            (!self.open.is_empty()).then_some(ESCAPE_TIME)
        }
    }

    /// Takes the bytes of one read and sends the sequences that they complete.
    pub fn take(&mut self, bytes: &[u8], send: &mut impl FnMut(Sequence)) {
        if bytes == INTERRUPT {
            // It also gets the user out of a paste that does not end.
            self.paste = None;
        }
        let cut = std::mem::take(&mut self.cut);
        let joined = [&cut, bytes].concat();
        match reply(&joined) {
            _ if cut.is_empty() => self.open.extend_from_slice(bytes),
            Some(whole) if whole || bytes.len() > 1 => self.open = joined,
            Some(_) => {
                self.cut = joined;
                self.open.extend_from_slice(bytes);
            }
            None if cut == PASTE_BEGIN && is_several(bytes) => self.open = joined,
            None => self.open.extend_from_slice(bytes),
        }
        self.divide(send);
    }

    /// Gives up waiting for the rest of what has arrived.
    pub fn pause(&mut self, send: &mut impl FnMut(Sequence)) {
        if let Some(text) = self.paste.take() {
            send(Sequence::Paste(text));
            self.cut = PASTE_BEGIN.to_vec();
        }
        if self.cut.is_empty() {
            self.cut.clone_from(&self.open);
        }
        while let Some(&first) = self.open.first() {
            match self.open.get(1) {
                None if first == ESCAPE => send(Sequence::Whole(std::mem::take(&mut self.open))),
                Some(&second) if is_typed(&self.open) => {
                    send(Sequence::Alt(second));
                    self.open.drain(..2);
                    self.divide(send);
                }
                _ => self.open.clear(),
            }
        }
    }

    /// Sends all sequences that are complete.
    fn divide(&mut self, send: &mut impl FnMut(Sequence)) {
        let bytes = std::mem::take(&mut self.open);
        let mut rest = &bytes[..];
        while !rest.is_empty() {
            if self.paste.is_some() {
                rest = self.pasted(rest, send);
                continue;
            }
            let Some((kind, length)) = first(rest) else { break };
            match kind {
                FirstBytes::Noise => {}
                FirstBytes::Whole => send(Sequence::Whole(rest[..length].to_vec())),
                FirstBytes::Alt => send(Sequence::Alt(rest[1])),
                FirstBytes::PasteBegin => self.paste = Some(Vec::new()),
            }
            rest = &rest[length..];
        }
        self.open = rest.to_vec();
    }

    /// Adds bytes to the paste and returns those behind its end.
    fn pasted<'a>(&mut self, bytes: &'a [u8], send: &mut impl FnMut(Sequence)) -> &'a [u8] {
        let Some(text) = &mut self.paste else { return bytes };
        let before = text.len();
        text.extend_from_slice(bytes);
        let searched = before.saturating_sub(PASTE_END.len() - 1);
        let found = text[searched..].windows(PASTE_END.len()).position(|it| it == PASTE_END);
        let Some(end) = found.map(|at| searched + at) else { return &[] };
        text.truncate(end);
        send(Sequence::Paste(self.paste.take().unwrap_or_default()));
        &bytes[end + PASTE_END.len() - before..]
    }
}

/// Whether these bytes are more than one key.
fn is_several(bytes: &[u8]) -> bool {
    first(bytes).is_some_and(|(kind, length)| {
        matches!(kind, FirstBytes::Whole | FirstBytes::Noise) && length < bytes.len()
    })
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

/// What some input begins with.
fn first(bytes: &[u8]) -> Begin {
    match bytes {
        [ESCAPE] | [ESCAPE, b'O' | b'[' | b']' | b'P'] => None,
        // The first one is the key. The second one may begin a sequence, such as a report that arrives while
        // the key is pressed.
        [ESCAPE, ESCAPE, ..] => Some((FirstBytes::Whole, 1)),
        [ESCAPE, b'O', b'@'..=b'~', ..] => Some((FirstBytes::Whole, 3)),
        [ESCAPE, b'O', ..] => ALT,
        [ESCAPE, b'[', rest @ ..] => control(rest),
        [ESCAPE, b']' | b'P', ..] => string(bytes),
        [ESCAPE, rest @ ..] => match character(rest)? {
            (FirstBytes::Whole, length) => Some((FirstBytes::Whole, 1 + length)),
            _ => Some((FirstBytes::Whole, 1)),
        },
        _ => character(bytes),
    }
}

/// A control sequence without its `ESC[`.
fn control(rest: &[u8]) -> Begin {
    match rest {
        // The function keys of the Linux console.
        [b'['] => return None,
        [b'[', b'A'..=b'E', ..] => return Some((FirstBytes::Whole, 4)),
        // A report of the mouse, as terminals send it that know no decimal coordinates.
        [b'M', places @ ..] if places.iter().take(3).all(|place| *place >= b' ') => {
            return if places.len() < 3 {
                None
            } else {
                Some((FirstBytes::Whole, 6))
            };
        }
        _ => {}
    }
    let parameters = rest.iter().take_while(|byte| (b' '..=b'?').contains(byte)).count();
    let length = 2 + parameters + 1;
    match (rest.first(), rest.get(parameters)) {
        (_, None) => None,
        (_, Some(b'~')) if rest[..parameters] == *b"200" => Some((FirstBytes::PasteBegin, length)),
        (
            Some(b'0'..=b'9' | b'<' | b'>' | b'?' | b'@'..=b'Z' | b'\\'..=b'~'),
            Some(b'@'..=b'~'),
        ) => Some((FirstBytes::Whole, length)),
        (Some(_), Some(b'@'..=b'~')) if parameters > 0 => Some((FirstBytes::Noise, length)),
        (Some(_), Some(_)) if parameters > 0 => Some((FirstBytes::Noise, length - 1)),
        _ => ALT,
    }
}

/// A control string: an operating system command or a device control string.
fn string(bytes: &[u8]) -> Begin {
    let is_command = bytes[1] == b']';
    if is_command && !bytes[2].is_ascii_digit() {
        return ALT;
    }
    let text = bytes.iter().skip(2).take_while(|byte| **byte >= b' ').count();
    match &bytes[2 + text..] {
        [] | [ESCAPE] => None,
        [BELL, ..] if is_command => Some((FirstBytes::Whole, 2 + text + 1)),
        [ESCAPE, b'\\', ..] => Some((FirstBytes::Whole, 2 + text + 2)),
        _ if is_command => Some((FirstBytes::Noise, 2 + text)),
        _ => ALT,
    }
}

/// A character in UTF-8.
fn character(bytes: &[u8]) -> Begin {
    let length = match bytes[0] {
        0x00..=0x7f => 1,
        0xc2..=0xdf => 2,
        0xe0..=0xef => 3,
        0xf0..=0xf4 => 4,
        _ => return Some((FirstBytes::Noise, 1)),
    };
    let end = bytes.len().min(length);
    match bytes[1..end].iter().position(|byte| !(0x80..0xc0).contains(byte)) {
        Some(broken) => Some((FirstBytes::Noise, 1 + broken)),
        None if end < length => None,
        None => Some((FirstBytes::Whole, length)),
    }
}
