//! `hopfscope replay`: a keystroke file, run without a terminal.

use std::path::PathBuf;

use clap::Args;

use super::failure::Failure;
use crate::session::replay::parse;

/// Runs a keystroke file without a terminal and prints the last screen
#[derive(Debug, Args)]
pub struct Replay {
    /// Keystroke file
    #[arg(value_name = "FILE")]
    file: PathBuf,
}

impl Replay {
    /// Runs the file.
    pub fn run(&self) -> Result<(), Failure> {
        let text = std::fs::read_to_string(&self.file)
            .map_err(|error| Failure::file(&self.file, &error))?;
        parse(&text)
            .map_err(|error| Failure::Usage(format!("{}: {error}", self.file.display())))?;
        Err(Failure::Unanswered("replay is not in this build".to_owned()))
    }
}
