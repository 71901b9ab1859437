//! `hopfscope border`: where the basin changes its kind along D, while another parameter varies.

use clap::Args;

use super::failure::Failure;
use super::input::{self, Over};
use super::output::{Format, Output, print};
use super::start::Start;
use super::timing::timed;
use crate::export::{csv, json, table};
use crate::flow::Limits;
use crate::study::fold::{Border as Found, border};

/// Continues the fold `D_F` and the escape point `D_c` in a second parameter
#[derive(Debug, Args)]
pub struct Border {
    #[command(flatten)]
    start: Start,
    #[command(flatten)]
    output: Output,
    /// The second parameter (D2, D3 or r), its range, and how many values
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = input::over, allow_hyphen_values = true)]
    over: Over,
}

impl Border {
    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let parameters = self.start.problem()?.parameters;
        let Over { symbol, range, count } = self.over;
        let follow = || border(&parameters, symbol, range, count, &Limits::PATIENT);
        let (found, seconds) = timed(self.output.repeat, follow);
        let found: Found = found.map_err(|reason| {
            Failure::Unanswered(format!("the border could not be completed: {reason}"))
        })?;
        print(&match self.output.format {
            Format::Table => table::border(&found, seconds),
            Format::Json => json::border(&found, seconds),
            Format::Csv => csv::border(&found),
        })
    }
}
