//! A machine by the whole model, drawn in the units of the paper's oscillator, so that every view that draws a
//! motion or cycles draws these as well.

use crate::flow::machine::curve::{CurvePiece, MachineCurve};
use crate::flow::{
    Detail, Fate, Flow, Limits, Method, MotionUnits, Problem, Reason, Trajectory, follow,
};
use crate::model::{Belt, Model, Parameters, State};
use crate::portrait::basin::cycle::cycles_drawn;
use crate::portrait::{BasinPicture, Border, Cycle, Cycles, Margin, Portrait, survey};

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

/// A margin given in m and N s, in the units of the drawing.
pub(super) fn margin(model: &Model, margin: &Margin) -> Margin {
    let impulse = model.mass * model.pull * model.omega_0;
    margin.map(|x| x / model.pull, |it| it / impulse)
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
    let expansion = cycles_drawn(parameters, points, limits);
    let found = survey::portrait(belt);
    let expanded = expansion.as_ref().ok().and_then(|found| found.picture.as_ref());
    let expanded = expanded.map(|picture| picture.margin);
    let kinds = found.as_ref().ok().map(|found| WholeCycles {
        margins: [margin(&found.model, &found.margin), expanded.unwrap_or(Margin::ENDLESS)],
        neutral: found.neutral,
    });
    let drawn = if whole { drawn(&found?, parameters, points)? } else { expansion? };
    Ok((drawn, kinds))
}

fn drawn(found: &Portrait, parameters: &Parameters, points: u16) -> Result<Cycles, Reason> {
    let model = &found.model;
    let mut flow = Flow::new(model);
    let unit = model.stiffness * model.pull * model.pull;
    let (mut curves, mut works) = (Vec::new(), Vec::new());
    for cycle in &found.cycles {
        let mut curve = MachineCurve::default();
        flow.around(cycle.q_max, cycle.is_followed_backward(), &mut curve)?;
        curves.push(places(&curve, model, points));
        works.push(flow.works_around(cycle).unwrap_or_default().scaled(1.0 / unit));
    }
    let border = found.border_curve().map(|curve| places(curve, model, points));
    let picture = BasinPicture {
        curves,
        works,
        border: border.unwrap_or_default(),
        margin: margin(model, &found.margin),
        area: None,
        lyapunov_share: None,
    };
    Ok(Cycles {
        parameters: *parameters,
        cycles: found.cycles.iter().map(|it| cycle(model, it)).collect(),
        harmonic: Vec::new(),
        border: found.border,
        picture: Some(picture),
        cost: found.cost,
    })
}

/// A closed curve as points, `points` + 1 on each piece that slips.
pub(super) fn places(curve: &MachineCurve, model: &Model, points: u16) -> Vec<State> {
    let between =
        |piece: &CurvePiece| if matches!(piece, CurvePiece::Slip(_)) { points } else { 1 };
    let pieces = curve.pieces.iter();
    let states = pieces.flat_map(|piece| piece.points(between(piece), model.speed));
    let scaled = |State { q, v }| State { q: q / model.pull, v: v / model.pull };
    let mut found: Vec<State> = states.map(scaled).collect();
    found.extend(found.first().copied());
    found
}
