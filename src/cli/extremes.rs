//! `hopfscope extremes`: the accuracy of every method at the extremes of all parameters.

use clap::Args;
use rayon::prelude::*;

use super::failure::Failure;
use super::input;
use super::output::{Format, print, sourced};
use crate::accuracy::extremes::verdict::TOLERANCE;
use crate::accuracy::extremes::{Case, cases, judge, judge_set, named, sets};
use crate::flow::Limits;
use crate::model::Parameters;
use crate::report::{extreme_cycles, extremes};

/// Tests every method at the extremes of all parameters, and reports its accuracy
///
/// With --cycles, finds the limit cycles there instead.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, value_name = "FORMAT")]
    format: Format,
    /// Every motion of the lattice instead of every eleventh; every set of parameters instead of every seventh
    #[arg(long)]
    long: bool,
    /// The limit cycles at these parameters: their number, how well they close, or why the search gave up
    #[arg(long, conflicts_with = "tol")]
    cycles: bool,
    /// Relative error per step, 1e-15 .. 0.01 (default: 1e-10)
    #[arg(long, value_name = "X", value_parser = input::tolerance, default_value_t = TOLERANCE, hide_default_value = true)]
    tol: f64,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        if self.cycles {
            let sets: Vec<Parameters> = sets(!self.long).collect();
            let verdicts: Vec<_> =
                sets.par_iter().map(|set| judge_set(set, &Limits::PATIENT)).collect();
            let answer = match self.format {
                Format::Table => extreme_cycles::table(&verdicts),
                Format::Json => extreme_cycles::json(&verdicts),
                Format::Csv => extreme_cycles::csv(&verdicts),
            };
            return print(&sourced(self.format, &answer));
        }
        let cases: Vec<Case> = cases(!self.long).collect();
        let verdicts: Vec<_> =
            cases.par_iter().map(|case| judge(case, self.tol, &Limits::PATIENT)).collect();
        let answer = match self.format {
            Format::Table => extremes::table(&verdicts, &named(&Limits::PATIENT), self.tol),
            Format::Json => extremes::json(&verdicts, &named(&Limits::PATIENT), self.tol),
            Format::Csv => extremes::csv(&verdicts),
        };
        print(&sourced(self.format, &answer))
    }
}
