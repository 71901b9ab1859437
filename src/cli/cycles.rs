//! `hopfscope cycles`: every limit cycle.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output, print};
use super::start::Start;
use super::timing::timed;
use crate::export::{csv, json, table};
use crate::flow::Limits;
use crate::study::cycle::cycles;

/// Finds every limit cycle, and what borders the basin of the sticking set
#[derive(Debug, Args)]
pub struct Cycles {
    #[command(flatten)]
    start: Start,
    #[command(flatten)]
    output: Output,
}

impl Cycles {
    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let problem = self.start.problem()?;
        let find = || cycles(&problem.parameters, false, &Limits::PATIENT);
        let (found, seconds) = timed(self.output.repeat, find);
        let found =
            found.map_err(|reason| Failure::Unanswered(format!("the search gave up: {reason}")))?;
        print(&match self.output.format {
            Format::Table => table::cycles(&found, seconds),
            Format::Json => json::cycles(&found, seconds),
            Format::Csv => csv::cycles(&found),
        })
    }
}
