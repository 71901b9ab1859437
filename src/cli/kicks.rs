//! `hopfscope kicks`: what fraction of random kicks is lost, and how many in a row are survived.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output};
use super::start::StartOptions;
use crate::flow::Limits;
use crate::report::kicks;
use crate::study::kicks::RandomKick as Distribution;
use crate::study::repeated::repeated;

/// Finds the share of random kicks that is lost, and how many in a row are survived
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    /// Displacement and velocity of a kick, mean and standard deviation; with uniform: before them, mean and
    /// half width
    #[arg(
        long = "kicks",
        value_name = "q=MEAN+-SPREAD,v=MEAN+-SPREAD",
        allow_hyphen_values = true
    )]
    law: Distribution,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let parameters = self.start.problem()?.parameters;
        let follow = || repeated(&parameters, &self.law, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the kicks could not be followed", follow)?;
        self.output.print(&match self.output.format {
            Format::Table => kicks::table(&parameters, &self.law, &found, seconds),
            Format::Json => kicks::json(&parameters, &self.law, &found, seconds),
            Format::Csv => kicks::csv(&parameters, &found),
        })
    }
}
