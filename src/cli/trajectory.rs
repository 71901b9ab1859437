//! `hopfscope trajectory`: one motion.

use clap::Args;

use super::failure::Failure;
use super::input;
use super::output::{Certify, Format, Output};
use super::start::StartOptions;
use super::timing::timed;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Outcome, Problem};
use crate::numerics::Interval;
use crate::oscillator::State;
use crate::proof::ParameterBox;
use crate::proof::motion::{ProvedMotion, follow as enclosed};
use crate::report::{certified, trajectory as report};

/// Computes one motion: its turning points, how it ends, where its energy goes
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T", value_parser = input::until, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let mut problem = self.start.problem()?;
        problem.until = self.until.unwrap_or(problem.until);
        let follow = |energy| {
            let detail = Detail { energy, ..Detail::default() };
            trajectory(&problem, detail, &Limits::PATIENT)
        };
        // The energy ledger only checks the motion and is no part of its cost, so it is computed in a second run.
        let (mut motion, seconds) = timed(self.output.repeat, || follow(false));
        if !matches!(motion.outcome, Outcome::GaveUp { .. }) {
            motion = follow(true);
        }
        let State { q, v } = problem.initial;
        let enclose = || {
            let start = [q, v].map(Interval::point);
            enclosed(&ParameterBox::from(&problem.parameters), start, problem.until)
        };
        let certified = self.certify.ask(enclose);
        let line = |it: &ProvedMotion| certified::motion_line(it, problem.until);
        self.output.print(&match self.output.format {
            Format::Table => {
                report::table(&motion, seconds) + &certified.as_ref().map(line).unwrap_or_default()
            }
            Format::Json => report::json(&motion, certified.as_ref(), seconds),
            Format::Csv => report::csv(&motion, certified.as_ref()),
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
