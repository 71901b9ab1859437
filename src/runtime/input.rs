//! The keyboard: converts bytes from the terminal to events.
//!
//! A separate thread blocks in `read` and sends the events that it recognizes. It reads the terminal itself and
//! hands the bytes to termina's parser, because crossterm's reader keeps cursor position reports to itself,
//! leaves everything beyond 1,024 bytes unread until the next key (crossterm#1057), and spins when the terminal
//! hangs up (crossterm#793).

use std::io;
use std::os::fd::AsFd;
use std::thread;
use std::time::Duration;

use crossbeam_channel::Sender;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use termina::Parser;
use termina::escape::csi::{Csi, Cursor};
use termina::escape::osc::{ColorOrQuery, DynamicColorNumber, Osc};
use termina::event::{
    KeyCode, KeyEvent, KeyEventKind, Modifiers, MouseButton, MouseEvent, MouseEventKind,
};
use termina::style::RgbColor;

use super::event::Event;
use crate::session::{Code, Gesture, Key, Msg};

/// How long a final escape byte may wait for the rest of its sequence: over a slow line, `ESC` and `[A` can
/// arrive separately (crossterm#993). After that, it was the escape key.
const ESCAPE_TIME: Duration = Duration::from_millis(50);

/// The byte that Ctrl-C sends; typed by a person, it arrives in a separate read.
const INTERRUPT: &[u8] = b"\x03";

/// Bytes per read.
const BUFFER: usize = 4096;

/// Starts the thread that reads the terminal at standard input until it is gone. Fails if the system provides
/// no thread.
pub fn start(events: Sender<Event>) -> io::Result<()> {
    thread::Builder::new().name("input".to_owned()).spawn(move || {
        let last = LastWord(events);
        read(&io::stdin(), |event| drop(last.0.send(event)));
    })?;
    Ok(())
}

/// Reports the end of input, however the reading thread ends: a program that cannot be quit by a key must not
/// continue.
struct LastWord(Sender<Event>);

impl Drop for LastWord {
    fn drop(&mut self) {
        drop(self.0.send(Event::Closed));
    }
}

/// Reads until the input ends.
fn read(terminal: &impl AsFd, mut send: impl FnMut(Event)) {
    let mut parser = Parser::default();
    let mut buffer = [0; BUFFER];
    let mut escape = false;
    loop {
        let bytes = match rustix::io::read(terminal, &mut buffer) {
            Ok(0) => return,
            Ok(count) => &buffer[..count],
            // Another process made the terminal non-blocking.
            Err(Errno::AGAIN) if more(terminal, None) => continue,
            Err(Errno::INTR) => continue,
            Err(_) => return,
        };
        let parsed = understood(&mut parser, bytes, escape, &mut send);
        escape = false;
        if bytes == INTERRUPT && !parsed {
            // The parser is waiting for the end of an interrupted sequence, which no key would complete.
            parser = Parser::default();
            parser.parse(bytes, true);
            drain(&mut parser, &mut send);
        }
        if bytes.last() == Some(&b'\x1b') {
            escape = more(terminal, Some(ESCAPE_TIME));
            if !escape {
                parser.parse(&[], false);
                drain(&mut parser, &mut send);
            }
        }
    }
}

/// Parses bytes and sends the recognized events; returns whether there were any. `escape` says that an escape
/// byte waits for the rest of its sequence.
///
/// If another escape byte follows, the first one was the key and the second one begins a sequence, for example
/// a cursor report that arrives while the key is pressed. The parser would take both for one key, and the
/// report for text.
fn understood(
    parser: &mut Parser,
    mut bytes: &[u8],
    mut escape: bool,
    send: &mut impl FnMut(Event),
) -> bool {
    let mut any = false;
    loop {
        if escape && bytes.first() == Some(&b'\x1b') {
            parser.parse(&[], false);
            any |= drain(parser, send);
        }
        let two = bytes.windows(2).position(|two| two == b"\x1b\x1b");
        let (now, later) = bytes.split_at(two.map_or(bytes.len(), |at| at + 1));
        parser.parse(now, true);
        any |= drain(parser, send);
        if later.is_empty() {
            return any;
        }
        (bytes, escape) = (later, true);
    }
}

/// Whether there is something to read within this time; `None` waits forever.
fn more(terminal: &impl AsFd, time: Option<Duration>) -> bool {
    let time = time.and_then(|time| Timespec::try_from(time).ok());
    let mut waiting = [PollFd::new(terminal, PollFlags::IN)];
    poll(&mut waiting, time.as_ref()).is_ok_and(|ready| ready > 0)
}

