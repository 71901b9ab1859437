//! Text from outside, made printable: what files, their names, arguments and the environment contain must neither
//! control a terminal nor hide in it.
//!
//! What is not printable is shown as in a string of Rust, `\u{1b}`, and in JSON as it is written there, `\u001b`.

use std::borrow::Cow;
use std::fmt::Write;

/// Whether a character is printed: it neither controls the terminal or the direction of text, nor is it invisible.
pub fn is_printable(char: char) -> bool {
    let is_hidden = matches!(char,
        '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}' | '\u{180e}'
        | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{3164}'
        | '\u{feff}' | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}' | '\u{fffe}'..='\u{ffff}'
        | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e007f}');
    !char.is_control() && !is_hidden
}

/// A text on one line.
pub fn line(text: &str) -> Cow<'_, str> {
    written(text, is_printable, escaped)
}

/// A text on several lines, which keeps its line feeds.
pub fn lines(text: &str) -> Cow<'_, str> {
    written(text, is_of_lines, escaped)
}

/// A JSON document with the same content: what is not printable can only be part of a string, where it is escaped.
pub fn json(document: &str) -> Cow<'_, str> {
    written(document, is_of_lines, |char, out| {
        for unit in char.encode_utf16(&mut [0; 2]) {
            // Writing to a string cannot fail.
            let _ = write!(out, "\\u{unit:04x}");
        }
    })
}

/// A text on several lines as XML: nothing in it is markup or forbidden there.
pub fn xml(text: &str) -> String {
    lines(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A text for reading, with a sign in place of the letters `+-` where these begin a word. Within one they are input, as in
/// `r=0.1+-0.01`.
pub fn signs(text: &str) -> String {
    format!(" {text}").replace(" +-", " \u{b1}").split_off(1)
}

fn is_of_lines(char: char) -> bool {
    char == '\n' || is_printable(char)
}

fn escaped(char: char, out: &mut String) {
    out.extend(char.escape_default());
}

fn written(
    text: &str,
    is_kept: impl Fn(char) -> bool,
    escape: impl Fn(char, &mut String),
) -> Cow<'_, str> {
    if text.chars().all(&is_kept) {
        return text.into();
    }
    let mut out = String::with_capacity(2 * text.len());
    for char in text.chars() {
        if is_kept(char) {
            out.push(char);
        } else {
            escape(char, &mut out);
        }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_controls_or_hides_is_escaped_and_what_is_seen_is_kept() {
        for (text, shown) in [
            ("\u{1b}]0;X\u{7}", "\\u{1b}]0;X\\u{7}"),
            ("a\tb\nc", "a\\tb\\nc"),
            ("\u{7f}\u{9b}2J", "\\u{7f}\\u{9b}2J"),
            ("moc\u{202e}exe", "moc\\u{202e}exe"),
            ("a\u{200b}b\u{feff}", "a\\u{200b}b\\u{feff}"),
            ("Größe \u{3b1} e\u{301} 漢 ⣿ \u{1f600}", "Größe \u{3b1} e\u{301} 漢 ⣿ \u{1f600}"),
        ] {
            assert_eq!(line(text), shown);
        }
        assert_eq!(lines("a\r\nb"), "a\\r\nb");
    }

    #[test]
    fn an_error_has_a_sign_and_what_is_typed_has_letters() {
        for (written, read) in [
            ("0.5 +- 0.1", "0.5 \u{b1} 0.1"),
            ("+-2 deviations", "\u{b1}2 deviations"),
            ("--set r=0.1+-0.01", "--set r=0.1+-0.01"),
        ] {
            assert_eq!(signs(written), read);
        }
    }

    proptest! {
        #[test]
        fn nothing_but_printable_characters_remains(text in any::<String>()) {
            prop_assert!(line(&text).chars().all(is_printable));
            prop_assert!(lines(&text).chars().all(|char| char == '\n' || is_printable(char)));
        }

        #[test]
        fn a_document_keeps_its_content(
            text in prop::collection::vec(prop_oneof![any::<char>(), prop::char::range('\0', '\u{2070}')], 0..20)
        ) {
            let text: String = text.into_iter().collect();
            let document = serde_json::to_string(&text).unwrap();
            let shown = json(&document);
            prop_assert!(shown.chars().all(is_printable));
            prop_assert_eq!(serde_json::from_str::<String>(&shown).unwrap(), text);
        }
    }
}
