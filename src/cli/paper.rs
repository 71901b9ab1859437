//! `hopfscope paper`: the claims of the paper compared with computation.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output};
use super::timing::timed;
use crate::flow::Limits;
use crate::paper::examine_all;
use crate::report::claims;

/// Tests every equation and claim of the paper that can be tested
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let (examined, seconds) = timed(self.output.repeat, || examine_all(&Limits::PATIENT));
        let examined = examined
            .map_err(|reason| Failure::Unanswered(format!("the examination gave up: {reason}")))?;
        self.output.print_list(&match self.output.format {
            Format::Table => claims::table(&examined, seconds),
            Format::Json => claims::json(&examined, seconds),
            Format::Csv => claims::csv(&examined),
        })
    }
}
