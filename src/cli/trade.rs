//! `hopfscope trade`: what accuracy costs.

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output, print};
use super::start::Start;
use super::timing::timed;
use super::trajectory::until;
use crate::export::trade;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits};
use crate::study::accuracy::{affordable, reference, row, settings};

/// Computes one motion by every method and setting: error against cost, and the best choices
#[derive(Debug, Args)]
pub struct Trade {
    /// Scene whose motion it is
    #[arg(value_name = "SCENE", conflicts_with = "scene")]
    named: Option<String>,
    #[command(flatten)]
    start: Start,
    #[command(flatten)]
    output: Output,
    /// Time at which to stop, 0 .. 1e9 (default: that of the scene)
    #[arg(long, value_name = "T", value_parser = until, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Trade {
    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        let name = self.named.as_deref().unwrap_or(&self.start.scene);
        let mut problem = self.start.scene_named(name)?.problem;
        problem.until = self.until.unwrap_or(problem.until);
        let limits = affordable(&Limits::PATIENT);
        let failed = |reason| Failure::Unanswered(format!("no motion to compare with: {reason}"));
        let reference = reference(&problem, &limits).map_err(failed)?;
        let measure = |setting| {
            // The arrivals alone are timed; what an error needs besides is made apart.
            let run = || trajectory(&setting, Detail::default(), &limits);
            let (_, seconds) = timed(self.output.repeat, run);
            row(&reference, &setting, &limits).map(|row| (row, seconds)).map_err(failed)
        };
        let rows = settings(&problem).into_iter().map(measure).collect::<Result<Vec<_>, _>>()?;
        print(&match self.output.format {
            Format::Table => trade::table(&reference, &rows, &trade::plain()),
            Format::Json => trade::json(&reference, &rows),
            Format::Csv => trade::csv(&rows),
        })
    }
}
