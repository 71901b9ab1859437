//! `hopfscope margin`: the size up to which kicks are survived for certain.

use clap::Args;

use super::failure::Failure;
use super::input;
use super::output::{Format, Output};
use crate::flow::Limits;
use crate::oscillator::{Interval, Knob, ParameterBox};
use crate::report::guarantee;
use crate::scene::library::{PLAIN, find};
use crate::study;

/// Finds how large a kick is survived under every bounded disturbance, at all parameters in a box
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scene to start from
    #[arg(long, value_name = "NAME", default_value = PLAIN)]
    scene: String,
    /// Sets D, D2, D3 or r to a number, to VALUE+-HALFWIDTH or to LOW..HIGH; repeatable
    #[arg(long, value_name = "NAME=INTERVAL", value_parser = input::assigned, allow_hyphen_values = true)]
    set: Vec<(Knob, Interval)>,
    /// Bound on the disturbing force, in the units of r
    #[arg(long, value_name = "W", default_value = "0", value_parser = input::disturbance,
          allow_hyphen_values = true)]
    disturbance: f64,
    #[command(flatten)]
    output: Output,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let scene = find(&self.scene).map_err(Failure::Usage)?;
        let mut known = ParameterBox::from(&scene.problem.parameters);
        for &(symbol, interval) in &self.set {
            known.set(symbol, interval).map_err(Failure::Usage)?;
        }
        let ask = || study::guarantee::guarantee(&known, self.disturbance, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the margin could not be computed", ask)?;
        self.output.print(&match self.output.format {
            Format::Table => guarantee::table(&found, seconds),
            Format::Json => guarantee::json(&found, seconds),
            Format::Csv => guarantee::csv(&found),
        })
    }
}
