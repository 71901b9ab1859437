//! The whole result of a fit, with what the record itself does not contain, its unit and a mass or stiffness; the forces and
//! damping constants that follow from these; and the damping numbers that the data cannot separate.
//!
//! The damping of a motion at amplitude A is `D + 2 r/(pi A) + (3/8) D3 A^2`, and over a small range of
//! amplitudes the terms cannot be separated. If the errors of terms are of the order of the damping itself, the
//! combination of these terms that the data determine is reported instead.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::{
    Curves, D, D2, D3, Estimate, Inertia, Margins, NAMES, NameSpec, OFFSET, OMEGA0, R, Record,
    averaged, length_in_metres, parameters,
};
use crate::model::belt::Units;
use crate::numerics::elementary::powi;

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
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl Fitted {
    /// A fit with its curves.
    #[must_use]
    pub fn new(name: String, record: Record, estimate: Estimate, margins: Margins) -> Self {
        let curves = Curves::of(&estimate, &margins);
        Fitted { name, record, estimate, margins, curves, seconds: 0.0 }
    }

    /// Mass or stiffness, if known, and the unit of the displacements in m.
    #[must_use]
    pub fn inertia(&self) -> Option<(Inertia, f64)> {
        self.margins.question.inertia
    }

    /// Factors that convert a displacement of the record to metres, and a velocity over `omega0` to an impulse; `None`
    /// if neither mass nor stiffness is known.
    #[must_use]
    pub fn kicks(&self, omega0: f64) -> Option<(f64, f64)> {
        let (inertia, metres) = self.inertia()?;
        Some((metres, metres * inertia.times(omega0, 1)))
    }

    /// The units of time, length, velocity, force and impulse; the last two are NaN if neither mass nor
    /// stiffness is known. `None` without an estimated frequency or a known unit of length.
    #[must_use]
    pub fn units(&self) -> Option<Units> {
        let displacement = length_in_metres(self.unit()).filter(|_| self.estimate.free[OMEGA0])?;
        let omega_0 = self.estimate.p[OMEGA0];
        let mass = self.inertia().map_or(f64::NAN, |(inertia, _)| inertia.times(omega_0, 0));
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

/// An estimated number in SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EstimatedNumber {
    /// Its symbol.
    #[serde(skip)]
    pub name: &'static str,
    /// The place of the unknown that it follows from, beside the frequency.
    #[serde(skip)]
    pub unknown: Option<usize>,
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// A quantity as the mass times a factor, powers of `omega0` and of the unit of length, and one of the unknowns.
struct Law {
    name: &'static str,
    unit: &'static str,
    factor: f64,
    unknown: Option<usize>,
    omega0: i32,
    length: i32,
}

/// With `x = offset + q` and `tau = omega0 t`, the model multiplied by the stiffness is
/// `m x'' + d1 x' + d2 x'^2 + d3 x'^3 + c (x - offset) = friction within -R .. R`.
const LAWS: [Law; 6] = [
    Law { name: "m", unit: "kg", factor: 1.0, unknown: None, omega0: 0, length: 0 },
    Law { name: "c", unit: "N/m", factor: 1.0, unknown: None, omega0: 2, length: 0 },
    Law { name: "d1", unit: "N s/m", factor: 2.0, unknown: Some(D), omega0: 1, length: 0 },
    Law { name: "d2", unit: "N s^2/m^2", factor: 1.0, unknown: Some(D2), omega0: 0, length: -1 },
    Law { name: "d3", unit: "N s^3/m^3", factor: 1.0, unknown: Some(D3), omega0: -1, length: -2 },
    Law { name: "R", unit: "N", factor: 1.0, unknown: Some(R), omega0: 2, length: 1 },
];

/// The physical numbers with standard errors from the covariance of the fit; none if neither mass nor stiffness is
/// known.
pub fn rows(fitted: &Fitted) -> Vec<EstimatedNumber> {
    let Some((inertia, metres)) = fitted.inertia() else { return Vec::new() };
    LAWS.iter().map(|law| row(fitted, law, inertia, metres)).collect()
}

fn row(fitted: &Fitted, law: &Law, inertia: Inertia, metres: f64) -> EstimatedNumber {
    let estimate = &fitted.estimate;
    let omega0 = estimate.p[OMEGA0];
    let scale = law.factor * powi(metres, law.length);
    let constant = scale * inertia.times(omega0, law.omega0);
    let number = law.unknown.map_or(1.0, |unknown| estimate.p[unknown]);
    let power = f64::from(law.omega0 - inertia.power());
    let mut gradient = vec![(OMEGA0, constant * number * power / omega0)];
    gradient.extend(law.unknown.map(|unknown| (unknown, constant)));
    let standard_error = estimate.covariance.error_of(&gradient);
    let value = constant * number;
    EstimatedNumber { name: law.name, unknown: law.unknown, value, standard_error, unit: law.unit }
}

/// A combination of numbers that are not known separately.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// The numbers and their weights; the first weight is 1.
    pub terms: Vec<(&'static NameSpec, f64)>,
    /// Value of the weighted sum.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// The error of a term beyond which it is not known separately, as a fraction of the largest damping in the
/// record.
const UNKNOWN: f64 = 0.5;

/// The combinations to report; none if every number is known separately.
pub fn combinations(estimate: &Estimate) -> Vec<Combination> {
    let (low, high) = estimate.amplitudes();
    if !(low > 0.0 && high >= low) {
        return Vec::new();
    }
    let middle = (low * high).sqrt();
    // The damping due to one unit of each number.
    let scale = |place: usize| match place {
        D => Some(1.0),
        R => Some(2.0 / (PI * middle)),
        D3 => Some(0.375 * middle * middle),
        _ => None,
    };
    let p = &estimate.p;
    let damping = |a: f64| averaged(&parameters(p), a).abs();
    let largest = [low, middle, high].map(damping).into_iter().fold(0.0, f64::max);
    let unknown: Vec<(&NameSpec, f64)> = NAMES
        .iter()
        .filter(|row| estimate.free[row.place])
        .filter_map(|row| Some((row, scale(row.place)?)))
        .filter(|(row, scale)| estimate.covariance.error(row.place) * scale > UNKNOWN * largest)
        .collect();
    if unknown.len() < 2 {
        return Vec::new();
    }
    best_known(estimate, &unknown).into_iter().collect()
}

/// The combination with the smallest error: the principal direction of the information that remains when all other
/// unknowns are estimated as well.
fn best_known(estimate: &Estimate, unknown: &[(&'static NameSpec, f64)]) -> Option<Combination> {
    let size = unknown.len();
    let covariance = DMatrix::from_fn(size, size, |i, j| {
        let ((one, by), (other, and)) = (unknown[i], unknown[j]);
        estimate.covariance.of(one.place, other.place) * by * and
    });
    let information = covariance.try_inverse()?;
    let eigen = information.symmetric_eigen();
    let strongest = eigen.eigenvalues.imax();
    let direction: DVector<f64> = eigen.eigenvectors.column(strongest).into_owned();
    let weights: Vec<f64> =
        direction.iter().zip(unknown).map(|(weight, (_, scale))| weight * scale).collect();
    let terms: Vec<_> = unknown
        .iter()
        .zip(&weights)
        .map(|((row, _), weight)| (*row, weight / weights[0]))
        .collect();
    let value = terms.iter().map(|(row, weight)| weight * estimate.p[row.place]).sum();
    let weighted: Vec<_> = terms.iter().map(|(row, weight)| (row.place, *weight)).collect();
    Some(Combination { value, standard_error: estimate.covariance.error_of(&weighted), terms })
}
