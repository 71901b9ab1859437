//! `hopfscope trade`: error against cost of every method at all its tolerances, on one motion.

use clap::Args;

use super::failure::Failure;
use super::input::{self, given};
use super::machine::{MachineCase, print, troubled};
use super::output::{Format, Output};
use super::source::SourceOptions;
use super::timing::in_turn;
use crate::accuracy::machine_trade::MachineTrade;
use crate::accuracy::trade::Trade as Found;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Fate, Limits};
use crate::model::{Knob, MachineProblem};
use crate::report::{machine_motion, trade as report};
use crate::view::trade_plot::in_letters;

/// Shows what accuracy costs: every method at all its tolerances on the same motion
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene whose motion is computed
    #[arg(value_name = "SCENE", conflicts_with_all = ["scene", "machine"])]
    named: Option<String>,
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: Option<String>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let until = self.until.as_ref();
        if let Some(mut case) = self.source.machine()? {
            let end = given("--until", until, |text| Knob::Duration.parse(text))?;
            case.problem.until = end.unwrap_or(case.problem.until);
            return self.of_machine(&case.checked()?);
        }
        let start = &self.source.start;
        let scene = match &self.named {
            Some(name) => start.scene_named(name),
            None => start.scene(),
        };
        let mut problem = scene?.problem;
        problem.until = given("--until", until, input::until)?.unwrap_or(problem.until);
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

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let MachineProblem { subject, start, until, .. } = &case.problem;
        let model = subject.model().map_err(troubled)?;
        let trade = MachineTrade::new(&model, *start, *until);
        let seconds = in_turn(self.output.repeat, trade.points.len(), |index| {
            let motion = &trade.points[index].motion;
            MachineTrade::follow(&model, (motion.method, motion.tolerance), *start, *until)
        });
        let head = case.head();
        print(&self.output, machine_motion::trade(&head, &case.problem, &trade, &seconds))?;
        match trade.reference.outcome {
            Fate::Unknown(stop) => Err(troubled(stop)),
            _ => Ok(()),
        }
    }
}
