//! The question that a fit answers, and the reasons why there may be no answer.

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

/// The losses by their names on the command line.
pub const LOSSES: [(&str, LossName); 4] = [
    ("auto", LossName::Auto),
    ("linear", LossName::Linear),
    ("soft-l1", LossName::SoftL1),
    ("cauchy", LossName::Cauchy),
];

/// The question that a fit answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// Which numbers are estimated and which are held.
    pub choice: Choice,
    /// How residuals are weighted.
    pub loss: LossName,
    /// Whether the record is a list of peaks.
    pub peaks: bool,
}

/// Why there is no estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfit {
    /// Too few samples or peaks for this many unknowns.
    TooFew {
        /// Number of measured values.
        measured: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The record shows no swings.
    NoSwings,
    /// Successive peaks do not lie on opposite sides.
    NotAlternating {
        /// Number of the first such peak, counted from 1.
        peak: usize,
    },
    /// No motion of the model comes near the record.
    NoMotion,
    /// An unknown has no influence on the record.
    Blind,
    /// The computation was interrupted.
    Interrupted,
    /// The maximum number of motions was reached.
    GaveUp {
        /// Number of motions computed.
        motions: u64,
        /// Root mean square of the residuals of the closest of them; infinite if there is none.
        closest: f64,
    },
    /// The fit is still running.
    Underway {
        /// Number of motions computed so far.
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
                "fewer than two turning points, a hold and a rest included, stand out from the noise: of a single \
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

/// A guess in which held unknowns have their values.
#[must_use]
pub fn placed(held: &[Option<f64>; UNKNOWNS], guess: Unknowns) -> Unknowns {
    std::array::from_fn(|place| held[place].unwrap_or(guess[place]))
}

/// The displacement beyond which a motion counts as escaped, for a record with these displacements.
#[must_use]
pub fn reach(x: &[f64]) -> f64 {
    /// In multiples of the range of the record.
    const FAR: f64 = 30.0;
    let (low, high) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    FAR * (high - low)
}
