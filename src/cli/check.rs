//! `hopfscope check`: whether a certificate of limit cycles holds.

use std::path::PathBuf;

use clap::Args;

use super::failure::Failure;
use super::output::print;
use crate::check::check;
use crate::report::certified::certificate_table;
use crate::runtime::bounded;

/// Verifies, step by step, a certificate written by `cycles --certificate`
#[derive(Debug, Args)]
pub struct Arguments {
    /// The certificate
    #[arg(value_name = "FILE")]
    file: PathBuf,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let text = bounded::text(&self.file).map_err(|error| Failure::file(&self.file, &error))?;
        let refused = |why| Failure::Unanswered(format!("{}: refused, {why}", self.file.display()));
        print(&certificate_table(&check(&text).map_err(refused)?))
    }
}
