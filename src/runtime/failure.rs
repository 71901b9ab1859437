//! Why a command has no answer: one line for the user, and an exit code.

use std::fmt;
use std::io::{self, ErrorKind};
use std::path::Path;

use thiserror::Error;

use super::tell;

/// The answer of a command, or why there is none.
pub type Result<T, E = Failure> = std::result::Result<T, E>;

/// Why a command has no answer.
#[derive(Debug, Error)]
pub enum Failure {
    /// The input is wrong; exit code 2.
    #[error("{0}")]
    Usage(String),
    /// The answer could not be computed or shown; exit code 1.
    #[error("{0}")]
    Unanswered(String),
    /// All has been said; this is the exit code.
    #[error("exit code {0}")]
    Said(u8),
}

/// A line that says what is wrong with something is about the input; what could not be computed is [`Failure::unanswered`].
impl From<String> for Failure {
    fn from(line: String) -> Self {
        Failure::Usage(line)
    }
}

impl From<&str> for Failure {
    fn from(line: &str) -> Self {
        Failure::Usage(line.to_owned())
    }
}

/// Errors that say that no file can be made at a path.
const NO_FILE: [ErrorKind; 5] = [
    ErrorKind::NotFound,
    ErrorKind::AlreadyExists,
    ErrorKind::NotADirectory,
    ErrorKind::IsADirectory,
    ErrorKind::InvalidFilename,
];

impl Failure {
    /// What could not be computed or shown, and why.
    pub fn unanswered(what: impl fmt::Display, why: impl fmt::Display) -> Self {
        Failure::Unanswered(format!("{what}: {why}"))
    }

    /// A file that cannot be read, or holds what it should not.
    pub fn file(path: &Path, why: impl fmt::Display) -> Self {
        Failure::Usage(format!("{}: {why}", path.display()))
    }

    /// Why a file is not written, by the error.
    pub fn unwritten(path: &Path) -> impl Fn(io::Error) -> Self + Copy {
        |error| Failure::not_replaced(path, &error, None)
    }

    /// Why a file is not written, by the error: wrong input if no file can be made at this path, or if the file holds
    /// something else; `how` says how that can be replaced.
    pub fn not_replaced(path: &Path, error: &io::Error, how: Option<&str>) -> Self {
        let name = path.display();
        let line = format!("{name} not written: {error}");
        match (error.kind(), how) {
            (ErrorKind::AlreadyExists, Some(how)) => {
                Failure::Usage(format!("{name} already exists; {how}"))
            }
            (kind, _) if NO_FILE.contains(&kind) => Failure::Usage(line),
            _ => Failure::Unanswered(line),
        }
    }

    /// Prints the line to standard error; returns the exit code.
    pub fn report(&self) -> u8 {
        let code = match self {
            Failure::Said(code) => return *code,
            Failure::Usage(_) => 2,
            Failure::Unanswered(_) => 1,
        };
        tell(self);
        code
    }
}

/// The exit code of a program that was ended by a signal.
pub fn exit_code(signal: i32) -> u8 {
    u8::try_from(128 + signal).unwrap_or(u8::MAX)
}
