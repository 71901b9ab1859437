//! A motion as data: the problem, what to keep of the solution, and the solution.

use serde::{Deserialize, Serialize};

use super::limits::Reason;
use super::method::Method;
use crate::model::{Knob, Ledger, Parameters, State};

/// An initial value problem.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// Parameters of the oscillator.
    pub parameters: Parameters,
    /// Where the motion starts, at `tau = 0`.
    pub initial: State,
    /// Time at which to stop.
    pub until: f64,
    /// How to integrate.
    pub method: Method,
    /// Largest relative error of a step.
    pub tolerance: f64,
    /// Step length of the methods with a fixed step.
    pub step: f64,
    /// Velocity over which the method `smoothed` smoothes friction.
    pub epsilon: f64,
}

impl Problem {
    /// Reads a number of the motion, or of how it is computed; not a number if it is one of a machine.
    #[must_use]
    pub fn get(&self, knob: Knob) -> f64 {
        match knob {
            Knob::Until => self.until,
            Knob::Tolerance => self.tolerance,
            Knob::Step => self.step,
            Knob::Epsilon => self.epsilon,
            _ => knob.get(&self.parameters, &self.initial),
        }
    }

    /// Writes a number of the motion, or of how it is computed; one of a machine changes nothing.
    pub fn set(&mut self, knob: Knob, value: f64) {
        match knob {
            Knob::Until => self.until = value,
            Knob::Tolerance => self.tolerance = value,
            Knob::Step => self.step = value,
            Knob::Epsilon => self.epsilon = value,
            _ => knob.set(&mut self.parameters, &mut self.initial, value),
        }
    }
}

impl Default for Problem {
    /// A motion of the plain oscillator to the end time 60, to ten digits.
    fn default() -> Self {
        Problem {
            parameters: Parameters::default(),
            initial: State::default(),
            until: Knob::Until.usual(),
            method: Method::Auto,
            tolerance: Knob::Tolerance.usual(),
            step: Knob::Step.usual(),
            epsilon: Knob::Epsilon.usual(),
        }
    }
}

/// What to keep of a motion besides its outcome. What is not requested costs nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail {
    /// Every arrival at `v = 0`. Without friction nothing happens there, so unless crossings are requested no
    /// method looks for them. With friction a motion cannot be followed without them.
    pub crossings: bool,
    /// Number of points for drawing on each integration step (0 for none).
    pub samples_per_step: usize,
    /// The energy ledger.
    pub energy: bool,
}

impl Default for Detail {
    /// The crossings only.
    fn default() -> Self {
        Detail { crossings: true, samples_per_step: 0, energy: false }
    }
}

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Outcome {
    /// At rest on the sticking set since `tau`.
    Captured {
        /// Time of the arrival.
        tau: f64,
        /// Displacement at rest.
        q: f64,
    },
    /// Still moving at the end time.
    Moving {
        /// The end time.
        tau: f64,
        /// Displacement at the end time.
        q: f64,
        /// Velocity at the end time.
        v: f64,
    },
    /// The velocity runs to infinity in finite time.
    Escaped {
        /// Estimated time of the blow-up.
        tau: f64,
    },
    /// No answer.
    GaveUp {
        /// The time reached.
        tau: f64,
        /// Why the computation gave up.
        #[serde(serialize_with = "reason_as_text")]
        reason: Reason,
    },
}

fn reason_as_text<S: serde::Serializer>(reason: &Reason, out: S) -> Result<S::Ok, S::Error> {
    out.collect_str(reason)
}

/// An arrival at `v = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Crossing {
    /// Time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
}

/// A point of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time.
    pub tau: f64,
    /// Displacement.
    pub q: f64,
    /// Velocity.
    pub v: f64,
}

impl Sample {
    /// The point of the phase plane.
    pub fn state(&self) -> State {
        State { q: self.q, v: self.v }
    }
}

/// Operation counts of a computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Cost {
    /// Evaluations of the field; a Taylor series of order N counts as N.
    pub evaluations: u64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

impl std::ops::AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.steps += other.steps;
        self.rejected += other.rejected;
    }
}

/// A computed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// The problem that was solved.
    pub problem: Problem,
    /// The method that took most of the steps; never `Auto`.
    pub method: Method,
    /// Steps that `Auto` took with the implicit method.
    pub implicit_steps: u64,
    /// How the motion ended.
    pub outcome: Outcome,
    /// Every arrival at `v = 0` after the start, the last one included.
    pub crossings: Vec<Crossing>,
    /// The energy balance, if requested.
    pub ledger: Option<Ledger>,
    /// Points for drawing, if requested; the first is the start.
    pub samples: Vec<Sample>,
    /// Cost of the computation.
    pub cost: Cost,
}
