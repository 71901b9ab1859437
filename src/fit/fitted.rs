//! The whole result of a fit, with what the record itself does not contain: its unit, and a mass or stiffness.

use super::curves::Curves;
use super::estimate::Estimate;
use super::inertia::Inertia;
use super::margin::Margins;
use super::names::NameSpec;
use super::observation::{OFFSET, OMEGA0};
use super::record::Record;
use super::signal::length_in_metres;
use crate::model::belt::Units;

/// The whole result of a fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The name of the file.
    pub name: String,
    /// The data read from the file.
    pub record: Record,
    /// The estimate.
    pub estimate: Estimate,
    /// The distribution of the margin.
    pub margins: Margins,
    /// The curves in its pictures.
    pub curves: Curves,
    /// For the pictures: the contours in the plane of D and r along which chi-squared has risen by each of
    /// [`RISES`](super::contour::RISES).
    pub contours: Vec<Vec<[f64; 2]>>,
    /// Mass or stiffness, if known, and the unit of the displacements in m.
    pub inertia: Option<(Inertia, f64)>,
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl Fitted {
    /// The units of time, length, velocity, force and impulse; the last two are NaN if neither mass nor
    /// stiffness is known. `None` without an estimated frequency or a known unit of length.
    #[must_use]
    pub fn units(&self) -> Option<Units> {
        let displacement = length_in_metres(self.unit()).filter(|_| self.estimate.free[OMEGA0])?;
        let omega_0 = self.estimate.p[OMEGA0];
        let mass = self.inertia.map_or(f64::NAN, |(inertia, _)| inertia.times(omega_0, 0));
        let velocity = omega_0 * displacement;
        let (impulse, force) = (mass * velocity, mass * omega_0 * velocity);
        Some(Units { omega_0, displacement, velocity, time: 1.0 / omega_0, impulse, force })
    }

    /// Number of motions computed with and without derivatives; the latter include those for the weights of the
    /// draws.
    #[must_use]
    pub fn motions(&self) -> (u64, u64) {
        let (with, without) = self.estimate.motions;
        (with, without + self.margins.motions)
    }

    /// The unit of lengths as written after numbers; empty if unknown.
    #[must_use]
    pub fn unit(&self) -> &str {
        self.record.unit.as_deref().unwrap_or("")
    }

    /// The unit of the signal.
    #[must_use]
    pub fn signal_unit(&self) -> String {
        self.record.signal.unit(self.unit())
    }

    /// The unit of a number: the offset is one of the signal.
    #[must_use]
    pub fn unit_of(&self, row: &NameSpec) -> String {
        let length = row.unit(self.unit());
        if row.place == OFFSET { self.record.signal.unit(&length) } else { length }
    }
}
