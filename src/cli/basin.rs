//! `hopfscope basin`: where starts end, and how large a kick is survived.

use clap::Args;

use super::failure::Failure;
use super::input;
use super::output::{Certify, Format, Output};
use super::start::StartOptions;
use crate::flow::Limits;
use crate::proof::kicks::kicks;
use crate::proof::{ParameterBox, prove};
use crate::report::{basin as report, certified};
use crate::study::basin::{SurveyedBasin, Window};
use crate::study::proved::agreed;

/// Shows where the starts in a window end, and how large a kick is survived
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// Displacements and velocities of the starts
    #[arg(long, value_name = "QMIN:QMAX,VMIN:VMAX", default_value = "-3:3,-3:3",
          value_parser = input::window, allow_hyphen_values = true)]
    window: Window,
    /// Number of starts, evenly spaced, including both ends of the window
    #[arg(long, value_name = "WxH", default_value = "320x384", value_parser = input::grid)]
    grid: (usize, usize),
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let parameters = self.start.problem()?.parameters;
        let survey = || SurveyedBasin::of(&parameters, &self.window, self.grid, &Limits::PATIENT);
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
}
