//! Texts as one sets them: italic symbols with subscripts, powers raised, a true minus.
//!
//! The program writes `q_max`, `D3`, `1e-6` and `-r`, which every terminal and file can hold; print can hold more.

use std::sync::LazyLock;

use super::elements::{Slant, TextLevel, TextRun};
use crate::numerics::cells;
use crate::words::printable::signs;

const MINUS: &str = "\u{2212}";

const PRIME: &str = "\u{2032}";

/// The lines of `assets/symbols.txt`.
static SYMBOLS: LazyLock<Vec<[&str; 3]>> =
    LazyLock::new(|| include_str!("../../assets/symbols.txt").lines().filter_map(cells).collect());

/// A text as runs of letters that are set alike.
pub fn runs(text: &str) -> Vec<TextRun> {
    let text = signs(text);
    let mut setting = Setting { runs: Vec::new(), before: "" };
    while let Some(first) = text[setting.before.len()..].chars().next() {
        let rest = &text[setting.before.len()..];
        let length = match first {
            '0'..='9' => setting.number(rest),
            'a'..='z' | 'A'..='Z' => setting.word(rest),
            '-' => setting.hyphen(rest),
            '^' => setting.power(rest),
            _ => setting.plain(&rest[..first.len_utf8()]),
        };
        setting.before = &text[..setting.before.len() + length];
    }
    setting.runs
}

/// A text that is being set.
struct Setting<'a> {
    runs: Vec<TextRun>,
    /// What is set already, as it was written.
    before: &'a str,
}

/// Each function sets what a text begins with, and says how much of it that is.
impl Setting<'_> {
    fn add(&mut self, text: &str, slant: Slant, level: TextLevel) {
        match self.runs.last_mut().filter(|last| (last.slant, last.level) == (slant, level)) {
            Some(last) => last.text.push_str(text),
            None => self.runs.push(TextRun { text: text.to_owned(), slant, level }),
        }
    }

    fn plain(&mut self, text: &str) -> usize {
        self.add(text, Slant::Upright, TextLevel::Base);
        text.len()
    }

    /// A number; its exponent is a power of ten.
    fn number(&mut self, text: &str) -> usize {
        let length = leading(text, |char| char.is_ascii_digit() || char == '.');
        let (number, rest) = text.split_at(length);
        let exponent = rest.strip_prefix('e').map_or(0, whole);
        if exponent == 0 {
            return self.plain(number);
        }
        let factor = if number == "1" {
            String::new()
        } else {
            format!("{number}\u{b7}")
        };
        self.plain(&format!("{factor}10"));
        self.raised(&rest[1..=exponent]);
        length + 1 + exponent
    }

    fn power(&mut self, text: &str) -> usize {
        match whole(&text[1..]) {
            0 => self.plain("^"),
            length => {
                self.raised(&text[1..=length]);
                1 + length
            }
        }
    }

    fn raised(&mut self, number: &str) {
        self.add(&number.replace('-', MINUS), Slant::Upright, TextLevel::Above);
    }

    fn word(&mut self, text: &str) -> usize {
        let length = leading(text, |char| char.is_ascii_alphanumeric() || char == '_');
        let (word, rest) = text.split_at(length);
        let Some(symbol) = self.symbol(word) else { return self.plain(word) };
        let (letter, subscript) = symbol.split_once('_').unwrap_or((&symbol, ""));
        self.add(letter, Slant::Italic, TextLevel::Base);
        let primed = rest.starts_with('\'');
        if primed {
            self.add(PRIME, Slant::Upright, TextLevel::Base);
        }
        if !subscript.is_empty() {
            self.add(&subscript.replace('_', ","), Slant::Upright, TextLevel::Below);
        }
        length + usize::from(primed)
    }

    /// The symbol that a word is, with a low line before its subscript.
    fn symbol(&self, word: &str) -> Option<String> {
        let measures = |char: char| char.is_ascii_digit() || "[/".contains(char);
        let behind_a_number = self.before.trim_end().ends_with(measures);
        SYMBOLS.iter().find_map(|[written, symbol, when]| {
            let subscript = word.strip_prefix(written)?;
            let applies = match *when {
                "with a subscript" => !subscript.is_empty(),
                "not behind a number" => !behind_a_number || !subscript.is_empty(),
                _ => true,
            };
            let subscript = match subscript.chars().next() {
                Some('0'..='9') => format!("_{subscript}"),
                Some('_') | None => subscript.to_owned(),
                Some(_) => return None,
            };
            applies.then(|| format!("{symbol}{subscript}"))
        })
    }

    /// A minus before a number or a symbol, but a hyphen within a word or a date.
    fn hyphen(&mut self, text: &str) -> usize {
        let last = self.before.chars().next_back();
        let next = text[1..].chars().next();
        let digit = |char: Option<char>| char.is_some_and(|char| char.is_ascii_digit());
        let is_sign = last.is_none_or(|char| " ([=,/".contains(char)) && next != Some('-');
        let is_difference = digit(next) && !digit(last) && last != Some('-');
        self.plain(if is_sign || is_difference { MINUS } else { "-" });
        1
    }
}

/// How many letters at the beginning of a text are such; they are of one byte.
fn leading(text: &str, is_such: impl Fn(char) -> bool) -> usize {
    text.find(|char| !is_such(char)).unwrap_or(text.len())
}

/// Length of the whole number, with its sign, at the beginning of a text; 0 if there is none.
fn whole(text: &str) -> usize {
    let sign = usize::from(text.starts_with(['-', '+']));
    match leading(&text[sign..], |char| char.is_ascii_digit()) {
        0 => 0,
        digits => sign + digits,
    }
}
