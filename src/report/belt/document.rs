//! The answer about a machine as a JSON document; physical quantities are in SI units.

use std::collections::BTreeMap;

use serde::Serialize;

use super::expansion::Expansion;
use super::{DesignAnswer, MachineAnswer, OnBelt, RestShare};
use crate::flow::Fate;
use crate::machine::MachineLedger;
use crate::machine::guarantee::MachineUncertain;
use crate::machine::motion::MachineState;
use crate::machine::survey::{Course, CubicExpansion, Second};
use crate::machine::turn::ContactState;
use crate::oscillator::belt::{Derivatives, FrictionLaw, Units};
use crate::oscillator::{Belt, Group, Interval, Parameters};
use crate::portrait::{Border, Cycle, Margin, Portrait};
use crate::report::json::text;
use crate::study::design::{FrictionNeeded, Kick};

#[derive(Serialize)]
struct MachineDocument<'a> {
    machine: &'a str,
    model: &'static str,
    #[serde(flatten)]
    belt: Option<BeltDocument<'a>>,
    #[serde(flatten)]
    whole: PortraitDocument,
    motion: MachineMotionDocument,
    #[serde(skip_serializing_if = "Option::is_none")]
    guaranteed: Option<MachineGuaranteeDocument>,
    #[serde(skip_serializing_if = "RestShare::is_not_asked")]
    rest_share: RestShare,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    expansion: Option<Expansion<'a>>,
    cost: MachineCost,
}

/// The numbers of a mass on a belt, and its dimensionless form.
#[derive(Serialize)]
struct BeltDocument<'a> {
    quantities: BTreeMap<&'static str, f64>,
    friction: Friction,
    units: &'a Units,
    parameters: &'a Parameters,
    sticking_velocity: Both,
    rest_band: Both,
}

impl<'a> BeltDocument<'a> {
    fn new(CubicExpansion { belt, reduced, .. }: &'a CubicExpansion) -> Self {
        let speed = (reduced.sticking_velocity, belt.belt_speed);
        let held = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
        let both = |(dimensionless, physical)| Both { dimensionless, physical };
        BeltDocument {
            quantities: Group::Machine
                .knobs()
                .filter_map(|knob| Some((knob.spec().name, knob.of_belt(belt)?)))
                .collect(),
            friction: Friction::new(belt, &reduced.mu),
            units: &reduced.units,
            parameters: &reduced.parameters,
            sticking_velocity: both(speed),
            rest_band: both((held / reduced.units.displacement, held)),
        }
    }
}

/// The kicks that are survived for certain, with what they allow for.
#[derive(Serialize)]
struct MachineGuaranteeDocument {
    /// In m and N s; null if every kick is survived or nothing is certain.
    #[serde(flatten)]
    margin: Margin,
    /// Why nothing is certain.
    reason: Option<String>,
    /// In N.
    disturbance: f64,
    /// The intervals of the numbers that are not known exactly, in SI units.
    tolerances: BTreeMap<&'static str, Interval>,
}

impl MachineGuaranteeDocument {
    fn new(belt: &OnBelt, certain: &Result<Margin, MachineUncertain>) -> Self {
        MachineGuaranteeDocument {
            margin: certain.unwrap_or(Margin::ENDLESS),
            reason: certain.err().map(|reason| reason.to_string()),
            disturbance: belt.tolerances.disturbance,
            tolerances: belt
                .uncertain()
                .into_iter()
                .map(|(knob, interval)| (knob.spec().name, interval))
                .collect(),
        }
    }
}

/// A number in dimensionless form and in SI units.
#[derive(Serialize)]
struct Both {
    dimensionless: f64,
    physical: f64,
}

