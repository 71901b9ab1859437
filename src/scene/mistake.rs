//! Mistakes in files that people write: one line, `file:line:column: message`.

use std::fmt::Display;
use std::ops::Range;

use serde::de::Error as _;
use thiserror::Error;

use crate::words::{joined, printable};

/// A mistake in a file, and its place.
#[derive(Clone, Debug, Error)]
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

/// A complaint about a part of a text, given as a range of bytes: an empty one at its beginning until the place is known.
#[derive(Clone, Debug, Error)]
#[error("{message}")]
pub struct Complaint {
    pub at: Range<usize>,
    /// What is wrong and what is allowed, in one line.
    pub message: String,
}

/// A value, or a complaint.
pub type Result<T, E = Complaint> = std::result::Result<T, E>;

impl serde::de::Error for Complaint {
    fn custom<T: Display>(message: T) -> Self {
        let message = message.to_string();
        let lines = message.lines().map(str::trim).filter(|line| !line.is_empty());
        Complaint { at: 0..0, message: joined(lines, "; ") }
    }
}

impl From<toml::de::Error> for Complaint {
    fn from(error: toml::de::Error) -> Self {
        Complaint::custom(error.message()).or_at(error.span().unwrap_or_default())
    }
}

impl Complaint {
    /// The complaint, about this place unless it has one.
    pub fn or_at(self, at: Range<usize>) -> Self {
        if self.at == (0..0) {
            Complaint { at, ..self }
        } else {
            self
        }
    }

    /// The complaint as a [`FileMistake`] at the line and column where its range begins.
    pub fn in_file(self, file: &str, text: &str) -> FileMistake {
        let before = text.get(..self.at.start).unwrap_or(text);
        FileMistake {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before.chars().rev().take_while(|char| *char != '\n').count() + 1,
            message: self.message,
        }
    }
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
