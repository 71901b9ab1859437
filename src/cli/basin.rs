//! `hopfscope basin`: where starts end, and how large a kick is survived.

use clap::Args;

use super::failure::Failure;
use super::input::{self, WINDOW, given};
use super::machine::input as of_machine;
use super::machine::{MachineCase, print};
use super::output::{Certify, Format, Output};
use super::source::SourceOptions;
use super::timing::timed;
use crate::flow::Limits;
use crate::portrait::basin::SurveyedBasin;
use crate::portrait::proved::agreed;
use crate::proof::kicks::kicks;
use crate::proof::{ParameterBox, prove};
use crate::report::{basin as report, certified, machine_motion};

/// Shows where the starts in a window end, and how large a kick is survived
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// Displacements and velocities of the starts (default: -3:3,-3:3; of a machine one and a half times its largest
    /// cycle, or its margin)
    #[arg(long, value_name = "QMIN:QMAX,VMIN:VMAX", allow_hyphen_values = true)]
    window: Option<String>,
    /// Number of starts, evenly spaced, including both ends of the window
    #[arg(long, value_name = "WxH", default_value = "320x384", value_parser = input::grid)]
    grid: (usize, usize),
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(case) = self.source.portrayed()? {
            return self.of_machine(&case);
        }
        let parameters = self.source.start.problem()?.parameters;
        let window = given("--window", self.window.as_ref(), input::window)?.unwrap_or(WINDOW);
        let survey = || SurveyedBasin::of(&parameters, &window, self.grid, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the basin could not be completed", survey)?;
        let enclose = || {
            let proof = prove(&ParameterBox::from(&parameters), &[]);
            let margin = &found.margin;
            let hints = [margin.displacement, margin.impulse, margin.from_rest.impulse];
            agreed(kicks(&proof, hints), &found)
        };
        let certified = self.certify.ask(enclose);
        let lines = certified.as_ref().map(certified::kicks_lines);
        self.output.print(&match self.output.format {
            Format::Table => report::table(&found, seconds) + &lines.unwrap_or_default(),
            Format::Json => report::json(&found, certified.as_ref(), seconds),
            Format::Csv => report::csv(&found, certified.as_ref()),
        })
    }

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let window = given("--window", self.window.as_ref(), of_machine::window)?;
        let (found, mut seconds) = case.portrait(&self.output)?;
        let window = window.unwrap_or_else(|| found.surroundings());
        let (counts, more) = timed(self.output.repeat, || found.count(&window, self.grid));
        seconds += more;
        let captured = found.rest_share(window.q, window.v);
        let (head, subject) = (case.head(), &case.problem.subject);
        let answer = machine_motion::basin(&head, subject, (&found, counts, captured), seconds);
        print(&self.output, answer)
    }
}
