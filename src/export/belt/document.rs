//! A machine's answer as a JSON document; physical quantities are in SI units.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Answer, Designed, alarm};
use crate::export::json::{Price, text};
use crate::flow::Outcome;
use crate::oscillator::belt::{Derivatives, FrictionLaw, QUANTITIES, TaylorError, Units};
use crate::oscillator::{Belt, Parameters};
use crate::study::belt::{Alarm, Contact, PhysicalMargin, Reach, Survey};
use crate::study::design::{Kick, Needed};
use crate::study::{Cycle, Edge, Margin};

#[derive(Serialize)]
struct Document<'a> {
    machine: &'a str,
    quantities: BTreeMap<&'static str, f64>,
    friction: Friction,
    units: &'a Units,
    parameters: &'a Parameters,
    sticking_velocity: Both,
    rest_band: Both,
    cycles: Vec<CycleOf<'a>>,
    basin: Basin,
    margin: Margins,
    motion: Motion,
    alarms: Vec<Sentence>,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignOf>,
    cost: Price,
}

/// A number without unit, and in SI units.
#[derive(Serialize)]
struct Both {
    dimensionless: f64,
    physical: f64,
}

#[derive(Serialize)]
pub(super) struct Friction {
    law: &'static str,
    /// Quadratic mean of the distances of a table's points from the law.
    #[serde(skip_serializing_if = "Option::is_none")]
    missed: Option<f64>,
    mu: f64,
    mu1: f64,
    mu2: f64,
    mu3: f64,
}

impl Friction {
    fn new(law: &FrictionLaw, mu: &Derivatives) -> Self {
        let missed = match law {
            FrictionLaw::Table(spline) => Some(spline.missed()),
            _ => None,
        };
        let Derivatives { value, first, second, third } = *mu;
        Friction { law: law.name(), missed, mu: value, mu1: first, mu2: second, mu3: third }
    }
}

#[derive(Serialize)]
struct Basin {
    edge: Edge,
}

#[derive(Serialize)]
struct CycleOf<'a> {
    stable: bool,
    x_min: f64,
    x_max: f64,
    v_min: f64,
    v_max: f64,
    period: f64,
    reaches_belt: bool,
    taylor: Option<TaylorError>,
    dimensionless: &'a Cycle,
}

#[derive(Serialize)]
struct Margins {
    #[serde(flatten)]
    physical: PhysicalMargin,
    dimensionless: Margin,
}

#[derive(Serialize)]
struct Motion {
    start: Start,
    outcome: PhysicalOutcome,
    displacement: (f64, f64),
    velocity: (f64, f64),
    taylor: Option<TaylorError>,
}

#[derive(Serialize)]
struct Start {
    x: f64,
    v: f64,
}

/// How a motion ended, in SI units.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub(super) enum PhysicalOutcome {
    SticksToBelt { t: f64, x: f64 },
    Captured { t: f64, x: f64 },
    Moving { t: f64, x: f64, v: f64 },
    Escaped { t: f64 },
    GaveUp { t: f64, reason: String },
}

impl PhysicalOutcome {
    /// Of the motion: what it does after it has reached the belt is not known.
    pub(super) fn new(survey: &Survey) -> Self {
        if let Some(Contact { t, x }) = survey.reach.sticks {
            return Self::SticksToBelt { t, x };
        }
        let units = &survey.reduced.units;
        let (time, length) = (units.time, units.displacement);
        match survey.motion.outcome {
            Outcome::Captured { tau, q } => Self::Captured { t: tau * time, x: q * length },
            Outcome::Moving { tau, q, v } => {
                Self::Moving { t: tau * time, x: q * length, v: v * units.velocity }
            }
            Outcome::Escaped { tau } => Self::Escaped { t: tau * time },
            Outcome::GaveUp { tau, reason } => {
                Self::GaveUp { t: tau * time, reason: reason.to_string() }
            }
        }
    }
}

#[derive(Serialize)]
struct Sentence {
    #[serde(flatten)]
    alarm: Alarm,
    message: String,
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
    pub(super) fn new(designed: &Designed, belt: &Belt, units: &Units) -> Self {
        DesignOf {
            kick: designed.kick,
            margin: designed.wanted,
            force: designed.force(units),
            needed: designed.design.needed,
            message: designed.sentence(belt, units),
        }
    }
}

/// Everything that is said about a machine, as a document.
#[must_use]
pub fn json(answer: &Answer) -> String {
    let survey = answer.survey;
    let (belt, reduced) = (&survey.belt, &survey.reduced);
    let units = &reduced.units;
    let pairs = survey.cycles.cycles.iter().zip(&survey.reaches);
    let mut cost = survey.cost;
    if let Some(designed) = &answer.design {
        cost += designed.design.cost;
    }
    text(&Document {
        machine: &answer.machine.name,
        quantities: QUANTITIES.iter().map(|row| (row.name, belt.get(row.quantity))).collect(),
        friction: Friction::new(&belt.law, &reduced.mu),
        units,
        parameters: &reduced.parameters,
        sticking_velocity: Both {
            dimensionless: reduced.sticking_velocity,
            physical: belt.belt_speed,
        },
        rest_band: Both {
            dimensionless: reduced.parameters.r,
            physical: belt.friction / belt.stiffness,
        },
        cycles: pairs.map(|(cycle, reach)| cycle_of(cycle, reach, units)).collect(),
        basin: Basin { edge: survey.cycles.edge },
        margin: Margins {
            physical: PhysicalMargin::new(&survey.margin(), units),
            dimensionless: survey.margin(),
        },
        motion: Motion {
            start: Start { x: answer.machine.displacement, v: answer.machine.velocity },
            outcome: PhysicalOutcome::new(survey),
            displacement: survey.reach.displacement,
            velocity: survey.reach.velocity,
            taylor: survey.reach.taylor,
        },
        alarms: survey
            .alarms()
            .into_iter()
            .map(|found| Sentence { alarm: found, message: alarm(&found, belt) })
            .collect(),
        design: answer.design.as_ref().map(|designed| DesignOf::new(designed, belt, units)),
        cost: Price { counted: cost, seconds: answer.seconds },
    })
}

fn cycle_of<'a>(cycle: &'a Cycle, reach: &Reach, units: &Units) -> CycleOf<'a> {
    CycleOf {
        stable: cycle.stable,
        x_min: cycle.q_min * units.displacement,
        x_max: cycle.q_max * units.displacement,
        v_min: reach.velocity.0,
        v_max: reach.velocity.1,
        period: cycle.period * units.time,
        reaches_belt: reach.sticks.is_some(),
        taylor: reach.taylor,
        dimensionless: cycle,
    }
}
