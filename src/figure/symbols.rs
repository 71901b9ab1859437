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
    pub setting: Setting,
}

/// How letters are set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    Upright,
    Italic,
    Subscript,
    Superscript,
}

impl Setting {
    /// Size of the letters, and how far they stand below the base line, in a text of this size. No letter is smaller
    /// than 6 where those beside it are not.
    pub fn of(self, size: f64) -> (f64, f64) {
        let smaller = (0.72 * size).max(size.min(6.0));
        match self {
            Setting::Upright | Setting::Italic => (size, 0.0),
            Setting::Subscript => (smaller, 0.2 * size),
            Setting::Superscript => (smaller, -0.36 * size),
        }
    }
}

/// A text as runs of letters that are set alike.
pub fn runs(text: &str) -> Vec<TextRun> {
    let text = signs(text);
    let mut composer = Composer::default();
    while composer.done < text.len() {
        let (before, rest) = text.split_at(composer.done);
        composer.done += match rest.as_bytes()[0] {
            b'e' | b'^' if before.ends_with(is_digit) && whole(&rest[1..]) > 0 => {
                composer.plain(if rest.starts_with('e') { "\u{b7}10" } else { "" });
                1 + composer.raised(&rest[1..])
            }
            b'a'..=b'z' | b'A'..=b'Z' => composer.word(rest),
            b'-' => composer.plain(if is_minus(before, rest) { MINUS } else { "-" }).min(1),
            _ => composer.plain(&rest[..rest.chars().next().map_or(1, char::len_utf8)]),
        };
    }
    composer.runs
}

/// Sets a text. Each of its functions sets what a text begins with, and says how long that is.
#[derive(Default)]
struct Composer {
    runs: Vec<TextRun>,
    /// How much of the text is set.
    done: usize,
}

impl Composer {
    fn add(&mut self, text: &str, setting: Setting) {
        match self.runs.last_mut().filter(|last| last.setting == setting) {
            Some(last) => last.text += text,
            None => self.runs.push(TextRun { text: text.to_owned(), setting }),
        }
    }

    fn plain(&mut self, text: &str) -> usize {
        self.add(text, Setting::Upright);
        text.len()
    }

    /// A whole number as a power.
    fn raised(&mut self, text: &str) -> usize {
        let length = whole(text);
        self.add(&text[..length].replace('-', MINUS), Setting::Superscript);
        length
    }

    fn word(&mut self, text: &str) -> usize {
        let length = leading(text, |char| char.is_ascii_alphanumeric() || char == '_');
        let (word, rest) = text.split_at(length);
        let Some((letter, subscript)) = symbol(word) else { return self.plain(word) };
        self.add(letter, Setting::Italic);
        let prime = rest.starts_with('\'');
        if prime {
            self.plain(PRIME);
        }
        if !subscript.is_empty() {
            self.add(&subscript, Setting::Subscript);
        }
        length + usize::from(prime)
    }
}

/// The symbol that a word is, and its subscript. What stands alone as a word may be a symbol only with one.
fn symbol(word: &str) -> Option<(&'static str, String)> {
    SYMBOLS.iter().find_map(|[written, letter, alone]| {
        let subscript = word.strip_prefix(written)?;
        let ends = match subscript {
            "" => *alone == "alone",
            "c" => true,
            _ => !subscript.starts_with(char::is_alphabetic),
        };
        ends.then(|| (*letter, subscript.trim_start_matches('_').replace('_', ",")))
    })
}

/// Whether the hyphen that a text begins with is a minus: before a number or a symbol, but not within a word or a date.
fn is_minus(before: &str, text: &str) -> bool {
    let begins = before.is_empty() || before.ends_with([' ', '(', '[', '=', ',', '/']);
    let differs = text[1..].starts_with(is_digit) && !before.ends_with(is_digit);
    !text.starts_with("--") && !before.ends_with('-') && (begins || differs)
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