/// Sends the recognized events; returns whether there were any.
fn drain(parser: &mut Parser, send: &mut impl FnMut(Event)) -> bool {
    let mut any = false;
    while let Some(parsed) = parser.pop() {
        any = true;
        if let Some(event) = event(parsed) {
            send(event);
        }
    }
    any
}

/// The event for a parsed sequence; none for releases of keys and for anything that was not asked for.
fn event(parsed: termina::Event) -> Option<Event> {
    match parsed {
        termina::Event::Key(pressed) => key(pressed).map(|key| Event::Session(Msg::Key(key))),
        termina::Event::Paste(text) => {
            let lines = text.replace("\r\n", "\n").replace('\r', "\n");
            Some(Event::Session(Msg::Paste(lines)))
        }
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
    (event.kind != KeyEventKind::Release).then_some(Key {
        code,
        control: held(Modifiers::CONTROL),
        alt: held(Modifiers::ALT),
        shift: held(Modifiers::SHIFT) && !matches!(code, Code::Char(_)),
    })
}

#[cfg(test)]
mod tests {
    use std::io::Write;
    use std::os::unix::net::UnixStream;

    use crossbeam_channel::{Receiver, unbounded};
    use proptest::prelude::*;

    use super::*;

    /// A terminal into which the tests type, and the events that arrive.
    struct Keyboard {
        terminal: UnixStream,
        events: Receiver<Event>,
    }

    fn keyboard() -> Keyboard {
        let (terminal, end) = UnixStream::pair().unwrap();
        let (send, events) = unbounded();
        thread::spawn(move || {
            let last = LastWord(send);
            read(&end, |event| drop(last.0.send(event)));
        });
        Keyboard { terminal, events }
    }

    impl Keyboard {
        fn types(&mut self, bytes: &[u8]) {
            self.terminal.write_all(bytes).unwrap();
        }

        fn hears(&self) -> String {
            name(&self.events.recv().unwrap())
        }

        /// All events, received after the terminal hung up.
        fn all(self) -> Vec<String> {
            drop(self.terminal);
            self.events.iter().map(|event| name(&event)).collect()
        }
    }

    fn name(event: &Event) -> String {
        match event {
            Event::Session(Msg::Key(key)) => {
                let Key { code, control, alt, shift } = key;
                let held = [(control, "C-"), (alt, "A-"), (shift, "S-")];
                let held: String =
                    held.iter().filter(|(held, _)| **held).map(|(_, name)| *name).collect();
                format!("{held}{code:?}")
            }
            Event::Session(Msg::Paste(text)) => format!("paste {text:?}"),
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn ctrl_c_is_heard_behind_whatever_was_broken_off() {
        let broken: [&[u8]; 6] =
            [b"\x1b]11;rgb:", b"\x1bPq", b"\x1b_x", b"\x1b[200~text", b"\x1b[12;", b"\xf0\x9f"];
        for bytes in broken {
            let mut keyboard = keyboard();
            keyboard.types(bytes);
            // A person types more slowly than the reader reads.
            thread::sleep(2 * ESCAPE_TIME);
            keyboard.types(INTERRUPT);
            let second = Duration::from_secs(1);
            let heard = std::iter::from_fn(|| keyboard.events.recv_timeout(second).ok());
            let heard: Vec<String> = heard.map(|event| name(&event)).collect();
            assert_eq!(heard.last().map(String::as_str), Some("C-Char('c')"), "{bytes:?}");
        }
    }

    #[test]
    fn keys_have_their_names() {
        let cases: [(&[u8], &str); 14] = [
            (b"a", "Char('a')"),
            (b"Z", "Char('Z')"),
            ("\u{e9}".as_bytes(), "Char('\u{e9}')"),
            (b"\r", "Enter"),
            (b"\t", "Tab"),
            (b"\x1b[Z", "S-Tab"),
            (b"\x7f", "Backspace"),
            (b"\x12", "C-Char('r')"),
            (b"\x1b[A", "Up"),
            (b"\x1bOA", "Up"),
            (b"\x1b[1;2C", "S-Right"),
            (b"\x1b[5~", "PageUp"),
            (b"\x1bx", "A-Char('x')"),
            (b"\x1b[15~", "F(5)"),
        ];
        let mut keyboard = keyboard();
        for (bytes, name) in cases {
            keyboard.types(bytes);
            assert_eq!(keyboard.hears(), name, "{bytes:?}");
        }
    }

    #[test]
    fn escape_is_a_key_when_nothing_follows_and_else_begins_a_sequence() {
        let mut keyboard = keyboard();
        keyboard.types(b"\x1b");
        assert_eq!(keyboard.hears(), "Esc");
        keyboard.types(b"\x1b[");
        keyboard.types(b"A");
        assert_eq!(keyboard.hears(), "Up");
    }

    #[test]
    fn five_hundred_arrows_at_once_are_five_hundred_arrows() {
        let mut keyboard = keyboard();
        keyboard.types(&[b"\x1b[C".repeat(500), b"q".to_vec()].concat());
        let heard = keyboard.all();
        assert_eq!(heard.len(), 502);
        assert!(heard[..500].iter().all(|name| name == "Right"));
        assert_eq!(heard[500..], ["Char('q')", "Closed"]);
    }

    #[test]
    fn a_paste_is_one_message_with_lines() {
        let mut keyboard = keyboard();
        let text = "<right*5>\r\n<wait>\rq".repeat(1000);
        keyboard.types(format!("\x1b[200~{text}\x1b[201~").as_bytes());
        let lines = "<right*5>\n<wait>\nq".repeat(1000);
        assert_eq!(keyboard.all(), [format!("paste {lines:?}"), "Closed".to_owned()]);
    }

    #[test]
    fn a_report_among_keys_is_not_a_key() {
        let mut keyboard = keyboard();
        keyboard.types(b"a\x1b[24;80Rb");
        assert_eq!(keyboard.all(), ["Char('a')", "Shown", "Char('b')", "Closed"]);
    }

    #[test]
    fn a_report_behind_an_escape_key_is_not_text() {
        for reads in [&[b"\x1b\x1b[24;80Rb".as_slice()] as &[&[u8]], &[b"\x1b", b"\x1b[24;80Rb"]] {
            let mut keyboard = keyboard();
            for bytes in reads {
                keyboard.types(bytes);
            }
            assert_eq!(keyboard.all(), ["Esc", "Shown", "Char('b')", "Closed"]);
        }
        let mut keyboard = keyboard();
        keyboard.types(b"\x1b[200~one\x1b\x1btwo\x1b[201~");
        assert_eq!(keyboard.all(), ["paste \"one\\u{1b}\\u{1b}two\"", "Closed"]);
    }

    #[test]
    fn the_background_is_told_and_other_colours_and_noise_are_passed_over() {
        let mut keyboard = keyboard();
        keyboard.types(b"a\x1b]11;rgb:ffff/ffff/dddd\x1b\\b\x1b]11;rgb:1e/1e/2e\x07c");
        keyboard.types(b"\x1b]10;rgb:ffff/ffff/ffff\x1b\\\x1b]11;nonsense\x1b\\d");
        let background = |is_light: bool| format!("Background {{ is_light: {is_light} }}");
        let expected = [
            "Char('a')".to_owned(),
            background(true),
            "Char('b')".to_owned(),
            background(false),
            "Char('c')".to_owned(),
            "Char('d')".to_owned(),
            "Closed".to_owned(),
        ];
        assert_eq!(keyboard.all(), expected);
    }

    #[test]
    fn clicks_and_the_wheel_are_heard_and_moves_are_not() {
        let mut keyboard = keyboard();
        keyboard.types(b"\x1b[<0;12;5M\x1b[<0;12;5m\x1b[<64;1;1M\x1b[<65;300;200M\x1b[<35;9;9M");
        let mouse = |gesture, column: u16, row: u16| {
            format!("Mouse {{ gesture: {gesture}, column: {column}, row: {row} }}")
        };
        let heard = [
            mouse("Click", 11, 4),
            mouse("Nearer", 0, 0),
            mouse("Farther", 299, 199),
            "Closed".into(),
        ];
        assert_eq!(keyboard.all(), heard);
    }

    #[test]
    fn the_release_of_a_key_is_nothing() {
        let mut keyboard = keyboard();
        keyboard.types(b"\x1b[97;1:3u\x1b[97;1:1u");
        assert_eq!(keyboard.all(), ["Char('a')", "Closed"]);
    }

    proptest! {
        /// Any bytes in any pieces: no panic, and the end of input is noticed.
        #[test]
        fn any_bytes_are_survived(pieces in prop::collection::vec(
            prop_oneof![
                prop::collection::vec(any::<u8>(), 0..12),
                "(\x1b[\\[O\\]P]|[0-9;:<?>=]|[A-Za-z~]|\x1b){0,8}".prop_map(String::into_bytes),
            ],
            0..8,
        )) {
            let mut keyboard = keyboard();
            for piece in pieces {
                keyboard.types(&piece);
            }
            let heard = keyboard.all();
            prop_assert_eq!(heard.last().map(String::as_str), Some("Closed"));
        }
    }
}
