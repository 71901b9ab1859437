//! `hopfscope basin`: where starts end, the curves that belong to it, and all of it as arrays.

use clap::Args;

use super::input::{self, WINDOW};
use super::output::keep;
use super::{CERTIFY, Failure, QuestionOptions, Result, given, provable};
use crate::flow::{Flow, Limits};
use crate::portrait::closing::return_map::return_map;
use crate::portrait::{Counts, Portrait, Return, StartWindow, evenly, proved_kicks};
use crate::report::Format;
use crate::report::margin::basin;
use crate::runtime::arrays::{Array, ArrayCells};
use crate::runtime::packed::packed;
use crate::words::ends_in;

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
    /// Adds where each start ends to the JSON document, a row for each velocity; arrays have it always
    #[arg(long)]
    labels: bool,
}

/// A curve with its name.
type NamedCurve = (&'static str, Vec<[f64; 2]>);

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

/// Most starts that have labels.
const MOST_LABELS: usize = 10_000_000;

impl BasinCommand {
    /// The displacements and the velocities of the starts.
    fn axes(&self, window: &StartWindow) -> [Vec<f64>; 2] {
        let (width, height) = self.grid;
        [(window.q, width), (window.v, height)].map(|(ends, count)| evenly(ends, count).collect())
    }

    /// The label of each start, an index of [`Counts::LABELS`]: a row for each velocity.
    fn labels(&self, found: &Portrait, window: &StartWindow, limits: &Limits) -> Result<Vec<u8>> {
        let (width, height) = self.grid;
        if width * height > MOST_LABELS {
            return Err(format!("--grid: at most {MOST_LABELS} starts have labels").into());
        }
        let columns = found.labelled(window, self.grid, limits, |labels| labels);
        let columns = columns.map_err(|why| Failure::unanswered(UNCOUNTED, why))?;
        let of_row = |row| columns.iter().map(move |column: &Vec<u8>| column[row]);
        Ok((0..height).flat_map(of_row).collect())
    }

    /// The labels with their axes, the margin, and the curves.
    fn arrays(
        &self,
        found: &Portrait,
        window: &StartWindow,
        curves: Vec<NamedCurve>,
        limits: &Limits,
    ) -> Result<Vec<Array>> {
        let (width, height) = self.grid;
        let labels = self.labels(found, window, limits)?;
        let [q, v] = self.axes(window).map(ArrayCells::Numbers);
        let margin = found.margin.all().map(|size| size.unwrap_or(f64::NAN));
        let regime = found.margin.regime(found.border);
        let mut all = vec![
            Array::new("labels", &[height, width], ArrayCells::Codes(labels)),
            Array::new("legend", &[4], ArrayCells::words(&Counts::LABELS)),
            Array::new("q", &[width], q),
            Array::new("v", &[height], v),
            Array::new("margin", &[4], ArrayCells::Numbers(margin.to_vec())),
            Array::new("regime", &[1], ArrayCells::words(&[regime])),
        ];
        all.extend(curves.into_iter().map(|(name, points)| {
            Array::new(name, &[points.len(), 2], ArrayCells::Numbers(points.concat()))
        }));
        Ok(all)
    }

    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let numbers = asked.source.numbers()?;
        let archive = asked.output.archive();
        if let Some(path) = archive.filter(|path| self.certify || !ends_in(path, "npz")) {
            let why = "arrays of a basin are a file .npz, and hold no proof";
            return Err(Failure::file(path, why));
        }
        if self.labels && archive.is_none() && asked.output.format() != Format::Json {
            return Err("--labels is for --format json, or for --write FILE.npz".into());
        }
        let window = given("--window", self.window.as_ref(), |text| numbers.window(text))?;
        let case = asked.source.exact()?;
        let (about, reach) = (case.about(), window.unwrap_or(WINDOW).reach());
        let on_paper = !about.is_machine();
        provable(self.certify, !on_paper)?;
        let (found, before) = case.portrait(&asked.output, reach)?;
        let usual = if on_paper { WINDOW } else { found.surroundings() };
        let window = window.unwrap_or(usual);
        let limits = asked.output.limits();
        let curves = || curves(&found, on_paper, window.q, &limits);
        if let Some(path) = archive {
            return keep(path, &packed(path, &self.arrays(&found, &window, curves()?, &limits)?)?);
        }
        let count = || found.count(&window, self.grid, &limits);
        let (counts, seconds) = asked.output.timed(UNCOUNTED, count)?;
        let parameters = found.model.parameters().filter(|_| self.certify);
        let certified = parameters.map(|parameters| proved_kicks(&parameters, &found));
        let seconds = before + seconds;
        let mut answer = basin(&about, &found, (&window, counts), certified.as_ref(), seconds);
        if self.labels {
            answer = answer.labels(self.axes(&window), &self.labels(&found, &window, &limits)?);
        }
        if !self.curves {
            return asked.output.print(answer);
        }
        let rows: Vec<_> = curves()?
            .into_iter()
            .flat_map(|(name, points)| {
                points.into_iter().map(move |[x, y]| vec![name.into(), x.into(), y.into()])
            })
            .collect();
        asked.output.print(answer.points(Some("curves"), &["curve", "x", "y"], &rows))
    }
}

/// Begins the message where starts could not be counted.
const UNCOUNTED: &str = "the starts could not be counted";
