//! A machine's answer as a JSON document; physical quantities are in SI units.

use std::collections::BTreeMap;

use serde::Serialize;

use super::expansion::Expansion;
use super::{BeltAnswer, Designed, RestShare, finite, margins};
use crate::machine::guarantee::{GuaranteedKicks, MachineUncertain};
use crate::machine::motion::{MachineOutcome, MachineState};
use crate::machine::survey::{Course, Second};
use crate::machine::turn::Place;
use crate::machine::{MachineCycle, MachineFate, MachineLedger, Portrait};
use crate::oscillator::belt::{Derivatives, FrictionLaw, QUANTITIES, Units};
use crate::oscillator::{Belt, Interval, Parameters};
use crate::report::json::text;
use crate::study::design::{Kick, Needed};

#[derive(Serialize)]
struct Document<'a> {
    machine: &'a str,
    model: &'static str,
    quantities: BTreeMap<&'static str, f64>,
    friction: Friction,
    units: &'a Units,
    parameters: &'a Parameters,
    sticking_velocity: Both,
    rest_band: Both,
    #[serde(flatten)]
    whole: Whole,
    motion: MotionOf,
    #[serde(skip_serializing_if = "Option::is_none")]
    guaranteed: Option<GuaranteedOf>,
    #[serde(skip_serializing_if = "RestShare::is_not_asked")]
    rest_share: RestShare,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignOf>,
    expansion: Expansion<'a>,
    cost: Cost,
}

/// The kicks that are survived for certain.
#[derive(Serialize)]
struct GuaranteedOf {
    /// In m; null where every kick is survived, or nothing is certain.
    displacement: Option<f64>,
    /// In N s.
    impulse: Option<f64>,
    /// Why nothing is certain.
    reason: Option<String>,
    /// In N.
    disturbance: f64,
    /// The numbers that are not known exactly, each with its ends in SI units.
    tolerances: BTreeMap<&'static str, Interval>,
}

impl GuaranteedOf {
    fn new(answer: &BeltAnswer, certain: &Result<GuaranteedKicks, MachineUncertain>) -> Self {
        let kicks = certain.ok();
        GuaranteedOf {
            displacement: kicks.and_then(|kicks| finite(kicks.displacement)),
            impulse: kicks.and_then(|kicks| finite(kicks.impulse)),
            reason: certain.err().map(|reason| reason.to_string()),
            disturbance: answer.machine.tolerances.disturbance,
            tolerances: answer
                .uncertain()
                .into_iter()
                .map(|(varied, interval)| (varied.name(), interval))
                .collect(),
        }
    }
}

/// A number without unit, and in SI units.
#[derive(Serialize)]
struct Both {
    dimensionless: f64,
    physical: f64,
}

#[derive(Serialize)]
struct Friction {
    law: &'static str,
    /// Quadratic mean of the distances of a table's points from the law.
    #[serde(skip_serializing_if = "Option::is_none")]
    missed: Option<f64>,
    mu: f64,
    mu1: f64,
    mu2: f64,
    mu3: f64,
    /// The coefficient up to which the belt holds the mass.
    mu_s: Option<f64>,
}

impl Friction {
    fn new(belt: &Belt, mu: &Derivatives) -> Self {
        let missed = match &belt.law {
            FrictionLaw::Table(spline) => Some(spline.missed()),
            _ => None,
        };
        let Derivatives { value, first, second, third } = *mu;
        Friction {
            law: belt.law.name(),
            missed,
            mu: value,
            mu1: first,
            mu2: second,
            mu3: third,
            mu_s: belt.static_coefficient.or_else(|| belt.law.mu(0.0)),
        }
    }
}

/// What the whole model says about all motions of a machine.
#[derive(Serialize)]
pub(super) struct Whole {
    cycles: Vec<CycleOf>,
    neutral: bool,
    border: BorderOf,
    margin: Margins,
    /// Beyond which right turning point motions are not known, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<Limit>,
    /// Right turning points between which the search for cycles did not settle.
    unresolved: Vec<(f64, f64)>,
}

