//! The means by which a question is answered.

use crate::flow::{Cost, Limits, Reason};
use crate::scan::grid::{Scan, ScanRow};

/// Consecutive rows of a scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Index of the first row's point.
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

/// The means by which a question is answered.
#[derive(Clone, Copy)]
pub struct Resources<'a> {
    /// Number of points on curves.
    pub fineness: Fineness,
    /// When to stop.
    pub limits: &'a Limits<'a>,
    /// Computes rows of a scan, beginning with the point of this index.
    pub rows: &'a dyn Fn(&Scan, usize) -> Result<Rows, Reason>,
}

impl std::fmt::Debug for Resources<'_> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Resources").field("fineness", &self.fineness).finish_non_exhaustive()
    }
}

/// Number of points on each kind of curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// On each integration step of a trajectory.
    pub(super) samples_per_step: usize,
    /// On each integration step of a cycle or a border.
    pub(super) points_per_step: u16,
    /// On the curve of a harmonic balance.
    pub(super) harmonic: usize,
    /// On a piece of a branch.
    pub(super) branch: usize,
    /// On a side of a return map.
    pub(super) map: u16,
    /// Largest distance of the borders of a chart from their chords, as a fraction of the range.
    pub(super) chord: f64,
}

impl Fineness {
    /// As many points as the dots of a terminal can show.
    pub const SCREEN: Fineness = Fineness {
        samples_per_step: 16,
        points_per_step: 12,
        harmonic: 240,
        branch: 160,
        map: 128,
        chord: f64::INFINITY,
    };

    /// As many points as print can show: chords deviate from their curves by less than a twentieth of a pixel
    /// of a figure.
    pub const PRINT: Fineness = Fineness {
        samples_per_step: 64,
        points_per_step: 64,
        harmonic: 960,
        branch: 640,
        map: 512,
        chord: 1e-4,
    };

    /// `times` as many points on each curve, for a closer look.
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
