//! `hopfscope kicks`: what fraction of random kicks is lost, and how many in a row are survived.

use clap::Args;

use super::failure::Failure;
use super::input::read;
use super::machine::input as of_machine;
use super::machine::{MachineCase, print};
use super::output::{Format, Output};
use super::source::SourceOptions;
use crate::flow::Limits;
use crate::portrait::kicks::RandomKick;
use crate::portrait::kicks::repeated::repeated;
use crate::portrait::kicks::repeated::repeated_by;
use crate::report::kicks;

/// Finds the share of random kicks that is lost, and how many in a row are survived
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    /// Displacement and velocity of a kick, mean and standard deviation; with uniform: before them, mean and
    /// half width
    #[arg(
        long = "kicks",
        value_name = "q=MEAN+-SPREAD,v=MEAN+-SPREAD",
        allow_hyphen_values = true
    )]
    law: String,
}

/// What begins the message of a failure.
const FAILED: &str = "the kicks could not be followed";

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(case) = self.source.portrayed()? {
            return self.of_machine(&case);
        }
        let law: RandomKick = read("--kicks", &self.law, str::parse)?;
        let parameters = self.source.start.problem()?.parameters;
        let follow = || repeated(&parameters, &law, &Limits::PATIENT);
        let (found, seconds) = self.output.timed(FAILED, follow)?;
        self.output.print(&match self.output.format {
            Format::Table => kicks::table(&parameters, &law, &found, seconds),
            Format::Json => kicks::json(&parameters, &law, &found, seconds),
            Format::Csv => kicks::csv(&parameters, &found),
        })
    }

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let law = read("--kicks", &self.law, of_machine::kicks)?;
        let (portrait, before) = case.portrait(&self.output)?;
        let follow = || repeated_by(&portrait, &law);
        let (found, seconds) = self.output.timed(FAILED, follow)?;
        let (head, held) = (case.head(), portrait.model.guide_static);
        let answer = (&law, &found, held);
        let subject = &case.problem.subject;
        print(&self.output, kicks::of_machine(&head, subject, answer, before + seconds))
    }
}
