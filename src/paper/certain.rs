//! What proofs say about claims: beside a number stands an interval that certainly holds it, beside the answer to
//! a question whether it is certain. From these follows the [`Certainty`] of a claim.

use std::ops::Deref;

use super::known::{Known, KnownAnswer, POOR, Sense};
use crate::model::{Parameters, State};
use crate::numerics::Interval;
use crate::portrait::{Border, Cycle};
use crate::proof::motion::{ProvedFate, ProvedMotion, follow};
use crate::proof::{Enclosure, ParameterBox};

/// What is certain about a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// It holds in all cases that were tested.
    Proved,
    /// It does not hold: in one of these at least.
    Refuted,
    /// The number with which it is compared is enclosed: to as many digits as that gives, it holds.
    Enclosed,
}

impl Certainty {
    /// One word for scripts and tables.
    pub fn name(self) -> &'static str {
        match self {
            Certainty::Proved => "proved",
            Certainty::Refuted => "refuted",
            Certainty::Enclosed => "enclosed",
        }
    }

    /// The mark of a claim about two cases.
    pub(crate) fn and(one: Option<Certainty>, other: Option<Certainty>) -> Option<Certainty> {
        match (one?, other?) {
            (Certainty::Refuted, _) | (_, Certainty::Refuted) => Some(Certainty::Refuted),
            (Certainty::Proved, Certainty::Proved) => Some(Certainty::Proved),
            _ => Some(Certainty::Enclosed),
        }
    }

    /// The mark of a formula beside what it is compared with.
    pub(crate) fn of(sense: Sense, formula: f64, computed: &Known) -> Option<Certainty> {
        let bounds = computed.bounds?;
        let formula = with_rounding(formula, computed.error);
        let decided = |holds: bool, fails: bool| match (holds, fails) {
            (true, _) => Some(Certainty::Proved),
            (_, true) => Some(Certainty::Refuted),
            _ => bounds.is_finite().then_some(Certainty::Enclosed),
        };
        match sense {
            Sense::Equal => decided(false, formula.intersection(bounds).is_none()),
            Sense::AtMost => {
                decided(formula.upper() <= bounds.lower(), formula.lower() > bounds.upper())
            }
            Sense::Near => {
                let miss = miss(formula, bounds);
                decided(miss.upper() <= POOR, miss.lower() > POOR)
            }
            Sense::Tends { .. } | Sense::Always => None,
        }
    }

    /// The mark of a limit, from the formula and what it is compared with far from it and nearer.
    pub(crate) fn of_limit(far: (f64, &Known), near: (f64, &Known)) -> Option<Certainty> {
        let miss = |(formula, computed): (f64, &Known)| {
            Some(miss(with_rounding(formula, computed.error), computed.bounds?))
        };
        let (far, near) = (miss(far)?, miss(near)?);
        if near.upper() < far.lower() {
            Some(Certainty::Proved)
        } else if near.lower() > far.upper() {
            Some(Certainty::Refuted)
        } else {
            Some(Certainty::Enclosed)
        }
    }
}

/// A formula that was evaluated in doubles.
fn with_rounding(formula: f64, error: f64) -> Interval {
    /// Far more than the rounding of any formula here, as a fraction of its value.
    const ROUNDING: f64 = 1e-9;
    Interval::around(formula, ROUNDING * formula.abs() + error)
}

/// The relative error of a formula, or its absolute error if one of the two is zero.
fn miss(formula: Interval, bounds: Interval) -> Interval {
    let difference = formula - bounds;
    let zero = Interval::point(0.0);
    let part = if formula == zero || bounds == zero { difference } else { difference / bounds };
    let size = part.square().sqrt();
    Interval::new(size.lower().max(0.0), size.upper())
}

/// A cycle of the search, and bounds of its numbers.
#[derive(Clone, Copy, Debug)]
pub struct BoundedCycle {
    cycle: Cycle,
    /// Where it is proved.
    pub bounds: Option<Enclosure>,
}

impl BoundedCycle {
    /// Of a search and a proof.
    pub fn new(cycle: Cycle, bounds: Option<Enclosure>) -> Self {
        BoundedCycle { cycle, bounds }
    }
}

impl Deref for BoundedCycle {
    type Target = Cycle;

    fn deref(&self) -> &Cycle {
        &self.cycle
    }
}

/// All cycles of the search, and whether it is proved that there are these and no others.
#[derive(Clone, Debug)]
pub struct AllFound {
    pub cycles: Vec<BoundedCycle>,
    /// Whether their number is proved.
    pub certain: bool,
}

impl AllFound {
    /// Whether something holds that depends on the number and the stability of the cycles only.
    pub fn answer(&self, holds: impl Fn(&[BoundedCycle]) -> bool) -> KnownAnswer {
        KnownAnswer { holds: holds(&self.cycles), certain: self.certain }
    }

    /// Whether there are this many.
    pub fn are(&self, number: usize) -> KnownAnswer {
        self.answer(|cycles| cycles.len() == number)
    }
}

/// What borders a basin, and whether that is proved.
#[derive(Clone, Copy, Debug)]
pub struct CertainBorder {
    pub border: Border,
    /// Whether it is proved.
    pub certain: bool,
}

impl CertainBorder {
    /// Whether it is of a kind.
    pub fn is(self, border: Border) -> KnownAnswer {
        KnownAnswer { holds: self.border == border, certain: self.certain }
    }
}

/// The motion from a state, enclosed.
pub fn enclosed(parameters: &Parameters, initial: State, until: f64) -> ProvedMotion {
    let start = [initial.q, initial.v].map(Interval::point);
    follow(&ParameterBox::from(parameters), start, until)
}

/// Bounds of a state at a time before the motion comes to rest.
pub fn enclosed_state(parameters: &Parameters, initial: State, tau: f64) -> Option<[Interval; 2]> {
    match enclosed(parameters, initial, tau).fate {
        ProvedFate::Moving { q, v } => Some([q, v]),
        _ => None,
    }
}
