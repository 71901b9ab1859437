//! The unknowns that are estimated from a record, all in one space: its points, directions and linear maps. The question that
//! a fit answers: which of them are estimated, how residuals count, and what the record does not contain; and the reasons
//! why there may be no answer.

use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize, Serializer};
use thiserror::Error;

use super::range;
use crate::model::{KNOBS, Knob, Parameters, State, unknown};
use crate::numerics::{ln_1p, powi};

/// Number of unknowns.
pub const UNKNOWNS: usize = 10;

/// Places of the unknowns.
pub const OMEGA0: usize = 0;
/// See [`OMEGA0`].
pub const OFFSET: usize = 1;
/// See [`OMEGA0`].
pub const D: usize = 2;
/// See [`OMEGA0`].
pub const D2: usize = 3;
/// See [`OMEGA0`].
pub const D3: usize = 4;
/// See [`OMEGA0`].
pub const R: usize = 5;
/// See [`OMEGA0`].
pub const Q0: usize = 6;
/// The time of release, of the first peak, or the velocity at the first sample.
pub const LAST: usize = 7;
/// The change of the offset from the beginning to the end of the record.
pub const SLOPE: usize = 8;
/// Four times the height of the ends of the record above its middle, by which the offset bends; its mean is zero.
pub const BEND: usize = 9;

/// Values of the unknowns: angular frequency in 1/s, lengths in the unit of the record, times in s, the initial
/// velocity as `velocity/omega0`.
pub type Unknowns = SVector<f64, UNKNOWNS>;

/// A linear map of the unknowns; each says what it has for those that are held.
pub type UnknownsMatrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// How the recorded motion begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartKind {
    /// Held at rest, then released.
    Release,
    /// In motion at the first sample.
    Moving,
}

impl StartKind {
    /// When a motion begins that is observed at these times, and its first state.
    pub fn beginning(self, p: &Unknowns, t: &[f64]) -> (f64, State) {
        match self {
            StartKind::Release => (p[LAST], State { q: p[Q0], v: 0.0 }),
            StartKind::Moving => (*t.first().unwrap_or(&0.0), State { q: p[Q0], v: p[LAST] }),
        }
    }
}

/// The direction along which only one of the unknowns changes.
pub fn direction(place: usize) -> Unknowns {
    Unknowns::ith(place, 1.0)
}

/// The parameters of the motion among the unknowns.
pub fn parameters(p: &Unknowns) -> Parameters {
    Parameters { d: p[D], d2: p[D2], d3: p[D3], r: p[R] }
}

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
    /// `2 s^2 (sqrt(1 + (e/s)^2) - 1)`: large ones by their size.
    SoftL1,
    /// `s^2 ln(1 + (e/s)^2)`: large ones hardly more than moderate ones.
    Cauchy,
}

/// A loss function: the square of a residual, or less if the residual is large.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
    /// Its name; [`LossName::Auto`] counts as linear.
    pub name: LossName,
    /// The size beyond which a residual is large.
    pub scale: f64,
}

impl Loss {
    /// The square.
    pub const LINEAR: Self = Loss { name: LossName::Linear, scale: f64::INFINITY };

    /// The loss of a residual.
    pub fn of(self, residual: f64) -> f64 {
        let Loss { name, scale } = self;
        let part = powi(residual / scale, 2);
        match name {
            LossName::Auto | LossName::Linear => residual * residual,
            // sqrt(1 + z) - 1 without cancellation.
            LossName::SoftL1 => 2.0 * scale * scale * part / (1.0 + (1.0 + part).sqrt()),
            LossName::Cauchy => scale * scale * ln_1p(part),
        }
    }

    /// The weight of a residual in the equivalent weighted least-squares problem: the derivative of the loss with
    /// respect to `e^2`.
    pub fn weight(self, residual: f64) -> f64 {
        let part = powi(residual / self.scale, 2);
        match self.name {
            LossName::Auto | LossName::Linear => 1.0,
            LossName::SoftL1 => 1.0 / (1.0 + part).sqrt(),
            LossName::Cauchy => 1.0 / (1.0 + part),
        }
    }
}

/// One row of [`NAMES`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NameSpec {
    /// The number.
    pub knob: Knob,
    /// The name on the command line and in documents.
    pub name: &'static str,
    /// Its place among the unknowns.
    pub place: usize,
    /// Its unit, in which `L` stands for the unit of length.
    unit: &'static str,
}

impl NameSpec {
    /// Its unit, with the record's unit of length.
    pub fn unit(&self, length: &str) -> String {
        self.unit.replace('L', if length.is_empty() { "unit" } else { length })
    }
}

const fn row(knob: Knob, place: usize, unit: &'static str) -> NameSpec {
    NameSpec { knob, name: KNOBS[knob as usize].name, place, unit }
}

/// The numbers that are estimated from a record, except those of its start.
pub const NAMES: [NameSpec; 6] = [
    row(Knob::Omega0, OMEGA0, "1/s"),
    row(Knob::Offset, OFFSET, "L"),
    row(Knob::D, D, ""),
    row(Knob::D2, D2, "1/L"),
    row(Knob::D3, D3, "1/L^2"),
    row(Knob::R, R, "L"),
];

/// The row of this number.
pub fn row_of(symbol: Knob) -> Option<&'static NameSpec> {
    NAMES.iter().find(|row| row.knob == symbol)
}

/// The row with this name.
pub fn named(name: &str) -> Option<&'static NameSpec> {
    NAMES.iter().find(|row| row.name == name)
}

/// The rows with these names, separated by commas.
///
/// # Errors
/// One line that lists the known names.
pub fn listed(text: &str) -> Result<Vec<&'static NameSpec>, String> {
    text.split(',').map(known).collect()
}

