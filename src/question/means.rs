//! What a question is answered with.

use crate::flow::{Cost, Limits, Reason};
use crate::study::scan::{Scan, ScanRow};

/// Rows of a scan that follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Number of the first one's point.
    pub first: usize,
    pub rows: Vec<ScanRow>,
}

impl Rows {
    pub(super) fn cost(&self) -> Cost {
        let mut cost = Cost::default();
        self.rows.iter().for_each(|row| cost += row.cost);
        cost
    }
}

/// What a question is answered with.
#[derive(Clone, Copy)]
pub struct Means<'a> {
    /// How many points curves get.
    pub fineness: Fineness,
    /// When to stop.
    pub limits: &'a Limits<'a>,
    /// Computes the rows of a scan from a point on.
    pub rows: &'a dyn Fn(&Scan, usize) -> Result<Rows, Reason>,
}

impl std::fmt::Debug for Means<'_> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Means").field("fineness", &self.fineness).finish_non_exhaustive()
    }
}

/// How many points curves have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// On each integration step of a trajectory.
    pub(super) samples_per_step: usize,
    /// On each integration step of a cycle or a border.
    pub(super) points_per_step: u16,
    /// On the curve of a harmonic answer.
    pub(super) harmonic: usize,
    /// On a piece of a branch.
    pub(super) branch: usize,
    /// On a side of a return map.
    pub(super) map: u16,
    /// Largest distance of the borders of a chart from their chords, as a fraction of the range.
    pub(super) chord: f64,
}

impl Fineness {
    /// As many as the dots of a terminal can show.
    pub const SCREEN: Fineness = Fineness {
        samples_per_step: 16,
        points_per_step: 12,
        harmonic: 240,
        branch: 160,
        map: 128,
        chord: f64::INFINITY,
    };

    /// As many as print can show: chords miss their curves by less than a twentieth of a pixel of a
    /// figure.
    pub const PRINT: Fineness = Fineness {
        samples_per_step: 64,
        points_per_step: 64,
        harmonic: 960,
        branch: 640,
        map: 512,
        chord: 1e-4,
    };

    /// More points on each curve, to look at it more closely.
    pub fn finer(self, times: u16) -> Fineness {
        let several = usize::from(times);
        Fineness {
            samples_per_step: self.samples_per_step * several,
            points_per_step: self.points_per_step.saturating_mul(times),
            harmonic: self.harmonic * several,
            branch: self.branch * several,
            map: self.map.saturating_mul(times),
            chord: self.chord / f64::from(times),
        }
    }
}
