//! `hopfscope trade`: error against cost of every method at all its tolerances, on one motion.

use clap::Args;

use super::failure::Failure;
use super::input;
use super::output::{Format, Output};
use super::start::StartOptions;
use super::timing::in_turn;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits};
use crate::report::trade as report;
use crate::study::trade::Trade as Found;
use crate::view::trade_plot::in_letters;

/// Shows what accuracy costs: every method at all its tolerances on the same motion
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene whose motion is computed
    #[arg(value_name = "SCENE", conflicts_with = "scene")]
    named: Option<String>,
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T", value_parser = input::until, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let scene = match &self.named {
            Some(name) => self.start.scene_named(name),
            None => self.start.scene(),
        };
        let mut problem = scene?.problem;
        problem.until = self.until.unwrap_or(problem.until);
        let trade = Found::of(&problem, &Limits::PATIENT).map_err(|reason| {
            Failure::Unanswered(format!("there is nothing to measure errors against: {reason}"))
        })?;
        let seconds = in_turn(self.output.repeat, trade.rows.len(), |index| {
            // A row that was given up used its whole budget; it is not repeated.
            let row = &trade.rows[index];
            row.error().map(|_| trajectory(&row.problem, Detail::default(), &Limits::PATIENT))
        });
        let timed = report::TimedTrade { trade, seconds };
        self.output.print(&match self.output.format {
            Format::Table => {
                let plot = in_letters(&timed.trade, &timed.seconds);
                report::table(&timed, &plot)
            }
            Format::Json => report::json(&timed),
            Format::Csv => report::csv(&timed),
        })
    }
}