#[derive(Serialize)]
struct Limit {
    displacement: f64,
    reason: String,
}

#[derive(Serialize)]
pub(super) struct CycleOf {
    kind: &'static str,
    overtakes: bool,
    stable: bool,
    x_min: f64,
    x_max: f64,
    v_min: f64,
    v_max: f64,
    period: f64,
    stick_duration: f64,
    /// `None` where it overflows.
    multiplier: Option<f64>,
    /// Of 0 there is none.
    log_multiplier: Option<f64>,
}

#[derive(Serialize)]
struct BorderOf {
    kind: &'static str,
}

#[derive(Serialize)]
struct Margins {
    displacement: Option<f64>,
    impulse: Option<f64>,
    /// To the right and to the left, in m.
    displacements: Option<(f64, f64)>,
    /// With and against the belt, in m/s.
    velocities: Option<(f64, f64)>,
}

impl Whole {
    pub(super) fn new(portrait: &Portrait) -> Self {
        let [displacement, impulse] = margins(portrait);
        let margin = portrait.margin;
        Whole {
            cycles: portrait.cycles.iter().map(CycleOf::new).collect(),
            neutral: portrait.neutral,
            border: BorderOf { kind: portrait.border.kind() },
            margin: Margins {
                displacement,
                impulse,
                displacements: margin.map(|margin| margin.displacement),
                velocities: margin.map(|margin| margin.velocity),
            },
            limit: portrait
                .stop
                .map(|stop| Limit { displacement: portrait.known, reason: stop.to_string() }),
            unresolved: portrait.unresolved.clone(),
        }
    }
}

impl CycleOf {
    pub(super) fn new(cycle: &MachineCycle) -> Self {
        CycleOf {
            kind: kind(cycle),
            overtakes: cycle.overtakes,
            stable: cycle.stable,
            x_min: cycle.x.0,
            x_max: cycle.x.1,
            v_min: cycle.v.0,
            v_max: cycle.v.1,
            period: cycle.period,
            stick_duration: cycle.stick_duration,
            multiplier: Some(cycle.multiplier).filter(|it| it.is_finite()),
            log_multiplier: Some(cycle.log_multiplier).filter(|it| it.is_finite()),
        }
    }
}

/// The name of a kind of cycle.
pub(super) fn kind(cycle: &MachineCycle) -> &'static str {
    if cycle.sticks { "stick-slip" } else { "slip" }
}

#[derive(Serialize)]
pub(super) struct MotionOf {
    start: StartOf,
    outcome: OutcomeOf,
    /// How far it was followed, in s.
    until: f64,
    displacement: (f64, f64),
    velocity: (f64, f64),
    phases: Vec<PhaseOf>,
    energy: Energy,
    end: StateOf,
    #[serde(skip_serializing_if = "Option::is_none")]
    second: Option<SecondOf>,
}

#[derive(Serialize)]
struct StateOf {
    t: f64,
    x: f64,
    v: f64,
}

impl StateOf {
    fn new(MachineState { t, x, v }: MachineState) -> Self {
        StateOf { t, x, v }
    }
}

