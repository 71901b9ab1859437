//! What is asked of a fit, and why there may be no answer.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::levenberg_marquardt::NoFit;
use super::names::Choice;
use super::observation::{UNKNOWNS, Unknowns};

/// How residuals count, as the user says it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "explorer", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum LossName {
    /// Squared, without the samples that cannot belong to the motion.
    #[default]
    Auto,
    /// Squared, every one of them.
    Linear,
    /// Large ones by their size.
    SoftL1,
    /// Large ones hardly at all.
    Cauchy,
}

/// The losses by the names that users give them.
pub const LOSSES: [(&str, LossName); 4] = [
    ("auto", LossName::Auto),
    ("linear", LossName::Linear),
    ("soft-l1", LossName::SoftL1),
    ("cauchy", LossName::Cauchy),
];

/// What is asked of a fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// What is estimated and what is held.
    pub choice: Choice,
    /// How residuals count.
    pub loss: LossName,
    /// Whether the record is a list of peaks.
    pub peaks: bool,
}

/// Why there is no estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfit {
    /// Too few samples or peaks for this many unknowns.
    TooFew {
        /// Numbers measured.
        measured: usize,
        /// Unknowns.
        unknowns: usize,
    },
    /// The record shows no swings.
    NoSwings,
    /// Peaks that do not lie on opposite sides in turn.
    NotAlternating {
        /// Number of the first such peak, from 1.
        peak: usize,
    },
    /// No motion of the model comes near the record.
    NoMotion,
    /// An unknown has no influence on the record.
    Blind,
    /// A newer question took its place.
    Interrupted,
    /// The work was bounded.
    GaveUp {
        /// Motions computed.
        motions: u64,
        /// How far the closest of them is off, as a root mean square; infinite where none was found.
        closest: f64,
    },
    /// It is being fitted.
    Underway {
        /// Motions computed so far.
        motions: u64,
    },
}

impl fmt::Display for Unfit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unfit::TooFew { measured, unknowns } => {
                write!(out, "{measured} measured numbers cannot tell {unknowns} unknowns")
            }
            Unfit::NoSwings => write!(
                out,
                "fewer than three turning points, a hold and a rest included, stand out from the noise: of a single \
                 swing friction and offset cannot be told apart"
            ),
            Unfit::NotAlternating { peak } => write!(
                out,
                "peaks {peak} to {} do not alternate: successive turning points lie on opposite sides, and of \
                 magnitudes those on one side need their minus sign",
                peak + 2
            ),
            Unfit::NoMotion => write!(out, "no motion of the model comes near the record"),
            Unfit::Blind => write!(
                out,
                "the record does not depend on one of the unknowns; hold some with --set or --free"
            ),
            Unfit::Interrupted => write!(out, "interrupted"),
            Unfit::GaveUp { motions, closest } => write!(
                out,
                "gave up after {motions} motions, the closest of which is off by {closest:.2e} in the unit of the record: \
                 no motion of the model explains it"
            ),
            Unfit::Underway { motions } => write!(out, "fitting: {motions} motions so far"),
        }
    }
}

impl std::error::Error for Unfit {}

impl From<NoFit> for Unfit {
    fn from(reason: NoFit) -> Self {
        match reason {
            NoFit::Lost => Unfit::NoMotion,
            NoFit::Interrupted => Unfit::Interrupted,
        }
    }
}

/// A guess with the held values in their places.
#[must_use]
pub fn placed(held: &[Option<f64>; UNKNOWNS], guess: Unknowns) -> Unknowns {
    std::array::from_fn(|place| held[place].unwrap_or(guess[place]))
}

/// The size beyond which a motion has escaped, for a record with these displacements.
#[must_use]
pub fn reach(x: &[f64]) -> f64 {
    /// In ranges of the record.
    const FAR: f64 = 30.0;
    let (low, high) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    FAR * (high - low)
}
