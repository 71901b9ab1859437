//! `hopfscope basin`: where starts end, the curves that belong to it, and all of it as arrays.

use clap::Args;
use rayon::prelude::*;

use super::input::{self, WINDOW};
use super::output::keep;
use super::{CERTIFY, Failure, QuestionOptions, Result, given};
use crate::flow::{Flow, Limits};
use crate::portrait::closing::return_map::return_map;
use crate::portrait::{Margin, Portrait, Return, StartWindow, evenly, proved_kicks};
use crate::report::margin::{NamedCurve, basin};
use crate::runtime::arrays::Array;
use crate::runtime::packed::packed;

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
    /// Adds curves: the border of the basin, and the return map over the displacements of the window
    #[arg(long)]
    curves: bool,
    /// Adds where each start ends to the JSON document, a row for each velocity
    #[arg(long)]
    labels: bool,
}

/// The border of the basin, and the return map, for each side where it is that of the oscillator of the paper.
fn curves(
    found: &Portrait,
    on_paper: bool,
    q: (f64, f64),
    limits: &Limits,
) -> Result<Vec<NamedCurve>> {
    /// Points on each integration step of a border, and on each side of a map.
    const POINTS: u16 = 16;
    const TURNS: u16 = 401;
    let rate = found.model.omega_0;
    let border = found.edge().map(|edge| edge.curve(POINTS)).unwrap_or_default();
    let mut all = vec![("border", border.iter().map(|at| [at.q, at.v * rate]).collect())];
    if let Some(parameters) = found.model.parameters().filter(|_| on_paper) {
        let map = return_map(&parameters, q, TURNS, limits);
        let map = map.map_err(|why| Failure::unanswered("no return map", why))?;
        let turn = |turn: &Return| [turn.from, turn.to.unwrap_or(f64::NAN)];
        let sides = map.sides.map(|side| side.iter().map(turn).collect());
        all.extend(["return_map_left", "return_map_right"].into_iter().zip(sides));
    } else {
        let starts = evenly((q.0.max(found.model.guide_static), q.1), TURNS.into());
        let next = |x| [x, Flow::new(&found.model).next_right(x).unwrap_or(f64::NAN)];
        all.push(("return_map_right", starts.map(next).collect()));
    }
    Ok(all)
}

/// Most labels of starts in an archive or a document.
const MOST_LABELS: usize = 10_000_000;

/// What starts are counted as, by label.
const LABELS: [&str; 4] = ["captured", "cycle", "escaped", "undecided"];

/// The label of each start, a row for each velocity; each is counted by itself.
fn labels(found: &Portrait, [q, v]: [&[f64]; 2]) -> Result<Vec<usize>> {
    if q.len() * v.len() > MOST_LABELS {
        return Err(format!("--grid: at most {MOST_LABELS} starts have labels").into());
    }
    let label = |(q, v): (f64, f64)| {
        let start = StartWindow { q: (q, q), v: (v, v) };
        let counts = found.count(&start, (1, 1), &Limits::PATIENT).unwrap_or_default();
        let counts = [counts.captured, counts.cycle, counts.escaped];
        counts.iter().position(|count| *count == 1).unwrap_or(counts.len())
    };
    let starts = v.iter().flat_map(|v| q.iter().map(|q| (*q, *v)));
    Ok(starts.collect::<Vec<_>>().into_par_iter().map(label).collect())
}

impl BasinCommand {
    /// The labels with their axes, the margin, and the curves.
    fn arrays(
        &self,
        found: &Portrait,
        [q, v]: [&[f64]; 2],
        curves: &[NamedCurve],
    ) -> Result<Vec<Array>> {
        let digits = |number: f64| format!("{number:?}");
        let (width, height) = self.grid;
        let Margin { displacement, impulse, from_rest } = found.margin;
        let sizes = [displacement, impulse, from_rest.displacement, from_rest.impulse];
        let sizes = sizes.map(|size| size.map(digits).unwrap_or_default());
        let labels = labels(found, [q, v])?;
        let mut all = vec![
            Array::new("labels", &[height, width], labels),
            Array::new("legend", &[LABELS.len()], LABELS),
            Array::new("q", &[width], q.iter().copied().map(digits)),
            Array::new("v", &[height], v.iter().copied().map(digits)),
            Array::new("margin", &[4], sizes),
            Array::new("regime", &[1], [found.margin.regime(found.border)]),
        ];
        let curve = |(name, points): &NamedCurve| {
            Array::new(name, &[points.len(), 2], points.iter().flatten().copied().map(digits))
        };
        all.extend(curves.iter().map(curve));
        Ok(all)
    }

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
        let curves = || curves(&found, !about.is_machine(), window.q, &limits);
        let axes = [(window.q, self.grid.0), (window.v, self.grid.1)]
            .map(|(range, count)| evenly(range, count).collect::<Vec<_>>());
        let axes = axes.each_ref().map(Vec::as_slice);
        if let Some(path) = asked.output.archive() {
            return keep(path, &packed(path, &self.arrays(&found, axes, &curves()?)?)?);
        }
        let count = || found.count(&window, self.grid, &limits);
        let (counts, seconds) = asked.output.timed("the starts could not be counted", count)?;
        // What is proved, is proved of the oscillator of the paper.
        let parameters = found.model.parameters().filter(|_| self.certify && !about.is_machine());
        let certified = parameters.map(|parameters| proved_kicks(&parameters, &found));
        let seconds = before + seconds;
        let answer = basin(&about, &found, (&window, counts), certified.as_ref(), seconds);
        let drawn = if self.curves { curves()? } else { Vec::new() };
        let labels = self.labels.then(|| labels(&found, axes)).transpose()?;
        asked.output.print(answer.curves(&drawn).labels(axes, labels.as_deref(), &LABELS))
    }
}
