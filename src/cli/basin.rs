//! `hopfscope basin`: where starts end, the curves that belong to it, and all of it as arrays.

use clap::{Args, ValueEnum};

use super::input::{self, WINDOW};
use super::{CERTIFY, Failure, QuestionOptions, Result, given};
use crate::flow::Limits;
use crate::model::State;
use crate::portrait::closing::return_map::return_map;
use crate::portrait::{Counts, Margin, Portrait, StartWindow, proved_kicks};
use crate::report::arrays::Array;
use crate::report::margin::basin;
use crate::report::{About, Answer};

/// Shows where the starts in a window end, and how large a kick is survived
#[derive(Args)]
pub struct BasinCommand {
    #[arg(long, help = CERTIFY)]
    certify: bool,
    /// Displacements and velocities of the starts (default: -3:3,-3:3; of a machine one and a half times its largest
    /// cycle, or its margin)
    #[arg(long, value_name = "QMIN:QMAX,VMIN:VMAX")]
    window: Option<String>,
    /// Number of starts, evenly spaced, including both ends of the window
    #[arg(long, value_name = "WxH", default_value = "320x384", value_parser = input::grid)]
    grid: (usize, usize),
    /// Adds a curve: the border of the basin, or the return map over the displacements of the window
    #[arg(long, value_enum)]
    curve: Option<Curve>,
}

/// A curve that belongs to a basin.
#[derive(Clone, Copy, ValueEnum)]
enum Curve {
    Border,
    ReturnMap,
}

/// Points on each integration step of a border.
const POINTS: u16 = 16;

/// Points on each side of a return map.
const TURNS: u16 = 401;

/// Most labels in an archive.
const MOST_LABELS: usize = 400_000_000;

/// The border of a basin; empty where there is none.
fn border(found: &Portrait) -> Vec<State> {
    let edge = found.edge().map(|edge| edge.curve(POINTS)).unwrap_or_default();
    edge.into_iter().map(|at| State { v: at.v * found.model.omega_0, ..at }).collect()
}

impl Curve {
    /// An answer with the curve.
    fn told(
        self,
        answer: Answer,
        about: &About,
        found: &Portrait,
        window: &StartWindow,
    ) -> Result<Answer> {
        if let Curve::Border = self {
            return Ok(answer.bordered(about, &border(found)));
        }
        let parameters = found.model.parameters().filter(|_| !about.is_machine());
        let sides = match parameters {
            None => vec![found.returns(window.q, TURNS.into())],
            Some(parameters) => {
                let map = return_map(&parameters, window.q, TURNS, &Limits::PATIENT);
                let map = map.map_err(|why| Failure::unanswered("no return map", why))?;
                map.sides.into_iter().rev().collect()
            }
        };
        Ok(answer.returned(about, &sides))
    }
}

/// The labels of starts with their axes, the border of the basin, and the margin.
fn arrays(
    found: &Portrait,
    window: &StartWindow,
    grid: (usize, usize),
    limits: &Limits,
) -> Result<Vec<Array>> {
    let ([q, v], border) = (window.axes(grid), border(found));
    if q.len() * v.len() > MOST_LABELS {
        return Err(
            format!("an archive has at most {MOST_LABELS} labels; --grid sets how many").into()
        );
    }
    let labels = found.labels(window, grid, limits);
    let labels =
        labels.map_err(|why| Failure::unanswered("the starts could not be labelled", why))?;
    let points = border.iter().flat_map(|at| [at.q, at.v]).collect();
    let Margin { displacement, impulse, from_rest } = found.margin;
    let sizes = [displacement, impulse, from_rest.displacement, from_rest.impulse];
    Ok(vec![
        Array::bytes("labels", &[v.len(), q.len()], labels),
        Array::words("legend", Counts::LABELS),
        Array::numbers("q", &[q.len()], q),
        Array::numbers("v", &[v.len()], v),
        Array::numbers("border", &[border.len(), 2], points),
        Array::numbers("margin", &[4], sizes.map(|size| size.unwrap_or(f64::NAN)).to_vec()),
        Array::words(
            "margin_of",
            ["displacement", "impulse", "from_rest_displacement", "from_rest_impulse"],
        ),
        Array::words("regime", [found.margin_regime().word()]),
    ])
}

impl BasinCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let numbers = asked.source.numbers();
        let window = given("--window", self.window.as_ref(), |text| numbers.window(text))?;
        let case = asked.source.exact()?;
        let reach = window.unwrap_or(WINDOW).reach();
        let (about, (found, before)) = (case.about(), case.portrait(&asked.output, reach)?);
        let usual = || {
            if about.is_machine() {
                found.surroundings()
            } else {
                WINDOW
            }
        };
        let window = window.unwrap_or_else(usual);
        let limits = asked.output.limits();
        let written = asked.output.archive(|| arrays(&found, &window, self.grid, &limits))?;
        if written.is_some() {
            return Ok(());
        }
        let count = || found.count(&window, self.grid, &limits);
        let (counts, seconds) = asked.output.timed("the starts could not be counted", count)?;
        // What is proved, is proved of the oscillator of the paper.
        let parameters = found.model.parameters().filter(|_| self.certify && !about.is_machine());
        let certified = parameters.map(|parameters| proved_kicks(&parameters, &found));
        let seconds = before + seconds;
        let answer = basin(&about, &found, (&window, counts), certified.as_ref(), seconds);
        let Some(curve) = self.curve else { return asked.output.print(answer) };
        asked.output.print(curve.told(answer, &about, &found, &window)?)
    }
}