fn known(text: &str) -> Result<&'static NameSpec, String> {
    named(text.trim()).ok_or_else(|| unknown(text, &NAMES.map(|row| row.name)))
}

/// A number to be held and its value, from `NAME=VALUE`.
///
/// # Errors
/// One line that says what is allowed.
pub fn assigned(text: &str) -> Result<(&'static NameSpec, f64), String> {
    let (key, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as D3=0")?;
    let row = known(key)?;
    Ok((row, row.knob.parse(value)?))
}

/// Which numbers a fit estimates, and which it holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SavedChoice")]
pub struct Choice {
    /// Numbers to estimate; `None` for all that are not held.
    pub free: Option<Vec<&'static NameSpec>>,
    /// Numbers to hold, with their values.
    pub held: Vec<(&'static NameSpec, f64)>,
}

/// A [`Choice`] by names, as it is saved.
#[derive(Deserialize)]
struct SavedChoice {
    free: Option<Vec<String>>,
    held: Vec<(String, f64)>,
}

impl Serialize for NameSpec {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.name)
    }
}

impl TryFrom<SavedChoice> for Choice {
    type Error = String;

    fn try_from(SavedChoice { free, held }: SavedChoice) -> Result<Self, String> {
        let free = free.map(|names| names.iter().map(|name| known(name)).collect()).transpose()?;
        let held = held.iter().map(|(name, value)| assigned(&format!("{name}={value}")));
        Ok(Choice { free, held: held.collect::<Result<_, _>>()? })
    }
}

impl Choice {
    /// The value at which a number is held; `None` if it is free. Damping and friction that are neither free
    /// nor set are held at zero. `omega0` and the offset are free unless set, since every record depends on
    /// them.
    pub fn held(&self, row: &NameSpec) -> Option<f64> {
        let set = self.held.iter().find(|(held, _)| *held == row).map(|(_, value)| *value);
        let is_needed = row.place < D;
        set.or((!is_needed && !self.is_wanted(row)).then_some(0.0))
    }

    /// Whether an estimate of this number is asked for.
    pub fn is_wanted(&self, row: &NameSpec) -> bool {
        let held = self.held.iter().any(|(held, _)| *held == row);
        !held && self.free.as_ref().is_none_or(|free| free.contains(&row))
    }

    /// The values at which unknowns are held; `None` for the free ones.
    pub fn unknowns(&self) -> [Option<f64>; UNKNOWNS] {
        let mut held = [None; UNKNOWNS];
        (held[SLOPE], held[BEND]) = (Some(0.0), Some(0.0));
        for row in &NAMES {
            held[row.place] = self.held(row);
        }
        held
    }
}

/// The question that a fit answers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Question {
    /// Whether the record is a list of peaks.
    pub peaks: bool,
    /// Which numbers are estimated and which are held.
    pub choice: Choice,
    /// How residuals are weighted.
    pub loss: LossName,
}

/// The mass or stiffness, which a record does not contain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inertia {
    /// Mass in kg.
    Mass(f64),
    /// Stiffness in N/m.
    Stiffness(f64),
}

impl Inertia {
    /// The power of `omega0` that it is the mass times.
    pub fn power(self) -> i32 {
        match self {
            Inertia::Mass(_) => 0,
            Inertia::Stiffness(_) => 2,
        }
    }

    /// The mass times a power of `omega0`.
    pub fn times(self, omega0: f64, power: i32) -> f64 {
        let (Inertia::Mass(size) | Inertia::Stiffness(size)) = self;
        size * powi(omega0, power - self.power())
    }
}

/// Why there is no estimate.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoEstimate {
    /// Too few samples or peaks for this many unknowns.
    #[error("{measured} measured numbers cannot tell {unknowns} unknowns")]
    TooFew {
        /// Number of measured values.
        measured: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The record shows no swings.
    #[error(
        "fewer than two turning points, a hold and a rest included, stand out from the noise: of a single swing friction \
         and offset cannot be told apart"
    )]
    NoSwings,
    /// Successive peaks do not lie on opposite sides.
    #[error(
        "peaks {peak} to {} do not alternate: successive turning points lie on opposite sides, and of magnitudes those on \
         one side need their minus sign",
        peak + 2
    )]
    NotAlternating {
        /// Number of the first such peak, counted from 1.
        peak: usize,
    },
    /// No motion of the model comes near the record; that of a guess escapes.
    #[error("no motion of the model comes near the record")]
    NoMotion,
    /// An unknown has no influence on the record.
    #[error("the record does not depend on one of the unknowns; hold some with --set or --free")]
    Blind,
    /// The computation was interrupted.
    #[error("interrupted")]
    Interrupted,
    /// The maximum number of motions was reached.
    #[error(
        "gave up after {motions} motions, the closest of which is off by {closest:.2e} in the unit of the record: no \
         motion of the model explains it"
    )]
    GaveUp {
        /// Number of motions computed.
        motions: u64,
        /// Root mean square of the residuals of the closest of them; infinite if there is none.
        closest: f64,
    },
    /// The fit is still running.
    #[error("fitting: {motions} motions so far")]
    Underway {
        /// Number of motions computed so far.
        motions: u64,
    },
}

/// A guess in which held unknowns have their values.
pub fn placed(held: &[Option<f64>; UNKNOWNS], guess: Unknowns) -> Unknowns {
    Unknowns::from_fn(|place, _| held[place].unwrap_or(guess[place]))
}

/// The displacement beyond which a motion counts as escaped, for a record with these displacements.
pub fn reach(x: &[f64]) -> f64 {
    /// In multiples of the range of the record.
    const FAR: f64 = 30.0;
    let (low, high) = range(x);
    FAR * (high - low)
}
