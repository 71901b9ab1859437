//! The unknowns that are estimated from a record, all in one space: its points, directions and linear maps.

use nalgebra::{SMatrix, SVector};

use crate::model::{Parameters, State};

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
            StartKind::Moving => {
                (t.first().copied().unwrap_or(0.0), State { q: p[Q0], v: p[LAST] })
            }
        }
    }
}

/// The direction along which only one of the unknowns changes.
pub fn direction(place: usize) -> Unknowns {
    let mut by = Unknowns::zeros();
    by[place] = 1.0;
    by
}

/// The parameters of the motion among the unknowns.
#[must_use]
pub fn parameters(p: &Unknowns) -> Parameters {
    Parameters { d: p[D], d2: p[D2], d3: p[D3], r: p[R] }
}
