//! Numbers with bounds, and answers to questions: what claims are judged by. Beside a number stands an interval
//! that certainly holds it, beside the answer to a question whether it is certain. From these follows the
//! [`Certainty`] of a claim.

use std::ops::Neg;

use serde::Serialize;

use crate::numerics::Interval;

/// An approximation that is off by more than this does not count as one. More would let
/// a fold that D2 moves by an eighth pass as one that D2 does not move.
pub const POOR: f64 = 0.1;

/// What is claimed about the two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sense {
    /// They are equal.
    Equal,
    /// The paper's approximates the computed one.
    Near,
    /// The paper's is a lower bound of the computed one.
    AtMost,
    /// They approach each other in a limit; a relative difference further from it is known.
    Tends {
        /// That difference.
        before: f64,
    },
    /// Something holds in all cases: the paper's number is how many cases there are, the computed one in
    /// how many of them it holds.
    Always,
}

/// A number and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The number.
    pub value: f64,
    /// Bound on its error.
    pub error: f64,
    /// An interval that certainly holds it, where a proof gave one.
    pub bounds: Option<Interval>,
}

impl Known {
    /// A number and how far it may be off.
    pub fn new(value: f64, error: f64) -> Self {
        Known { value, error, bounds: None }
    }

    /// With an interval that certainly holds it.
    pub fn within(self, bounds: impl Into<Option<Interval>>) -> Self {
        Known { bounds: bounds.into(), ..self }
    }

    /// With another number added.
    pub fn plus(self, shift: f64) -> Self {
        let bounds = self.bounds.map(|it| it + Interval::point(shift));
        Known { value: self.value + shift, bounds, ..self }
    }

    /// Whether it is larger than a number.
    pub fn exceeds(&self, limit: f64) -> Certain<bool> {
        let value = self.value > limit;
        let certain = self
            .bounds
            .is_some_and(|it| if value { it.lower() > limit } else { it.upper() <= limit });
        Certain { value, certain }
    }

    /// A number that is what it is, such as a count.
    pub fn exact(value: f64) -> Self {
        Known::new(value, 0.0)
    }

    /// A number with a relative error.
    pub fn relative(value: f64, part: f64) -> Self {
        Known::new(value, part * value.abs())
    }

    /// Two answers to one question: the first, with their difference as its error.
    pub fn twice(value: f64, again: f64) -> Self {
        Known::new(value, (value - again).abs() + 4.0 * f64::EPSILON * value.abs())
    }
}

impl Neg for Known {
    type Output = Known;

    fn neg(self) -> Known {
        Known { value: -self.value, bounds: self.bounds.map(|it| -it), ..self }
    }
}

/// The answer to a question, and whether that is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certain<T> {
    /// The answer.
    pub value: T,
    /// Whether it is proved.
    pub certain: bool,
}

impl From<bool> for Certain<bool> {
    fn from(value: bool) -> Self {
        Certain { value, certain: false }
    }
}

impl<T> Certain<T> {
    /// The answer to a question that this one decides.
    pub fn map<A>(&self, decide: impl FnOnce(&T) -> A) -> Certain<A> {
        Certain { value: decide(&self.value), certain: self.certain }
    }
}

impl<T: Copy + PartialEq> Certain<T> {
    /// Whether it is as expected.
    pub fn is(&self, expected: T) -> Certain<bool> {
        self.map(|value| *value == expected)
    }
}

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
