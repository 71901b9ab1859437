//! `hopfscope margin`: the size up to which kicks are survived for certain.

use clap::Args;

use super::failure::Failure;
use super::input::{self, given};
use super::machine::input as of_machine;
use super::machine::{MachineCase, print, troubled};
use super::output::{Format, Output};
use super::source::SourceOptions;
use super::timing::timed;
use crate::flow::Limits;
use crate::model::MachineProblem;
use crate::portrait::guarantee::machine::guaranteed;
use crate::report::{guarantee, machine_motion};

/// Finds how large a kick is survived under every bounded disturbance, at all parameters in a box
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceOptions,
    /// Bound on the disturbing force, in the units of r; of a machine a force, such as "0.1 N"
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    disturbance: Option<String>,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let disturbance = self.disturbance.as_ref();
        if let Some(mut case) = self.source.portrayed()? {
            let force = given("--disturbance", disturbance, of_machine::disturbance)?;
            let known = &mut case.problem.tolerances;
            known.disturbance = force.unwrap_or(known.disturbance);
            return self.of_machine(&case.checked()?);
        }
        let known = self.source.start.known()?;
        let bound = given("--disturbance", disturbance, input::disturbance)?.unwrap_or(0.0);
        let ask =
            || crate::portrait::guarantee::oscillator::guarantee(&known, bound, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the margin could not be computed", ask)?;
        self.output.print(&match self.output.format {
            Format::Table => guarantee::table(&found, seconds),
            Format::Json => guarantee::json(&found, seconds),
            Format::Csv => guarantee::csv(&found),
        })
    }

    /// Answers about a machine; what is known exactly has its own margin for certain.
    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let MachineProblem { subject, tolerances, .. } = &case.problem;
        let (found, mut seconds) = case.portrait(&self.output)?;
        let certain = match subject.of_belt().filter(|_| !tolerances.is_none()) {
            None => Ok(found.margin),
            Some(belt) => {
                let (certain, more) = timed(self.output.repeat, || guaranteed(belt, tolerances));
                seconds += more;
                certain.map_err(troubled)?
            }
        };
        let head = case.head();
        let answer = machine_motion::margin(&head, &case.problem, &found, certain, seconds);
        print(&self.output, answer)
    }
}
