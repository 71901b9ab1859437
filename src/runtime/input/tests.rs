//! A keyboard at a socket, and at the divider itself, where a pause takes no time.

use std::io::Write;
use std::os::unix::net::UnixStream;
use std::time::Duration;

use crossbeam_channel::{Receiver, unbounded};
use proptest::prelude::*;

use super::keyboard::parsed;
use super::sequences::Divider;
use super::*;

/// A terminal into which the tests type, and the events that arrive.
struct Keyboard {
    terminal: UnixStream,
    events: Receiver<Event>,
}

fn keyboard() -> Keyboard {
    let (terminal, end) = UnixStream::pair().unwrap();
    let (send, events) = unbounded();
    thread::spawn(move || listen(&end, &send));
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
        Event::End(end) => format!("{end:?}"),
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
        thread::sleep(2 * sequences::ESCAPE_TIME);
        keyboard.types(b"\x03");
        let second = Duration::from_secs(1);
        let heard = std::iter::from_fn(|| keyboard.events.recv_timeout(second).ok());
        let heard: Vec<String> = heard.map(|event| name(&event)).collect();
        assert_eq!(heard.last().map(String::as_str), Some("C-Char('c')"), "{bytes:?}");
    }
}

#[test]
fn a_key_is_heard_behind_what_breaks_off_or_is_unknown_in_the_same_read() {
    let cases: [(&[u8], &[&str]); 8] = [
        (b"\x1b[12;\x03", &["C-Char('c')"]),
        (b"\x1b]11;rgb:\x03", &["C-Char('c')"]),
        (b"\x1b[<0;3\x03", &["C-Char('c')"]),
        (b"\xe9q", &["Char('q')"]),
        (b"\x1b[>41;354;0cq", &["Char('q')"]),
        (b"\x1b[?1hq", &["Char('q')"]),
        // Keys of a keypad that have no name are no text.
        (b"\x1bOq", &[]),
        (b"\x1bOM", &[]),
    ];
    for (bytes, heard) in cases {
        let mut keyboard = keyboard();
        keyboard.types(bytes);
        thread::sleep(2 * sequences::ESCAPE_TIME);
        assert_eq!(keyboard.all(), [heard, &["Closed"]].concat(), "{bytes:?}");
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
fn a_paste_is_one_message_with_lines() {
    let mut keyboard = keyboard();
    let text = "<right*5>\r\n<wait>\rq".repeat(1000);
    keyboard.types(format!("\x1b[200~{text}\x1b[201~").as_bytes());
    let lines = "<right*5>\n<wait>\nq".repeat(1000);
    assert_eq!(keyboard.all(), [format!("paste {lines:?}"), "Closed".to_owned()]);
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
    let heard =
        [mouse("Click", 11, 4), mouse("Nearer", 0, 0), mouse("Farther", 299, 199), "Closed".into()];
    assert_eq!(keyboard.all(), heard);
}

#[test]
fn the_release_of_a_key_is_nothing() {
    let mut keyboard = keyboard();
    keyboard.types(b"\x1b[97;1:3u\x1b[97;1:1u");
    assert_eq!(keyboard.all(), ["Char('a')", "Closed"]);
}

/// What is heard of these pieces, each followed by a pause.
fn with_pauses(pieces: &[&[u8]]) -> Vec<String> {
    let mut divider = Divider::default();
    let mut heard = Vec::new();
    for piece in pieces {
        let mut send =
            |sequence| heard.extend(parsed(sequence).and_then(understood).iter().map(name));
        divider.take(piece, &mut send);
        divider.pause(&mut send);
    }
    heard
}

#[test]
fn what_begins_like_a_longer_sequence_is_the_key_that_was_pressed() {
    let cases: [(&[u8], &[&str]); 12] = [
        (b"\x1b", &["Esc"]),
        (b"\x1b]", &["A-Char(']')"]),
        (b"\x1bP", &["A-Char('P')"]),
        (b"\x1b[", &["A-Char('[')"]),
        (b"\x1bO", &["A-Char('O')"]),
        (b"\x1b_", &["A-Char('_')"]),
        (b"\x1b^", &["A-Char('^')"]),
        (b"\x1bX", &["A-Char('X')"]),
        (b"\x1bPq1", &["A-Char('P')", "Char('q')", "Char('1')"]),
        (b"\x1b]q\r", &["A-Char(']')", "Char('q')", "Enter"]),
        (b"\x1b[[", &["A-Char('[')", "Char('[')"]),
        (b"\x1b[\x1b[A", &["A-Char('[')", "Up"]),
    ];
    for (bytes, heard) in cases {
        assert_eq!(with_pauses(&[bytes]), heard, "{bytes:?}");
    }
}

#[test]
fn what_only_a_machine_can_have_begun_is_no_key() {
    for begun in ["\x1b[1;5", "\x1b[<0;12", "\x1b]1", "\x1b]11;rgb:ff", "\u{f0}"] {
        assert!(with_pauses(&[begun.as_bytes(), b"q"]).ends_with(&["Char('q')".to_owned()]));
        assert_eq!(with_pauses(&[begun.as_bytes(), b"\x1b[C"]).last().unwrap(), "Right");
    }
    assert_eq!(with_pauses(&[b"\x1b[1;5", b"\x1b]11;rgb:ff", b"\xf0\x9f"]), [""; 0]);
}

#[test]
fn a_reply_in_two_pieces_is_that_reply_and_no_text() {
    let replies = [
        ("\x1b]11;rgb:ffff/ffff/dddd\x1b\\", "Background { is_light: true }", "A-Char(']')"),
        ("\x1b]11;rgb:1e1e/1e1e/2e2e\x07", "Background { is_light: false }", "A-Char(']')"),
        ("\x1b[24;80R", "Shown", "A-Char('[')"),
    ];
    for (reply, meaning, key) in replies {
        for place in 1..reply.len() {
            let (one, other) = reply.split_at(place);
            let heard = with_pauses(&[one.as_bytes(), format!("{other}a").as_bytes()]);
            let expected: &[&str] = match place {
                // As far as can be told at the pause, it was a key.
                1 => &["Esc", meaning, "Char('a')"],
                2 => &[key, meaning, "Char('a')"],
                _ => &[meaning, "Char('a')"],
            };
            assert_eq!(heard, expected, "{one:?} {other:?}");
        }
        let thirds = [&reply[..4], &reply[4..6], &reply[6..]].map(str::as_bytes);
        assert_eq!(with_pauses(&thirds), [meaning]);
    }
}

#[test]
fn a_paste_that_breaks_off_is_given_as_far_as_it_came_and_its_rest_is_a_paste_too() {
    let heard = with_pauses(&[b"\x1b[200~one tw", b"o q\x1b[201~q"]);
    assert_eq!(heard, ["paste \"one tw\"", "paste \"o q\"", "Char('q')"]);
    let heard = with_pauses(&[b"\x1b[200~one", b"q", b"qq", b"\x1b[A"]);
    assert_eq!(heard, ["paste \"one\"", "Char('q')", "Char('q')", "Char('q')", "Up"]);
    assert_eq!(with_pauses(&[b"\x1b[200~one", b"\x1b[A"]), ["paste \"one\"", "Up"]);
}

/// A key as the terminal sends it, and its name.
///
/// Without `R`, which ends a cursor report whose beginning has come.
fn pressed() -> impl Strategy<Value = (Vec<u8>, String)> {
    let sent = |bytes: &[u8], name: &str| (bytes.to_vec(), name.to_owned());
    let char = prop::char::range(' ', '~');
    let plain = char.clone().prop_map(|it| (vec![it as u8], format!("Char({it:?})")));
    let alt = char.prop_map(|it| (vec![b'\x1b', it as u8], format!("A-Char({it:?})")));
    let control = prop::char::range('a', 'f')
        .prop_map(|it| (vec![it as u8 & 0x1f], format!("C-Char({it:?})")));
    let others = [
        sent(b"\x1b", "Esc"),
        sent(b"\r", "Enter"),
        sent(b"\x7f", "Backspace"),
        sent(b"\x1b[A", "Up"),
        sent(b"\x1bOP", "F(1)"),
        sent(b"\x1b[15~", "F(5)"),
        sent(b"\x1b[1;5C", "C-Right"),
        sent("\u{e9}".as_bytes(), "Char('\u{e9}')"),
    ];
    prop_oneof![plain, alt, control, prop::sample::select(others.to_vec())]
        .prop_filter("ends a report", |(bytes, _)| bytes != b"R")
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

    /// Whatever arrived before, every key is heard that follows at the pace of a person.
    #[test]
    fn a_key_behind_any_bytes_is_heard(
        before in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..12),
            "(\x1b[\\[O\\]P_^X]|\x1b\\[200~|\x1b\\]11;rgb:|[0-9;:<?>=]|[A-Za-z~]|\x1b){0,8}"
                .prop_map(String::into_bytes),
        ],
        keys in prop::collection::vec(pressed(), 1..6),
    ) {
        let mut pieces = vec![&before[..]];
        pieces.extend(keys.iter().map(|(bytes, _)| &bytes[..]));
        let heard = with_pauses(&pieces);
        let names: Vec<&str> = keys.iter().map(|(_, name)| name.as_str()).collect();
        prop_assert!(heard.len() >= names.len(), "{heard:?}");
        prop_assert_eq!(&heard[heard.len() - names.len()..], names);
    }
}