#[derive(Serialize)]
struct Friction {
    law: &'static str,
    /// Root mean square distance of a table's points from the law.
    #[serde(skip_serializing_if = "Option::is_none")]
    missed: Option<f64>,
    mu: f64,
    mu1: f64,
    mu2: f64,
    mu3: f64,
    /// The coefficient of static friction between belt and mass.
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

/// All motions of a machine by the whole model.
#[derive(Serialize)]
pub(super) struct PortraitDocument {
    cycles: Vec<MachineCycleDocument>,
    neutral: bool,
    border: MachineBorderDocument,
    margin: Margins,
    /// The right turning point beyond which motions are not known, and why.
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
pub(super) struct MachineCycleDocument {
    kind: &'static str,
    overtakes: bool,
    stable: bool,
    #[serde(flatten)]
    numbers: CycleNumbers,
    /// `None` for a multiplier of 0.
    log_multiplier: Option<f64>,
}

/// The numbers of a cycle, in SI units.
#[derive(Default, Serialize)]
pub(super) struct CycleNumbers {
    x_min: f64,
    x_max: f64,
    v_min: f64,
    v_max: f64,
    period: f64,
    stick_duration: f64,
    /// `None` if it overflows.
    multiplier: Option<f64>,
}

impl From<&Cycle> for CycleNumbers {
    fn from(cycle: &Cycle) -> Self {
        CycleNumbers {
            x_min: cycle.q_min,
            x_max: cycle.q_max,
            v_min: cycle.v_min,
            v_max: cycle.v_max,
            period: cycle.period,
            stick_duration: cycle.stick_duration(),
            multiplier: cycle.multiplier,
        }
    }
}

#[derive(Serialize)]
struct MachineBorderDocument {
    kind: Border,
}

#[derive(Serialize)]
struct Margins {
    /// The smallest kicks that are lost, in m and N s.
    #[serde(flatten)]
    least: Margin,
    /// To the right and to the left, in m.
    displacements: Option<(f64, f64)>,
    /// With and against the belt, in m/s.
    velocities: Option<(f64, f64)>,
}

impl PortraitDocument {
    pub(super) fn new(portrait: &Portrait) -> Self {
        PortraitDocument {
            cycles: portrait.cycles.iter().map(MachineCycleDocument::new).collect(),
            neutral: portrait.neutral,
            border: MachineBorderDocument { kind: portrait.border },
            margin: Margins {
                least: portrait.margin,
                displacements: portrait.reach.map(|reach| reach.displacement),
                velocities: portrait.reach.map(|reach| reach.velocity),
            },
            limit: portrait
                .stop
                .map(|stop| Limit { displacement: portrait.known, reason: stop.to_string() }),
            unresolved: portrait.unresolved.clone(),
        }
    }
}

impl MachineCycleDocument {
    pub(super) fn new(cycle: &Cycle) -> Self {
        MachineCycleDocument {
            kind: cycle.kind(),
            overtakes: cycle.overtakes,
            stable: cycle.stable,
            numbers: cycle.into(),
            log_multiplier: Some(cycle.log_multiplier).filter(|it| it.is_finite()),
        }
    }
}

#[derive(Serialize)]
struct MachineMotionDocument {
    start: StartDocument,
    outcome: OutcomeDocument,
    /// The time up to which it was followed, in s.
    until: f64,
    displacement: (f64, f64),
    velocity: (f64, f64),
    phases: Vec<PhaseDocument>,
    energy: Energy,
    end: MachineState,
    #[serde(skip_serializing_if = "Option::is_none")]
    second: Option<SecondDocument>,
}

/// The motion by a second method, and the difference between the ends.
#[derive(Serialize)]
struct SecondDocument {
    method: &'static str,
    tolerance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    end: Option<MachineState>,
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<MachineState>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

impl SecondDocument {
    fn new(Second { way, tolerance, found }: &Second, first: MachineState) -> Self {
        let end = found.map(|found| found.end);
        let less = |end: MachineState| MachineState {
            t: end.t - first.t,
            x: end.x - first.x,
            v: end.v - first.v,
        };
        SecondDocument {
            method: way.name(),
            tolerance: *tolerance,
            end: end.ok(),
            difference: end.ok().map(less),
            reason: end.err().map(|stop| stop.to_string()),
        }
    }
}

#[derive(Serialize)]
struct StartDocument {
    x: f64,
    v: f64,
}

#[derive(Serialize)]
struct OutcomeDocument {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    cycle: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<f64>,
    /// When it came to rest, if that was within the time followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    t: Option<f64>,
}

#[derive(Serialize)]
struct PhaseDocument {
    t: f64,
    x: f64,
    phase: &'static str,
}

#[derive(Serialize)]
struct Energy {
    #[serde(flatten)]
    works: MachineLedger,
    residual: f64,
}

impl MachineMotionDocument {
    fn new((x, v): (f64, f64), course: &Course) -> Self {
        let Course { motion, fate, rest, .. } = course;
        let named = |kind| OutcomeDocument { kind, cycle: None, x: None, t: None };
        let outcome = match fate {
            Fate::Rest => OutcomeDocument {
                x: *rest,
                t: (motion.outcome == Fate::Rest).then_some(motion.end.t),
                ..named("rest")
            },
            Fate::Cycle(index) => OutcomeDocument { cycle: Some(*index), ..named("cycle") },
            Fate::Neutral => named("neutral"),
            Fate::Moving => named("moving"),
            Fate::Escapes => named("escaped"),
            Fate::Unknown(_) => named("unknown"),
        };
        let phase = |place: ContactState| match place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        };
        MachineMotionDocument {
            start: StartDocument { x, v },
            outcome,
            until: motion.end.t,
            displacement: motion.x,
            velocity: motion.v,
            phases: motion
                .legs
                .iter()
                .map(|leg| PhaseDocument { t: leg.t, x: leg.x, phase: phase(leg.place) })
                .collect(),
            energy: Energy { works: motion.ledger, residual: motion.ledger.residual() },
            end: motion.end,
            second: course.second.as_ref().map(|second| SecondDocument::new(second, motion.end)),
        }
    }
}

#[derive(Serialize)]
pub(super) struct DesignDocument {
    kick: Kick,
    /// In m, or N s.
    margin: f64,
    /// In N.
    #[serde(rename = "R")]
    force: Option<f64>,
    needed: FrictionNeeded,
    message: String,
}

impl DesignDocument {
    pub(super) fn new(designed: &DesignAnswer) -> Self {
        DesignDocument {
            kick: designed.kick,
            margin: designed.wanted,
            force: designed.force(),
            needed: designed.needed,
            message: designed.sentence(),
        }
    }
}

/// Integration steps of the whole model, and the time they took.
#[derive(Serialize)]
pub(super) struct MachineCost {
    pub steps: u64,
    pub seconds: f64,
}

/// The whole answer about a machine as a document.
pub fn json(answer: &MachineAnswer) -> String {
    let MachineAnswer { course, on_belt, .. } = answer;
    let certain = |belt: &OnBelt| Some(MachineGuaranteeDocument::new(belt, belt.certain.as_ref()?));
    text(&MachineDocument {
        machine: answer.head.name,
        model: "whole",
        belt: on_belt.as_ref().map(|belt| BeltDocument::new(&belt.expansion)),
        whole: PortraitDocument::new(&course.portrait),
        motion: MachineMotionDocument::new(answer.start, course),
        guaranteed: on_belt.as_ref().and_then(certain),
        rest_share: answer.rest_share,
        design: answer.design.as_ref().map(DesignDocument::new),
        expansion: on_belt.as_ref().map(|belt| Expansion::new(&belt.expansion, &course.portrait)),
        cost: MachineCost { steps: course.portrait.steps, seconds: answer.seconds },
    })
}
