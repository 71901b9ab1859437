//! `hopfscope branch`: the limit cycles along a parameter.

use clap::Args;

use super::failure::Failure;
use super::input::{self, Over, read};
use super::machine::input as of_machine;
use super::machine::{MachineCase, print};
use super::output::{Certify, Format, Output};
use super::source::SourceOptions;
use super::timing::timed;
use crate::branch::along::{Points, branch};
use crate::flow::Limits;
use crate::proof::{self, ParameterBox};
use crate::report::{branch as report, certified, machine_branch};

/// Follows the limit cycles along a parameter, with folds and other special points
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// The parameter (D, D2, D3 or r, or a number of the machine), its range, and the number of points, which is
    /// approximate for D, D2, D3 and r
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", allow_hyphen_values = true)]
    over: String,
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
        if let Some(case) = self.source.portrayed()? {
            return self.of_machine(&case);
        }
        let over = read("--over", &self.over, parameter)?;
        let problem = self.source.start.problem()?;
        let (base, tolerance) = (&problem.parameters, problem.tolerance);
        let Over { knob: symbol, count, .. } = over;
        let range = over.range();
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

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let Over { knob, ends, count } = read("--over", &self.over, of_machine::range)?;
        let subject = &case.problem.subject;
        let (found, seconds) = timed(self.output.repeat, || {
            crate::branch::machine::branch(subject.clone(), knob, ends, count)
        });
        let found = found.map_err(Failure::Usage)?;
        let head = case.head();
        print(&self.output, machine_branch::branch(&head, subject, (knob, &found), seconds))
    }
}
