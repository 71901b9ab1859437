//! Answers, how they are computed, and by which means.

use strum::EnumTryAs;
use thiserror::Error;

use super::{CertainZones, Fit, Request, zones};
use crate::accuracy::{HarmonicBalance, Reference, Trade, harmonic_balance};
use crate::branch::{Branch, Chart, MachineBranch, Points, Resolution, branch, chart};
use crate::flow::{
    Cost, DRAFT, Detail, Limits, Method, Motion, MotionUnits, Problem, Reason, Result, follow,
    trajectory,
};
use crate::model::{Belt, Body, Knob, Model, Parameters, Source, State};
use crate::paper::{ClaimResult, examine_all};
use crate::portrait::closing::return_map::return_map;
use crate::portrait::{Drawing, Margin, Portrait, ReturnMap, Share, bands, picture_reach};
use crate::proof::{ParameterBox, Proof, prove};
use crate::scan::{Levels, ScanRow};

/// The answer of the worker.
#[derive(Clone, Debug, PartialEq, EnumTryAs)]
pub enum Finding {
    Fit(Fit),
    Refit(Fit),
    Trajectory(Motion),
    /// All motions, and the margin of a machine by the model that is not drawn: every kick is survived where the cubic
    /// expansion has no answer, nothing is told where the whole model has none.
    Cycles(Drawing, Option<Margin>),
    Zones(CertainZones),
    /// The fraction of the kicks that lead out of the basin of the sticking set, and the cost of the basin.
    Kicks(Share, Cost),
    /// The borders between bands of capture, as curves to draw: those of `v > 0` and then those of `v < 0`, innermost
    /// first in each.
    Capture(Vec<Vec<State>>, Cost),
    Branch(Branch),
    Balance(HarmonicBalance),
    ReturnMap(ReturnMap),
    Regimes(Chart),
    Level(Levels),
    MachineBranch(MachineBranch),
    Trade(Box<Trade>),
    Scan(Rows),
    Claims(Vec<ClaimResult>),
    Proof(Proof),
    /// The error says why there is no reference, for example because it would take too long.
    Reference(Result<Box<Reference>>),
}

impl Finding {
    /// Counted cost of the computation.
    pub fn cost(&self) -> Cost {
        match self {
            Finding::Trajectory(found) => found.cost,
            Finding::Cycles(found, _) => found.portrait.cost,
            Finding::Zones(found) => found.cost,
            Finding::Kicks(_, cost) | Finding::Capture(_, cost) => *cost,
            Finding::Branch(found) => found.cost,
            Finding::Balance(found) => found.cost,
            Finding::ReturnMap(found) => found.cost,
            Finding::Regimes(found) => found.cost,
            Finding::Level(found) => found.cost,
            Finding::MachineBranch(found) => found.cost,
            Finding::Trade(found) => found.cost(),
            Finding::Scan(found) => found.cost(),
            Finding::Reference(Ok(found)) => found.cost,
            // What these take is not counted.
            Finding::Fit(_)
            | Finding::Refit(_)
            | Finding::Claims(_)
            | Finding::Proof(_)
            | Finding::Reference(Err(_)) => Cost::default(),
        }
    }
}

/// An answer with its question and its computing time, as the worker returns it.
#[derive(Clone, Debug, PartialEq)]
pub struct Reply {
    /// The question.
    pub request: Request,
    /// The answer, or why there is none.
    pub result: Result<Finding, NoAnswer>,
    /// Wall-clock seconds taken so far.
    pub seconds: f64,
    /// Whether the answer is final; a long question is answered in pieces.
    pub complete: bool,
}

impl Reply {
    /// Counted cost of the answer.
    pub fn cost(&self) -> Cost {
        self.result.as_ref().map(Finding::cost).unwrap_or_default()
    }
}

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoAnswer {
    /// The computation gave up.
    #[error("{0}")]
    Reason(Reason),
    /// The computation panicked with this message: a defect of the program.
    #[error("internal error: {0}")]
    Panic(String),
}

/// Consecutive rows of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Index of the first row's point.
    pub first: usize,
    pub rows: Vec<ScanRow>,
}

impl Rows {
    fn cost(&self) -> Cost {
        let mut cost = Cost::default();
        self.rows.iter().for_each(|row| cost += row.cost);
        cost
    }
}

/// Number of points on each kind of curve, as a multiple of that on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness(u16);

