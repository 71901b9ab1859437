//! Words for numbers, quantities and answers, the same on the screen, in tables and in figures.

pub mod claim;
pub mod fit;
pub mod level;
pub mod motion;
pub mod number;
pub mod printable;
pub mod provenance;
pub mod usage;

pub use self::{motion::Notation, number::*};

use std::borrow::Cow;
use std::fmt::Display;
use std::path::Path;

use textwrap::{Options, WordSplitter};

/// `no limit cycle`, `1 cycle`, `2 cycles`.
pub fn cycles(count: usize) -> String {
    match count {
        0 => "no limit cycle".to_owned(),
        some => counted(some, "cycle"),
    }
}

/// `12 samples` or `1 sample`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Parts of a sentence, with this between them.
pub fn joined(parts: impl IntoIterator<Item: Display>, between: &str) -> String {
    let parts = parts.into_iter().map(|part| part.to_string());
    parts.collect::<Vec<_>>().join(between)
}

/// Whether a file has this ending, in small letters or capitals.
pub fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// `stable` or `unstable`.
pub fn stability(stable: bool) -> &'static str {
    if stable { "stable" } else { "unstable" }
}

/// A text in lines of at most `width` columns, broken between words where possible.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let options = Options::new(width).break_words(false).word_splitter(WordSplitter::NoHyphenation);
    textwrap::wrap(text.trim(), options).into_iter().map(Cow::into_owned).collect()
}

/// The value of the row with this name. Fails with one line that names all rows; `what` they are may be empty.
pub fn one_of<'a, T>(
    what: &str,
    name: &str,
    rows: impl IntoIterator<Item = (&'a str, T)>,
) -> Result<T, String> {
    let mut names = Vec::new();
    for (known, value) in rows {
        if known == name {
            return Ok(value);
        }
        names.push(known);
    }
    let blank = if what.is_empty() { "" } else { " " };
    Err(format!("no {what}{blank}{name:?}; there are {}", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_whole_and_lines_within_their_width() {
        let text = "one two three four-five six";
        assert_eq!(wrapped(text, 9), ["one two", "three", "four-five", "six"]);
        assert_eq!(wrapped("", 9), [""]);
        assert_eq!(wrapped("incomprehensible", 3), ["incomprehensible"]);
    }
}
