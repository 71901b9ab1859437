//! A machine by the whole model, drawn in the units of the paper's oscillator, so that every view that draws a
//! motion or cycles draws these as well.

use crate::flow::machine::curve::{CurvePiece, MachineCurve};
use crate::flow::machine::motion;
use crate::flow::machine::motion::MachineState;
use crate::flow::machine::series::ORDER;
use crate::flow::machine::turn::ContactState;
use crate::flow::trajectory::{Crossing, Outcome, Sample, Trajectory};
use crate::flow::{
    Cost, Detail, Fate, Flow, Limits, MachineLedger, MachineMotion, Problem, Reason,
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
    /// First and last point of each stretch on which the mass rides on the belt.
    pub rides: Vec<[Sample; 2]>,
    /// Sources and sinks of its energy, in the units of the paper's oscillator.
    pub ledger: MachineLedger,
}

/// What is known of a machine beside its cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeCycles {
    /// Sources and sinks of the energy over one turn of each cycle, in the units of the paper's oscillator.
    pub works: Vec<MachineLedger>,
    /// The kicks that are survived by the whole model and by the cubic expansion, without units; every kick where the
    /// expansion has no answer.
    pub margins: [Margin; 2],
    /// Whether all slipping motions are periodic.
    pub neutral: bool,
}

/// Units of the drawing, in SI units.
#[derive(Clone, Copy)]
struct DrawingUnits {
    x: f64,
    v: f64,
    t: f64,
}

impl DrawingUnits {
    fn of(model: &Model) -> Self {
        DrawingUnits { x: model.pull, v: model.pull * model.omega_0, t: 1.0 / model.omega_0 }
    }

    fn ledger(self, ledger: &MachineLedger, model: &Model) -> MachineLedger {
        let unit = model.stiffness * self.x * self.x;
        let MachineLedger { start, end, belt, damper, guide } = *ledger;
        let [start, end, belt, damper, guide] =
            [start, end, belt, damper, guide].map(|energy| energy / unit);
        MachineLedger { start, end, belt, damper, guide }
    }

    fn cycle(self, cycle: &Cycle) -> Cycle {
        cycle.scaled(1.0 / self.x, self.t)
    }

    fn sample(self, state: &MachineState) -> Sample {
        Sample { tau: state.t / self.t, q: state.x / self.x, v: state.v / self.v }
    }
}

/// The motion of a machine, with `between` points between the ends of each step.
pub fn motion(
    belt: &Belt,
    problem: &Problem,
    between: u32,
) -> Result<(Trajectory, WholeMotion), Reason> {
    let portrait = found(belt)?;
    let mut model = portrait.model.clone();
    model.tolerance = problem.tolerance;
    let units = DrawingUnits::of(&model);
    if !problem.method.follows_machines() {
        return Err(Reason::NotApplicable {
            needs: "to know both switching lines of a machine, as auto, taylor, dop853 and dopri5 do",
        });
    }
    let (x, v) = (problem.initial.q * units.x, problem.initial.v * units.v);
    let until = problem.until * units.t;
    let detail =
        Detail { samples_per_step: between as usize + 1, energy: true, ..Detail::default() };
    let asked = (problem.method, problem.tolerance);
    let found = MachineMotion::by(&model, asked, (x, v), until, detail);
    let ledger = found.ledger;
    let ledger = ledger.or_else(|| MachineMotion::new(&model, x, v, until).ledger);
    let fate = match portrait.fate(x, v) {
        Err(stop @ Reason::BeyondLaw { .. }) => Fate::Unknown(stop),
        fate => fate?,
    };
    let cycle = match fate {
        Fate::Cycle(index) => portrait.cycles.get(index),
        _ => None,
    };
    let course = WholeMotion {
        fate,
        cycle: cycle.map(|cycle| units.cycle(cycle)),
        border: portrait.border,
        rides: rides(&found, model.speed * model.omega_0, units),
        ledger: units.ledger(&ledger.unwrap_or_default(), &model),
    };
    Ok((trajectory(&found, problem, units), course))
}

fn trajectory(found: &MachineMotion, problem: &Problem, units: DrawingUnits) -> Trajectory {
    let start = Sample { tau: 0.0, q: problem.initial.q, v: problem.initial.v };
    let sampled = found.samples.iter().skip(1).map(|at| units.sample(at));
    let samples: Vec<Sample> = std::iter::once(start).chain(sampled).collect();
    let Sample { tau, q, v } = samples[samples.len() - 1];
    let outcome = match found.outcome {
        Fate::Rest => Outcome::Captured { tau, q },
        Fate::Moving | Fate::Cycle(_) | Fate::Neutral => Outcome::Moving { tau, q, v },
        Fate::Escapes => Outcome::Escaped { tau },
        Fate::Unknown(stop) => Outcome::GaveUp { tau, reason: stop },
    };
    let crossing = |turn: &motion::Leg| Crossing { tau: turn.t / units.t, q: turn.x / units.x };
    Trajectory {
        problem: *problem,
        method: found.method,
        implicit_steps: 0,
        outcome,
        crossings: motion::turns(&found.legs).map(crossing).collect(),
        ledger: None,
        samples,
        cost: found.cost,
    }
}

