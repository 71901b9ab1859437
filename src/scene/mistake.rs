//! Mistakes in files that people write: one line, `file:line:column: message`.

use std::ops::Range;

use serde::de::DeserializeOwned;
use thiserror::Error;

use crate::words::printable;

/// A mistake in a file, and its place.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}:{line}:{column}: {}", printable::line(.file), printable::line(.message))]
pub struct FileMistake {
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what is allowed, in one line.
    pub message: String,
}

/// A complaint about a part of a text, given as a range of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    pub at: Range<usize>,
    /// What is wrong and what is allowed, in one line.
    pub message: String,
}

impl Complaint {
    /// The complaint of the library, joined into one line; it is about `at` unless it has a place itself.
    pub fn new(error: &toml::de::Error, at: Range<usize>) -> Self {
        let lines = error.message().lines().map(str::trim).filter(|line| !line.is_empty());
        let message = lines.collect::<Vec<_>>().join("; ");
        Complaint { at: error.span().unwrap_or(at), message }
    }

    /// The complaint as a [`FileMistake`] at the line and column where its range begins.
    pub fn in_file(self, file: &str, text: &str) -> FileMistake {
        let before = text.get(..self.at.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        FileMistake {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            message: self.message,
        }
    }
}

/// Reads a TOML file. Fails with the first mistake as a [`FileMistake`].
pub fn toml<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, FileMistake> {
    toml::from_str(text).map_err(|error| Complaint::new(&error, 0..0).in_file(file, text))
}

/// Names and texts of TOML files of the program in one folder.
macro_rules! texts {
    ($folder:literal: $($name:literal)+) => {
        [$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), $folder, $name, ".toml")))),+]
    };
}
pub(super) use texts;

/// What files of the program hold, by their names and texts.
///
/// # Panics
/// Never: tests read every file.
pub fn built_in<T>(
    files: &[(&str, &str)],
    parse: impl Fn(&str, &str, &str) -> Result<T, FileMistake>,
) -> Vec<T> {
    let read = |(name, text): &(&str, &str)| match parse(name, &format!("{name}.toml"), text) {
        Ok(found) => found,
        Err(error) => unreachable!("a file of the program is broken: {error}"),
    };
    files.iter().map(read).collect()
}