/// The motion by another method, and by how much its end differs.
#[derive(Serialize)]
struct SecondOf {
    method: &'static str,
    tolerance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    end: Option<StateOf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<StateOf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

impl SecondOf {
    fn new(Second { way, tolerance, found }: &Second, first: MachineState) -> Self {
        let end = found.map(|found| found.end);
        let less = |end: MachineState| StateOf {
            t: end.t - first.t,
            x: end.x - first.x,
            v: end.v - first.v,
        };
        SecondOf {
            method: way.name(),
            tolerance: *tolerance,
            end: end.ok().map(StateOf::new),
            difference: end.ok().map(less),
            reason: end.err().map(|stop| stop.to_string()),
        }
    }
}

#[derive(Serialize)]
struct StartOf {
    x: f64,
    v: f64,
}

#[derive(Serialize)]
struct OutcomeOf {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    cycle: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<f64>,
    /// When it came to rest, if within the time for which it was followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    t: Option<f64>,
}

#[derive(Serialize)]
struct PhaseOf {
    t: f64,
    x: f64,
    phase: &'static str,
}

#[derive(Serialize)]
struct Energy {
    start: f64,
    end: f64,
    belt: f64,
    damper: f64,
    guide: f64,
    residual: f64,
}

impl MotionOf {
    pub(super) fn new((x, v): (f64, f64), course: &Course) -> Self {
        let Course { motion, fate, rest, .. } = course;
        let named = |kind| OutcomeOf { kind, cycle: None, x: None, t: None };
        let outcome = match fate {
            MachineFate::Rest => OutcomeOf {
                x: *rest,
                t: (motion.outcome == MachineOutcome::Rests).then_some(motion.end.t),
                ..named("rest")
            },
            MachineFate::Cycle(index) => OutcomeOf { cycle: Some(*index), ..named("cycle") },
            MachineFate::Neutral => named("neutral"),
            MachineFate::Escaped => named("escaped"),
            MachineFate::Unknown(_) => named("unknown"),
        };
        let MachineLedger { start, end, belt, damper, guide } = motion.ledger;
        let residual = motion.ledger.residual();
        let phase = |place: Place| match place {
            Place::Sticks => "stick",
            Place::Rests => "rest",
            Place::Slips(_) => "slip",
        };
        MotionOf {
            start: StartOf { x, v },
            outcome,
            until: motion.end.t,
            displacement: motion.x,
            velocity: motion.v,
            phases: motion
                .legs
                .iter()
                .map(|leg| PhaseOf { t: leg.t, x: leg.x, phase: phase(leg.place) })
                .collect(),
            energy: Energy { start, end, belt, damper, guide, residual },
            end: StateOf::new(motion.end),
            second: course.second.as_ref().map(|second| SecondOf::new(second, motion.end)),
        }
    }
}

#[derive(Serialize)]
pub(super) struct DesignOf {
    kick: Kick,
    /// In m, or N s.
    margin: f64,
    /// In N.
    #[serde(rename = "R")]
    force: Option<f64>,
    needed: Needed,
    message: String,
}

impl DesignOf {
    pub(super) fn new(designed: &Designed) -> Self {
        DesignOf {
            kick: designed.kick,
            margin: designed.wanted,
            force: designed.force(),
            needed: designed.needed,
            message: designed.sentence(),
        }
    }
}

/// Steps of the whole model, and the time.
#[derive(Serialize)]
pub(super) struct Cost {
    pub steps: u64,
    pub seconds: f64,
}

/// How far from the steady position the guide holds the mass.
fn rest_band(belt: &Belt, units: &Units) -> Both {
    let physical = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
    Both { dimensionless: physical / units.displacement, physical }
}

/// Everything that is said about a machine, as a document.
pub fn json(answer: &BeltAnswer) -> String {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    text(&Document {
        machine: &answer.machine.name,
        model: "whole",
        quantities: QUANTITIES.iter().map(|row| (row.name, belt.get(row.quantity))).collect(),
        friction: Friction::new(belt, &reduced.mu),
        units: &reduced.units,
        parameters: &reduced.parameters,
        sticking_velocity: Both {
            dimensionless: reduced.sticking_velocity,
            physical: belt.belt_speed,
        },
        rest_band: rest_band(belt, &reduced.units),
        whole: Whole::new(&survey.course.portrait),
        motion: MotionOf::new(
            (answer.machine.displacement, answer.machine.velocity),
            &survey.course,
        ),
        guaranteed: answer.certain.as_ref().map(|certain| GuaranteedOf::new(answer, certain)),
        rest_share: answer.rest_share,
        design: answer.design.as_ref().map(DesignOf::new),
        expansion: Expansion::new(survey),
        cost: Cost { steps: survey.course.portrait.steps, seconds: answer.seconds },
    })
}
