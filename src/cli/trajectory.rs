//! `hopfscope trajectory`: one motion.

use clap::Args;

use super::failure::Failure;
use super::input;
use super::output::{Format, Output, print};
use super::start::Start;
use super::timing::timed;
use crate::export::{csv, json, table};
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Outcome, Problem};

/// Follows one motion: its turning points, how it ends, where the energy went
#[derive(Debug, Args)]
pub struct Trajectory {
    #[command(flatten)]
    start: Start,
    #[command(flatten)]
    output: Output,
    /// Time at which to stop, 0 .. 1e9 (default: that of the scene)
    #[arg(long, value_name = "T", value_parser = input::until, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Trajectory {
    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        let mut problem = self.start.problem()?;
        problem.until = self.until.unwrap_or(problem.until);
        let follow = |energy| {
            let detail = Detail { energy, ..Detail::default() };
            trajectory(&problem, detail, &Limits::PATIENT)
        };
        // The ledger is a check on the motion and no part of what it costs: it is made apart.
        let (mut motion, seconds) = timed(self.output.repeat, || follow(false));
        if !matches!(motion.outcome, Outcome::GaveUp { .. }) {
            motion = follow(true);
        }
        print(&match self.output.format {
            Format::Table => table::trajectory(&motion, seconds),
            Format::Json => json::trajectory(&motion, seconds),
            Format::Csv => csv::trajectory(&motion),
        })?;
        match motion.outcome {
            Outcome::GaveUp { tau, reason } => {
                let Problem { until, .. } = problem;
                Err(Failure::Unanswered(format!("gave up at tau = {tau:?} of {until:?}: {reason}")))
            }
            _ => Ok(()),
        }
    }
}
