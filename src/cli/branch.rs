//! `hopfscope branch`: the limit cycles along a parameter.

use clap::Args;

use super::failure::Failure;
use super::input::{self, Over};
use super::output::{Certify, Format, Output};
use super::start::StartOptions;
use crate::flow::Limits;
use crate::proof::{self, ParameterBox};
use crate::report::{branch as report, certified};
use crate::study::branch::{Points, branch};

/// Follows the limit cycles along a parameter, with folds and other special points
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// The parameter (D, D2, D3 or r), its range, and the approximate number of points
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = parameter, allow_hyphen_values = true)]
    over: Over,
}

/// A range of a parameter on which cycles depend.
fn parameter(text: &str) -> Result<Over, String> {
    let over = input::over(text)?;
    if !over.knob.is_parameter() {
        return Err(format!("cycles do not depend on {}; allowed: D, D2, D3, r", over.knob));
    }
    Ok(over)
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let problem = self.start.problem()?;
        let (base, tolerance) = (&problem.parameters, problem.tolerance);
        let Over { knob: symbol, count, .. } = self.over;
        let range = self.over.range();
        let follow =
            || branch(base, symbol, range, Points::Even(count), tolerance, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the branch could not be completed", follow)?;
        let decide = || proof::range::range(&ParameterBox::from(base), symbol, range);
        let certified = self.certify.ask(decide);
        let decided = certified.as_ref().map(|it| certified::range_table(it, symbol));
        self.output.print(&match self.output.format {
            Format::Table => {
                report::table(&found, base, tolerance, seconds) + &decided.unwrap_or_default()
            }
            Format::Json => report::json(&found, certified.as_ref(), seconds),
            Format::Csv => report::csv(&found, certified.as_ref()),
        })
    }
}
