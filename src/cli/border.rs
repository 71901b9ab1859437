//! `hopfscope border`: where the basin changes its kind along D, while another parameter varies.

use clap::Args;
use rayon::prelude::*;

use super::failure::Failure;
use super::input::{self, Over};
use super::output::{Certify, Format, Output};
use super::start::StartOptions;
use crate::flow::Limits;
use crate::oscillator::{Knob, State};
use crate::proof::ParameterBox;
use crate::proof::escape::enclose_escape;
use crate::proof::fold::enclose_fold;
use crate::proof::range::change_near;
use crate::report::border as report;
use crate::report::certified::{self, BorderProof};
use crate::study::fold::{Boundary as Found, BoundaryPoint, border};

/// Continues the fold `D_F` and the escape point `D_c` in a second parameter
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// The second parameter (D2, D3 or r), its range, and the number of values
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = second, allow_hyphen_values = true)]
    over: Over,
}

/// Reads the second parameter. The border is located along D and does not depend on the start of a motion.
fn second(text: &str) -> Result<Over, String> {
    let over = input::over(text)?;
    let name = over.knob.spec().name;
    match over.knob {
        Knob::D2 | Knob::D3 | Knob::R => Ok(over),
        _ => Err(format!(
            "the border is a value of D over another parameter, not over {name}: D2, D3 or r"
        )),
    }
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.start.note_own_method();
        let parameters = self.start.problem()?.parameters;
        let Over { knob: symbol, count, .. } = self.over;
        let range = self.over.range();
        let follow = || border(&parameters, symbol, range, count, &Limits::PATIENT);
        let (found, seconds) = self.output.timed("the boundary could not be completed", follow)?;
        let certified = self.certify.ask(|| enclosed(&found));
        let lines = certified.as_ref().map(|it| certified::border_lines(it, symbol));
        self.output.print(&match self.output.format {
            Format::Table => report::table(&found, seconds) + &lines.unwrap_or_default(),
            Format::Json => report::json(&found, certified.as_deref(), seconds),
            Format::Csv => report::csv(&found, certified.as_deref()),
        })
    }
}

/// The fold and the escape point in D at each point of a border, enclosed.
fn enclosed(found: &Found) -> Vec<BorderProof> {
    let nowhere = State { q: 0.0, v: 0.0 };
    let at = |point: &BoundaryPoint| {
        let mut parameters = found.parameters;
        found.second.set(&mut parameters, &mut nowhere.clone(), point.value);
        let known = ParameterBox::from(&parameters);
        // Where two cycles do not merge smoothly, as at a grazing, only the change in the number of cycles can be
        // enclosed.
        let changes = |d: f64| Some(change_near(&known, Knob::D, d)?.between);
        let fold = point.fold.and_then(|fold| {
            let clearance = fold.q_max - parameters.r;
            let met = enclose_fold(&known, Knob::D, fold.d, clearance).map(|met| met.value);
            met.or_else(|| changes(fold.d))
        });
        let escape =
            point.escape.and_then(|d| enclose_escape(&known, Knob::D, d).or_else(|| changes(d)));
        BorderProof::new(point, fold, escape)
    };
    found.points.par_iter().map(at).collect()
}
