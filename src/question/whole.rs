//! A machine by the whole model, drawn in the units of the paper's oscillator, so that every view that draws a
//! motion or cycles draws these as well.

use crate::flow::{Detail, Fate, Limits, Method, MotionUnits, Problem, Reason, Trajectory, follow};
use crate::model::{Belt, Model, Parameters};
use crate::portrait::basin::cycle::picture_reach;
use crate::portrait::{Border, Cycle, Cycles, Margin, Portrait, survey};

/// What is known of a machine's motion beside its course.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeMotion {
    /// The fate.
    pub fate: Fate,
    /// The cycle to which it tends, in the units of the paper's oscillator.
    pub cycle: Option<Cycle>,
    /// Kind of the border of the basin.
    pub border: Border,
}

/// What is known of a machine beside its cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeCycles {
    /// The kicks that are survived by the whole model and by the cubic expansion, without units; every kick where the
    /// expansion has no answer.
    pub margins: [Margin; 2],
    /// Whether all slipping motions are periodic.
    pub neutral: bool,
}

/// A cycle in the units of the drawing.
fn cycle(model: &Model, cycle: &Cycle) -> Cycle {
    cycle.scaled(1.0 / model.pull, 1.0 / model.omega_0)
}

/// The motion of a machine, with `between` points between the ends of each step.
pub fn motion(
    belt: &Belt,
    problem: &Problem,
    between: u32,
) -> Result<(Trajectory, WholeMotion), Reason> {
    let portrait = survey::portrait(belt)?;
    let mut model = portrait.model.clone();
    model.tolerance = problem.tolerance;
    if !problem.method.follows_machines() {
        let needs =
            "to know both switching lines of a machine, as auto, taylor, dop853 and dopri5 do";
        return Err(Reason::NotApplicable { needs });
    }
    let detail =
        Detail { samples_per_step: between as usize + 1, energy: true, ..Detail::default() };
    let mut found = follow(&model, problem, MotionUnits::of_paper(&model), detail);
    if found.ledger.is_none() {
        let by_series = Problem { method: Method::Taylor, ..*problem };
        let detail = Detail { samples_per_step: 0, ..detail };
        found.ledger = follow(&model, &by_series, MotionUnits::of_paper(&model), detail).ledger;
    }
    let (x, v) = (problem.initial.q * model.pull, problem.initial.v * model.pull * model.omega_0);
    let fate = match portrait.fate(x, v) {
        Err(stop @ Reason::BeyondLaw { .. }) => Fate::Unknown(stop),
        fate => fate?,
    };
    let tends = match fate {
        Fate::Cycle(index) => portrait.cycles.get(index),
        _ => None,
    };
    let course =
        WholeMotion { fate, cycle: tends.map(|it| cycle(&model, it)), border: portrait.border };
    Ok((found, course))
}

/// The cycles of a machine with their curves, `points` on each step, and the border of the basin: by the whole
/// model or by its cubic expansion.
pub fn portrait(
    belt: &Belt,
    parameters: &Parameters,
    whole: bool,
    points: u16,
    limits: &Limits,
) -> Result<(Cycles, Option<WholeCycles>), Reason> {
    let reach = picture_reach(parameters.d2);
    let expansion = Portrait::of_oscillator(parameters, reach, limits);
    let found = survey::portrait(belt);
    let expanded = expansion.as_ref().map_or(Margin::ENDLESS, |found| found.margin);
    let kinds = found.as_ref().ok().map(|found| WholeCycles {
        margins: [found.in_drawing(&found.margin), expanded],
        neutral: found.neutral,
    });
    let shown = if whole { found } else { expansion };
    Ok((shown?.drawn(parameters, points)?, kinds))
}
