//! Answers to requests.

use super::recording::Fit;
use super::request::Request;
use super::speeds::{Speeds, speeds};
use super::whole::{self, Course, Kinds};
use super::zones::{self, Zones};
use crate::flow::quality::DRAFT;
use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Detail, Limits, Problem, Reason, Trajectory};
use crate::oscillator::State;
use crate::study::accuracy::Reference;
use crate::study::branch::{Points, branch};
use crate::study::capture::bands;
use crate::study::chart::{Chart, Resolution, chart};
use crate::study::claims::{Examined, examine_all};
use crate::study::cycle::cycles_drawn;
use crate::study::harmonic_error::{HarmonicBalance, harmonic_balance};
use crate::study::return_map::return_map;
use crate::study::scan::Row;
use crate::study::trade::Trade;
use crate::study::{Branch, Cycles, ReturnMap};

/// What the worker found.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// To [`Request::Trajectory`].
    Trajectory(Trajectory),
    /// To [`Request::Cycles`].
    Cycles(Cycles),
    /// To [`Request::Machine`] and [`Request::Portrait`].
    Whole(Box<Whole>),
    /// To [`Request::Speeds`].
    Speeds(Speeds),
    /// To [`Request::Zones`] and [`Request::MachineZones`].
    Zones(Zones),
    /// To [`Request::Capture`].
    Capture(Borders),
    /// To [`Request::Balance`].
    Balance(HarmonicBalance),
    /// To [`Request::Branch`].
    Branch(Branch),
    /// To [`Request::ReturnMap`].
    ReturnMap(ReturnMap),
    /// To [`Request::Regimes`].
    Regimes(Chart),
    /// To [`Request::Trade`].
    Trade(Box<Trade>),
    /// To [`Request::Reference`]; why there is none, where it would take too long.
    Reference(Result<Box<Reference>, Reason>),
    /// To [`Request::Claims`].
    Claims(Vec<Examined>),
    /// To [`Request::Fit`].
    Fit(Fit),
    /// To [`Request::Scan`]: some more rows.
    Rows(Rows),
}

/// An answer by the whole model, with what the paper's oscillator has no place for.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// The motion or the cycles, as views draw them.
    pub drawn: Answer,
    /// What a motion becomes, and where it rides on the belt.
    pub motion: Option<Course>,
    /// What the cycles are like; `None` where the whole model has no answer and its expansion is drawn.
    pub cycles: Option<Kinds>,
}

/// Rows of a scan that follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Number of the first one's point.
    pub first: usize,
    /// The rows.
    pub rows: Vec<Row>,
}

/// The borders between bands of capture, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Borders {
    /// In each half plane, innermost first.
    pub curves: Vec<Vec<State>>,
    /// What they cost.
    pub cost: Cost,
}

/// An answer with its question and its price, as it comes back from the worker.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// The question.
    pub request: Request,
    /// The answer, or why there is none.
    pub result: Result<Answer, Failure>,
    /// Wall-clock seconds that it took so far.
    pub seconds: f64,
    /// Whether this is all; a long question is answered in pieces.
    pub complete: bool,
}

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The computation gave up.
    Reason(Reason),
    /// The computation panicked, with this message; a defect of the program.
    Panic(String),
}

impl std::fmt::Display for Failure {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::Reason(reason) => write!(out, "{reason}"),
            Failure::Panic(message) => write!(out, "internal error: {message}"),
        }
    }
}

/// How many points curves have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// On each integration step of a trajectory.
    samples_per_step: usize,
    /// On each integration step of a cycle or a border.
    points_per_step: u16,
    /// On the curve of a harmonic answer.
    harmonic: usize,
    /// On a piece of a branch.
    branch: usize,
    /// On a side of a return map.
    map: u16,
    /// Largest distance of the borders of a chart from their chords, as a part of the range.
    chord: f64,
}

impl Fineness {
    /// As many as the dots of a terminal can show.
    pub const SCREEN: Fineness = Fineness {
        samples_per_step: 16,
        points_per_step: 12,
        harmonic: 240,
        branch: 160,
        map: 128,
        chord: f64::INFINITY,
    };

    /// As many as print can show: chords miss their curves by less than a twentieth of a pixel of a
    /// figure.
    pub const PRINT: Fineness = Fineness {
        samples_per_step: 64,
        points_per_step: 64,
        harmonic: 960,
        branch: 640,
        map: 512,
        chord: 1e-4,
    };

    /// More points on each curve, to look at it more closely.
    #[must_use]
    pub fn finer(self, times: u16) -> Fineness {
        let several = usize::from(times);
        Fineness {
            samples_per_step: self.samples_per_step * several,
            points_per_step: self.points_per_step.saturating_mul(times),
            harmonic: self.harmonic * several,
            branch: self.branch * several,
            map: self.map.saturating_mul(times),
            chord: self.chord / f64::from(times),
        }
    }
}

/// Lines of a chart of regimes, evenly spaced; borders between them are interpolated.
const CHART_LINES: usize = 40;

/// The same in a draft.
const DRAFT_LINES: usize = 4;

/// Relative error of clearances at the borders of a chart.
const BORDER_TOLERANCE: f64 = 1e-13;

/// The same in a draft.
const DRAFT_BORDER_TOLERANCE: f64 = 1e-3;

/// Evaluations that a reference may take in the explorer: beyond, the energy ledger must do.
const REFERENCE: u64 = 4_000_000;

/// Evaluations that a row of the trade may take on the screen; the command line waits longer.
const ROW: u64 = 1_000_000;

/// Answers a request: the only place where a question becomes a computation.
///
/// # Errors
/// The [`Reason`] why there is no answer.
pub fn answer(request: &Request, limits: &Limits) -> Result<Answer, Reason> {
    answer_for(request, Fineness::SCREEN, limits)
}

