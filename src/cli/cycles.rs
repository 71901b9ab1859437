//! `hopfscope cycles`: every limit cycle.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output, print};
use super::start::Start;
use super::timing::timed;
use crate::closed_form::harmonics::MOST;
use crate::export::{balance, csv, json, table};
use crate::flow::{Limits, Reason};
use crate::oscillator::Parameters;
use crate::proof::cycles::Proof;
use crate::study;
use crate::study::cycle::cycles;
use crate::study::harmonic_error::{HarmonicBalance, convergence};
use crate::study::proved::proved;

/// Finds every limit cycle and proves that there are no others; says what borders the basin
#[derive(Debug, Args)]
pub struct Cycles {
    #[command(flatten)]
    start: Start,
    #[command(flatten)]
    output: Output,
    /// Shows the harmonic balance beside the cycles: 1, 3, 5, .. up to N harmonics, and their errors
    #[arg(long, value_name = "N", value_parser = harmonics)]
    harmonics: Option<usize>,
}

/// A number of harmonics.
fn harmonics(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|number| (1..=MOST).contains(number));
    number.ok_or_else(|| format!("{text:?} is not a whole number in 1 .. {MOST}"))
}

impl Cycles {
    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let problem = self.start.problem()?;
        let (found, seconds) = timed(self.output.repeat, || self.find(&problem.parameters));
        let Answer { found, proof, rungs } = found?;
        let rungs = rungs.as_deref();
        print(&match self.output.format {
            Format::Table => {
                table::cycles(&found, &proof, seconds)
                    + &rungs.map(balance::table).unwrap_or_default()
            }
            Format::Json => json::cycles(&found, &proof, rungs, seconds),
            Format::Csv => rungs.map_or_else(|| csv::cycles(&found), balance::csv),
        })
    }

    /// The cycles, their proof, and the harmonic balance if asked for.
    fn find(&self, parameters: &Parameters) -> Result<Answer, Failure> {
        let limits = &Limits::PATIENT;
        let gave_up = |reason: Reason| Failure::Unanswered(format!("the search gave up: {reason}"));
        let found = cycles(parameters, false, limits).map_err(gave_up)?;
        let proof = proved(&found).map_err(|wrong| Failure::Unanswered(wrong.to_string()))?;
        let compare = |most| convergence(parameters, &found.cycles, most, limits);
        let rungs = self.harmonics.map(compare).transpose().map_err(gave_up)?;
        Ok(Answer { found, proof, rungs })
    }
}

/// What the command answers.
struct Answer {
    found: study::Cycles,
    proof: Proof,
    rungs: Option<Vec<HarmonicBalance>>,
}