impl Fineness {
    /// As many points as the dots of a terminal can show.
    pub const SCREEN: Fineness = Fineness(1);

    /// As many points as print can show: chords deviate from their curves by less than a twentieth of a pixel
    /// of a figure.
    pub const PRINT: Fineness = Fineness(4);

    /// `times` as many points on each curve, for a closer look.
    pub fn finer(self, times: usize) -> Fineness {
        Fineness(self.0.saturating_mul(u16::try_from(times).unwrap_or(u16::MAX)))
    }

    /// Points on a curve that has so many on the screen.
    fn points(self, on_screen: u16) -> u16 {
        self.0.saturating_mul(on_screen)
    }

    /// How finely a chart is computed, of a few lines if it is a `rough` draft: boundaries are interpolated between the
    /// evenly spaced lines; the tolerance is the relative error of clearances at boundaries.
    fn resolution(self, rough: bool) -> Resolution {
        if rough {
            return Resolution { lines: 4, chord: f64::INFINITY, tolerance: 1e-3 };
        }
        let chord = if self == Self::SCREEN {
            f64::INFINITY
        } else {
            4e-4 / f64::from(self.0)
        };
        Resolution { lines: 40, chord, tolerance: 1e-13 }
    }
}

/// Answers a request on this thread, with the fineness of the screen.
pub fn answer(request: &Request, limits: &Limits) -> Result<Finding> {
    answer_for(request, Fineness::SCREEN, limits)
}

/// Maximum number of evaluations for a row of the trade on the screen; the command line allows more.
const ROW: u64 = 1_000_000;

/// Maximum number of evaluations for a reference in the explorer; beyond it, the energy ledger must do.
const REFERENCE: u64 = 4_000_000;

/// Answers a request on this thread, with curves of this fineness: the only place where a question becomes a computation.
pub fn answer_for(request: &Request, fineness: Fineness, limits: &Limits) -> Result<Finding> {
    // On each integration step of a cycle or a border.
    let points = fineness.points(if fineness == Fineness::SCREEN { 12 } else { 16 });
    Ok(match request {
        Request::Fit { recording } => Finding::Fit(Fit::of(recording, limits, &|_| ())?),
        Request::Refit { fit, held, drawn } => Finding::Refit(fit.held(*held, *drawn, limits)?),
        Request::Trajectory { problem, machine } => {
            let points = fineness.points(16);
            Finding::Trajectory(motion(problem, machine.as_deref(), points, limits)?)
        }
        Request::Cycles { parameters, machine, whole } => {
            cycles(parameters, machine.as_deref(), *whole, points, limits)?
        }
        Request::Zones { source, tolerances } => {
            Finding::Zones(zones(source, tolerances, points, limits)?)
        }
        Request::Kicks { source, kicks } => {
            let found = match &source.body {
                Body::Paper(parameters) => {
                    Portrait::of_oscillator(parameters, kicks.reach(), limits)?
                }
                _ => source.portrait()?,
            };
            Finding::Kicks(kicks.lost(&found)?, found.cost)
        }
        Request::Capture { parameters, reach, most } => {
            let found = bands(parameters, *reach, *most, limits)?;
            Finding::Capture(found.curves(points), found.cost)
        }
        Request::Branch { parameters, parameter, range, tolerance } => {
            let rough = *tolerance >= DRAFT.tolerance;
            let points = if rough {
                Points::Followed
            } else {
                Points::Even(fineness.points(160).into())
            };
            Finding::Branch(branch(parameters, *parameter, *range, points, *tolerance, limits)?)
        }
        Request::Balance { parameters, harmonics } => {
            let points = fineness.points(240).into();
            Finding::Balance(harmonic_balance(parameters, *harmonics, points, limits)?)
        }
        Request::ReturnMap { parameters, range } => {
            Finding::ReturnMap(return_map(parameters, *range, fineness.points(128), limits)?)
        }
        Request::Regimes { parameters, plane, rough } => {
            Finding::Regimes(chart(parameters, *plane, fineness.resolution(*rough), limits)?)
        }
        Request::Level { scan, target } => {
            // Chords on the screen are as long as curves allow that are not bent within a dot.
            let chord = if fineness == Fineness::SCREEN {
                2e-3
            } else {
                4e-4 / f64::from(fineness.0)
            };
            Finding::Level(scan.curves(*target, chord, limits)?)
        }
        Request::MachineBranch { belt, varied, range, rough } => {
            Finding::MachineBranch(along_number(belt, *varied, *range, *rough, limits)?)
        }
        Request::Trade(problem) => {
            Finding::Trade(Box::new(Trade::of(None, problem, &limits.up_to(ROW))?))
        }
        Request::Scan { scan, from } => {
            let rows = (*from..scan.points()).map(|index| scan.row(index, limits));
            Finding::Scan(Rows { first: *from, rows: rows.collect::<Result<_, _>>()? })
        }
        Request::Claims => Finding::Claims(examine_all(limits)?),
        Request::Proof { parameters } => {
            Finding::Proof(prove(&ParameterBox::from(parameters), &[]))
        }
        Request::Reference(problem) => {
            let found = Reference::of(None, problem, &limits.up_to(REFERENCE));
            Finding::Reference(Reason::tolerated(found)?.map(Box::new))
        }
    })
}