/// The same with curves of another fineness.
///
/// # Errors
/// The [`Reason`] why there is no answer.
pub fn answer_for(
    request: &Request,
    fineness: Fineness,
    limits: &Limits,
) -> Result<Answer, Reason> {
    match request {
        Request::Claims => examine_all(limits).map(Answer::Claims),
        Request::Fit { recording } => Fit::of(recording, limits).map(Answer::Fit),
        Request::Trajectory(problem) => {
            // Without friction nothing happens at v = 0, and nobody looks for it.
            let crossings = problem.parameters.r > 0.0;
            let detail =
                Detail { crossings, samples_per_step: fineness.samples_per_step, energy: true };
            Ok(Answer::Trajectory(trajectory(problem, detail, limits)))
        }
        Request::Cycles { parameters } => {
            cycles_drawn(parameters, fineness.points_per_step, limits).map(Answer::Cycles)
        }
        Request::Machine { belt, problem } => {
            let between = u32::try_from(fineness.samples_per_step).unwrap_or(u32::MAX);
            let (found, course) = whole::motion(belt, problem, between)?;
            let drawn = Answer::Trajectory(found);
            Ok(Answer::Whole(Box::new(Whole { drawn, motion: Some(course), cycles: None })))
        }
        Request::Portrait { belt, parameters, cubic } => {
            let points = fineness.points_per_step;
            let (found, cycles) = whole::portrait(belt, parameters, *cubic, points, limits)?;
            let drawn = Answer::Cycles(found);
            Ok(Answer::Whole(Box::new(Whole { drawn, motion: None, cycles })))
        }
        Request::Speeds { belt, range, count } => {
            speeds(belt, *range, *count, limits).map(Answer::Speeds)
        }
        Request::Zones { known, disturbance } => {
            zones::of_oscillator(known, *disturbance, fineness.points_per_step, limits)
                .map(Answer::Zones)
        }
        Request::MachineZones { belt, tolerances } => {
            zones::of_machine(belt, tolerances, fineness.points_per_step).map(Answer::Zones)
        }
        Request::Capture { parameters, reach, most } => {
            let found = bands(parameters, *reach, *most, limits)?;
            let curves = found.curves(fineness.points_per_step);
            Ok(Answer::Capture(Borders { curves, cost: found.cost }))
        }
        Request::Balance { parameters, harmonics } => {
            harmonic_balance(parameters, *harmonics, fineness.harmonic, limits).map(Answer::Balance)
        }
        Request::Branch { parameters, parameter, range, tolerance } => {
            let rough = *tolerance >= DRAFT.tolerance;
            let points = if rough { Points::Followed } else { Points::Even(fineness.branch) };
            branch(parameters, *parameter, *range, points, *tolerance, limits).map(Answer::Branch)
        }
        Request::Trade { parameters, initial, until } => {
            let (parameters, initial, until) = (*parameters, *initial, *until);
            let problem = Problem { parameters, initial, until, ..Problem::default() };
            let limits = Limits { evaluations: limits.evaluations.min(ROW), ..*limits };
            Trade::of(&problem, &limits).map(Box::new).map(Answer::Trade)
        }
        Request::Reference { parameters, initial, until } => {
            let (parameters, initial, until) = (*parameters, *initial, *until);
            let problem = Problem { parameters, initial, until, ..Problem::default() };
            let limits = Limits { evaluations: limits.evaluations.min(REFERENCE), ..*limits };
            match Reference::of(&problem, &limits) {
                Err(Reason::Interrupted) => Err(Reason::Interrupted),
                found => Ok(Answer::Reference(found.map(Box::new))),
            }
        }
        Request::ReturnMap { parameters, range } => {
            return_map(parameters, *range, fineness.map, limits).map(Answer::ReturnMap)
        }
        Request::Regimes { parameters, plane, rough } => {
            let lines = if *rough { DRAFT_LINES } else { CHART_LINES };
            let chord = if *rough { f64::INFINITY } else { fineness.chord };
            let tolerance = if *rough { DRAFT_BORDER_TOLERANCE } else { BORDER_TOLERANCE };
            let resolution = Resolution { lines, chord, tolerance };
            chart(parameters, *plane, resolution, limits).map(Answer::Regimes)
        }
        Request::Scan { scan, from } => {
            let rows = (*from..scan.points()).map(|index| scan.row(index, limits));
            Ok(Answer::Rows(Rows { first: *from, rows: rows.collect::<Result<_, _>>()? }))
        }
    }
}

impl Answer {
    /// What the computation cost, counted.
    #[must_use]
    pub fn cost(&self) -> Cost {
        match self {
            Answer::Trajectory(answer) => answer.cost,
            Answer::Cycles(answer) => answer.cost,
            Answer::Whole(answer) => answer.drawn.cost(),
            Answer::Speeds(answer) => answer.cost,
            Answer::Zones(answer) => answer.cost,
            Answer::Capture(answer) => answer.cost,
            Answer::Balance(answer) => answer.cost,
            Answer::Branch(answer) => answer.cost,
            Answer::ReturnMap(answer) => answer.cost,
            Answer::Regimes(answer) => answer.cost,
            Answer::Trade(answer) => answer.cost(),
            Answer::Reference(answer) => {
                answer.as_ref().map_or(Cost::default(), |found| found.cost)
            }
            Answer::Rows(answer) => answer.rows.iter().fold(Cost::default(), |mut sum, row| {
                sum += row.cost;
                sum
            }),
            Answer::Claims(_) | Answer::Fit(_) => Cost::default(),
        }
    }
}
