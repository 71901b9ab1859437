//! What a computation may cost, what becomes of a motion, and why a computation may end without an answer.

use std::fmt;

use serde::Serialize;

/// Bounds on a computation: a budget of evaluations and a means of interruption.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// Maximum number of evaluations of the field (a Taylor series of order N counts as N).
    pub evaluations: u64,
    /// Called at every step; `true` ends the computation with [`Reason::Interrupted`].
    pub interrupted: &'a (dyn Fn() -> bool + Sync),
}

impl Limits<'static> {
    /// The budget of one question, without interruption: a few seconds of computing.
    pub const PATIENT: Limits<'static> =
        Limits { evaluations: 400_000_000, interrupted: &|| false };
}

impl Default for Limits<'static> {
    fn default() -> Self {
        Limits::PATIENT
    }
}

/// Why a computation gave up, with the numbers that explain it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "why")]
pub enum Reason {
    /// A newer question replaced this one.
    Interrupted,
    /// The budget of evaluations is spent.
    Budget {
        /// Evaluations spent.
        evaluations: u64,
    },
    /// The step that the tolerance requires is too small to advance the time.
    StepTooSmall {
        /// Size of that step.
        step: f64,
    },
    /// The fixed step is too long for the damping that the motion encounters.
    StepTooLong {
        /// The step.
        step: f64,
        /// The longest step that is stable there.
        stable: f64,
    },
    /// The motion has more half swings than are kept.
    HalfSwings {
        /// How many are.
        most: usize,
    },
    /// A number left the floating-point range.
    OutOfRange,
    /// The method does not apply to these parameters.
    NotApplicable {
        /// What the method requires.
        needs: &'static str,
    },
    /// An iteration did not converge.
    NoConvergence {
        /// The quantity sought.
        sought: &'static str,
        /// Relative change at which the iteration stopped.
        change: f64,
    },
}

impl fmt::Display for Reason {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Interrupted => write!(out, "interrupted"),
            Reason::Budget { evaluations } => {
                write!(out, "budget of {evaluations} evaluations spent")
            }
            Reason::StepTooSmall { step } => {
                write!(out, "step {step:.1e} is too small to move the time")
            }
            Reason::StepTooLong { step, stable } => {
                write!(out, "step {step:.1e} is unstable here; at most {stable:.1e} would do")
            }
            Reason::HalfSwings { most } => {
                write!(out, "the motion has more than {most} half swings; ask for a shorter time")
            }
            Reason::OutOfRange => write!(out, "left the range of floating-point numbers"),
            Reason::NotApplicable { needs } => write!(out, "the method needs {needs}"),
            Reason::NoConvergence { sought, change } => {
                write!(out, "{sought} did not settle (last relative change {change:.1e})")
            }
        }
    }
}

impl std::error::Error for Reason {}

/// What becomes of a motion: for good, or for as long as it was followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate<Why = Reason> {
    /// It comes to rest; without friction at the steady state, in infinite time.
    Rest,
    /// It tends to the cycle with this index, counted by amplitude, or starts on it.
    Cycle(usize),
    /// It is periodic, one of a family.
    Neutral,
    /// It still moves when time is up.
    Moving,
    /// It grows without bound.
    Escapes,
    /// It could not be followed far enough.
    Unknown(Why),
}

impl<W> Fate<W> {
    /// The word of files for how a motion ended that was followed for a time.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Fate::Rest => "captured",
            Fate::Escapes => "escaped",
            Fate::Unknown(_) => "gave-up",
            Fate::Cycle(_) | Fate::Neutral | Fate::Moving => "moving",
        }
    }
}