/// The cycles of a machine over these values of one of its numbers, and the changes between them unless it is a `rough`
/// draft. Fails with [`Reason::Interrupted`], or where the machine has no such number.
fn along_number(
    belt: &Belt,
    varied: Knob,
    range: (f64, f64),
    rough: bool,
    limits: &Limits,
) -> Result<MachineBranch> {
    /// Number of evenly spaced values, and of those in a draft.
    const VALUES: usize = 33;
    const FEW: usize = 7;
    /// Where further values are on both sides of a change, as fractions of the distance between two: there cycles end,
    /// and their curves turn as steeply as a square root.
    const BESIDE: [f64; 6] = [-0.5, -0.1, -0.02, 0.02, 0.1, 0.5];
    let tolerance = rough.then_some(DRAFT.tolerance);
    let source = Source { tolerance, ..Source::from(belt) };
    let values = if rough {
        (FEW, None)
    } else {
        (VALUES, Some(BESIDE.as_slice()))
    };
    let found = MachineBranch::along(&source, varied, range, values, limits);
    limits.go_on()?;
    found.map_err(|_| Reason::NotApplicable { needs: "a machine with that number" })
}

// Motions and cycles, of the paper's oscillator or of a machine by the whole model, drawn in the units of the former,
// so that every view that draws the one draws the other.

/// A motion with `between` points between the ends of each step: of the paper's oscillator, or of a machine by the whole
/// model.
fn motion(
    problem: &Problem,
    machine: Option<&Belt>,
    between: u16,
    limits: &Limits,
) -> Result<Motion> {
    let Some(belt) = machine else {
        // Without friction, nothing happens at v = 0, so crossings are not located.
        let crossings = problem.parameters.r > 0.0;
        let detail = Detail { crossings, samples_per_step: between.into(), energy: true };
        return Ok(trajectory(problem, detail, limits));
    };
    let model = Model::new(belt)?;
    if !problem.method.follows_machines() {
        let needs =
            "to know both switching lines of a machine, as auto, taylor, dop853 and dopri5 do";
        return Err(Reason::NotApplicable { needs });
    }
    let units = MotionUnits::of_paper(&model);
    let detail =
        Detail { samples_per_step: usize::from(between) + 1, energy: true, ..Detail::default() };
    let mut found = follow(&model, problem, units, detail);
    if found.ledger.is_none() {
        let by_series = Problem { method: Method::Taylor, ..*problem };
        let detail = Detail { samples_per_step: 0, ..detail };
        found.ledger = follow(&model, &by_series, units, detail).ledger;
    }
    Ok(found)
}

/// The cycles with their curves, `points` on each step, and the border of the basin: of the paper's oscillator, or of a
/// machine by the `whole` model or by its cubic expansion; beside them its margin by the other one.
fn cycles(
    parameters: &Parameters,
    machine: Option<&Belt>,
    whole: bool,
    points: u16,
    limits: &Limits,
) -> Result<Finding> {
    let expansion = Portrait::of_oscillator(parameters, picture_reach(parameters.d2), limits);
    let Some(belt) = machine else {
        return Ok(Finding::Cycles(expansion?.drawn(parameters, points)?, None));
    };
    let found = Portrait::of_belt(belt);
    let (shown, other) = if whole {
        (found, expansion)
    } else {
        (expansion, found)
    };
    let other = other.map(|other| other.in_drawing(&other.margin)).ok();
    let margin = other.or(whole.then_some(Margin::ENDLESS));
    Ok(Finding::Cycles(shown?.drawn(parameters, points)?, margin))
}
