//! Texts as one sets them: italic symbols with subscripts, powers raised, a true minus.
//!
//! The program writes `q_max`, `D3`, `1e-6` and `-r`, which every terminal and file can hold; print can hold more.

use std::sync::LazyLock;

use crate::numerics::cells;
use crate::words::printable::signs;

const MINUS: &str = "\u{2212}";

const PRIME: &str = "\u{2032}";

/// The lines of `assets/symbols.txt`.
static SYMBOLS: LazyLock<Vec<[&str; 3]>> =
    LazyLock::new(|| include_str!("../../assets/symbols.txt").lines().filter_map(cells).collect());

/// A part of a text whose letters are set alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextRun {
    pub text: String,
    pub setting: LetterStyle,
}

/// How letters are set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LetterStyle {
    Upright,
    Italic,
    Subscript,
    Superscript,
}

impl LetterStyle {
    /// Size of the letters, and how far they stand below the base line, in a text of this size. No letter is smaller
    /// than 6 where those beside it are not.
    pub fn of(self, size: f64) -> (f64, f64) {
        let smaller = (0.72 * size).max(size.min(6.0));
        match self {
            LetterStyle::Upright | LetterStyle::Italic => (size, 0.0),
            LetterStyle::Subscript => (smaller, 0.2 * size),
            LetterStyle::Superscript => (smaller, -0.36 * size),
        }
    }
}

/// A text as runs of letters that are set alike.
pub fn runs(text: &str) -> Vec<TextRun> {
    let (text, mut runs, mut done) = (signs(text), Vec::new(), 0);
    while done < text.len() {
        let (before, rest) = text.split_at(done);
        done += match rest.as_bytes()[0] {
            b'e' | b'^' if before.ends_with(is_digit) && whole(&rest[1..]) > 0 => {
                let power = &rest[1..=whole(&rest[1..])];
                add(
                    &mut runs,
                    LetterStyle::Upright,
                    if rest.starts_with('e') { "\u{b7}10" } else { "" },
                );
                add(&mut runs, LetterStyle::Superscript, &power.replace('-', MINUS));
                1 + power.len()
            }
            b'a'..=b'z' | b'A'..=b'Z' => word(&mut runs, rest),
            b'-' if is_minus(before, rest) => {
                add(&mut runs, LetterStyle::Upright, MINUS);
                1
            }
            _ => {
                let length = rest.chars().next().map_or(1, char::len_utf8);
                add(&mut runs, LetterStyle::Upright, &rest[..length]);
                length
            }
        };
    }
    runs
}

fn add(runs: &mut Vec<TextRun>, setting: LetterStyle, text: &str) {
    match runs.last_mut().filter(|last| last.setting == setting) {
        Some(last) => last.text += text,
        None => runs.push(TextRun { text: text.to_owned(), setting }),
    }
}

/// Sets the word that a text begins with, and the prime behind it if it is a symbol, and says how long that is.
fn word(runs: &mut Vec<TextRun>, text: &str) -> usize {
    let length = leading(text, |char| char.is_ascii_alphanumeric() || char == '_');
    let (word, rest) = text.split_at(length);
    let Some([_, letter, subscript]) = SYMBOLS.iter().find(|[written, ..]| *written == word) else {
        add(runs, LetterStyle::Upright, word);
        return length;
    };
    add(runs, LetterStyle::Italic, letter);
    let prime = rest.starts_with('\'');
    if prime {
        add(runs, LetterStyle::Upright, PRIME);
    }
    if *subscript != "-" {
        add(runs, LetterStyle::Subscript, subscript);
    }
    length + usize::from(prime)
}

/// Whether the hyphen that a text begins with is a minus: before a number or a symbol, but not within a word or a date.
fn is_minus(before: &str, text: &str) -> bool {
    let begins = before.is_empty() || before.ends_with([' ', '(', '[', '=', ',', '/']);
    let differs = text[1..].starts_with(is_digit) && !before.ends_with(is_digit);
    !text.starts_with("--") && !before.ends_with(['-', '+']) && (begins || differs)
}

fn is_digit(char: char) -> bool {
    char.is_ascii_digit()
}

/// How many letters at the beginning of a text are such; they are of one byte.
fn leading(text: &str, is_such: impl Fn(char) -> bool) -> usize {
    text.find(|char| !is_such(char)).unwrap_or(text.len())
}

/// Length of the whole number, with its sign, at the beginning of a text; 0 if there is none.
fn whole(text: &str) -> usize {
    let sign = usize::from(text.starts_with(['-', '+']));
    let digits = leading(&text[sign..], is_digit);
    if digits == 0 { 0 } else { sign + digits }
}