fn cost(steps: u64) -> Cost {
    Cost { evaluations: steps * ORDER as u64, steps, rejected: 0 }
}

/// The stretches on which a motion rides on the belt, whose speed is `v0`.
fn rides(found: &MachineMotion, v0: f64, units: DrawingUnits) -> Vec<[Sample; 2]> {
    let ends = found.legs.iter().skip(1).map(|leg| (leg.t, leg.x));
    let ends = ends.chain(found.samples.last().map(|end| (end.t, end.x)));
    let legs = found.legs.iter().zip(ends).filter(|(leg, _)| leg.place == ContactState::Sticks);
    let at = |t, x| units.sample(&MachineState { t, x, v: v0 });
    legs.map(|(leg, (t, x))| [at(leg.t, leg.x), at(t, x)]).collect()
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
    let found = found(belt);
    let expanded = expansion.as_ref().ok().and_then(|found| found.picture.as_ref());
    let expanded = expanded.map(|picture| picture.margin);
    let kinds = found.as_ref().ok().map(|found| WholeCycles {
        works: works(found),
        margins: [margin(found), expanded.unwrap_or(Margin::ENDLESS)],
        neutral: found.neutral,
    });
    let drawn = if whole { drawn(&found?, parameters, points)? } else { expansion? };
    Ok((drawn, kinds))
}

/// The energy ledgers of the cycles over one turn, in drawing units.
fn works(found: &Portrait) -> Vec<MachineLedger> {
    let (mut flow, units) = (Flow::new(&found.model), DrawingUnits::of(&found.model));
    let ledger = |cycle| flow.works_around(cycle).unwrap_or_default();
    found.cycles.iter().map(ledger).map(|one| units.ledger(&one, &found.model)).collect()
}

/// The portrait of a machine, or why there is none.
pub fn found(belt: &Belt) -> Result<Portrait, Reason> {
    survey::portrait(belt)
}

/// The kicks that a machine survives, without units.
pub fn margin(found: &Portrait) -> Margin {
    margin_of(&found.model, &found.margin)
}

/// A margin given in m and N s, converted to numbers without units.
pub fn margin_of(model: &Model, margin: &Margin) -> Margin {
    let units = DrawingUnits::of(model);
    margin.map(|x| x / units.x, |impulse| impulse / (model.mass * units.v))
}

fn drawn(found: &Portrait, parameters: &Parameters, points: u16) -> Result<Cycles, Reason> {
    let (model, units) = (&found.model, DrawingUnits::of(&found.model));
    let mut flow = Flow::new(model);
    let mut curves = Vec::new();
    for cycle in &found.cycles {
        let mut curve = MachineCurve::default();
        flow.around(cycle.q_max, cycle.is_followed_backward(), &mut curve)?;
        curves.push(places(&curve, model, points));
    }
    let border = found.border_curve().map(|curve| places(curve, model, points));
    let picture = BasinPicture {
        curves,
        works: Vec::new(),
        border: border.unwrap_or_default(),
        margin: margin(found),
        area: None,
        lyapunov_share: None,
    };
    Ok(Cycles {
        parameters: *parameters,
        cycles: found.cycles.iter().map(|cycle| units.cycle(cycle)).collect(),
        harmonic: Vec::new(),
        border: found.border,
        picture: Some(picture),
        cost: cost(found.steps),
    })
}

/// A closed curve as points, `points` + 1 on each piece that slips.
pub(super) fn places(curve: &MachineCurve, model: &Model, points: u16) -> Vec<State> {
    let state = |x: f64, y: f64| State { q: x / model.pull, v: y / model.pull };
    let mut found = Vec::new();
    for piece in &curve.pieces {
        match piece {
            CurvePiece::Slip(slip) => found.extend((0..=points).map(|point| {
                let (x, y) = slip.at(slip.duration * f64::from(point) / f64::from(points.max(1)));
                state(x, y)
            })),
            CurvePiece::Line { from, to } => {
                found.extend([*from, *to].map(|x| state(x, model.speed)));
            }
        }
    }
    found.extend(found.first().copied());
    found
}
