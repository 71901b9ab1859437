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

/// Number of points on each kind of curve, as a multiple of that on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness(u16);

impl Fineness {
    /// As many points as the dots of a terminal can show.
    pub const SCREEN: Fineness = Fineness(1);

    /// As many points as print can show: chords deviate from their curves by less than a twentieth of a pixel
    /// of a figure.
    pub const PRINT: Fineness = Fineness(4);

    /// `times` as many points on each curve, for a closer look.
    pub fn finer(self, times: u16) -> Fineness {
        Fineness(self.0.saturating_mul(times))
    }

    /// Points on a curve that has so many on the screen.
    pub(super) fn points(self, on_screen: u16) -> u16 {
        self.0.saturating_mul(on_screen)
    }

    /// On each integration step of a cycle or a border.
    pub(super) fn points_per_step(self) -> u16 {
        self.points(if self == Self::SCREEN { 12 } else { 16 })
    }

    /// Largest distance of the borders of a chart from their chords, as a fraction of the range.
    pub(super) fn chord(self) -> f64 {
        if self == Self::SCREEN { f64::INFINITY } else { 4e-4 / f64::from(self.0) }
    }
}
