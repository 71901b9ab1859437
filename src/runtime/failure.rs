//! Why a command has no answer: one line for the user, and an exit code.

use std::path::Path;
use std::process::ExitCode;
use std::{fmt, io};

use thiserror::Error;

use super::standard::tell;

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

impl Failure {
    /// Wrong input.
    pub fn usage(line: impl Into<String>) -> Self {
        Failure::Usage(line.into())
    }

    /// A file that cannot be read, or holds what it should not.
    pub fn file(path: &Path, why: impl fmt::Display) -> Self {
        Failure::Usage(format!("{}: {why}", path.display()))
    }

    /// A file that cannot be written: wrong input if no file can have this path.
    pub fn unwritten(path: &Path, error: &io::Error) -> Self {
        let line = format!("{} not written: {error}", path.display());
        match error.kind() {
            io::ErrorKind::NotFound
            | io::ErrorKind::AlreadyExists
            | io::ErrorKind::NotADirectory
            | io::ErrorKind::IsADirectory
            | io::ErrorKind::InvalidFilename => Failure::Usage(line),
            _ => Failure::Unanswered(line),
        }
    }

    /// A file that was not written; `how` says how it can be replaced if it holds something else.
    pub fn not_replaced(path: &Path, error: &io::Error, how: Option<&str>) -> Self {
        match how {
            Some(how) if error.kind() == io::ErrorKind::AlreadyExists => {
                Failure::Usage(format!("{} holds something else; {how}", path.display()))
            }
            _ => Failure::unwritten(path, error),
        }
    }

    /// Prints the line to standard error.
    pub fn report(&self) -> ExitCode {
        let code = match self {
            Failure::Said(code) => return ExitCode::from(*code),
            Failure::Usage(_) => 2,
            Failure::Unanswered(_) => 1,
        };
        tell(self);
        ExitCode::from(code)
    }
}
