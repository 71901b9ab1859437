//! Numbers with bounds, and answers to questions: what claims are judged by.

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
    pub fn exceeds(&self, limit: f64) -> KnownAnswer {
        let holds = self.value > limit;
        let certain = self
            .bounds
            .is_some_and(|it| if holds { it.lower() > limit } else { it.upper() <= limit });
        KnownAnswer { holds, certain }
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

/// The answer to a question, and whether it is certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownAnswer {
    /// Whether it is so.
    pub holds: bool,
    /// Whether that is proved.
    pub certain: bool,
}

impl From<bool> for KnownAnswer {
    fn from(holds: bool) -> Self {
        KnownAnswer { holds, certain: false }
    }
}

impl KnownAnswer {
    /// Whether it is as expected.
    pub fn is(self, expected: bool) -> KnownAnswer {
        KnownAnswer { holds: self.holds == expected, ..self }
    }
}
