//! The whole result of a fit, with what the record itself does not contain, its unit and a mass or stiffness; the forces and
//! damping constants that follow from these; and the damping numbers that the data cannot separate.
//!
//! The damping of a motion at amplitude A is `D + 2 r/(pi A) + (3/8) D3 A^2`, and over a small range of
//! amplitudes the terms cannot be separated. If the errors of terms are of the order of the damping itself, the
//! combination of these terms that the data determine is reported instead.

use std::f64::consts::PI;

use nalgebra::DMatrix;
use serde::Serialize;

use super::{
    Curves, D, D2, D3, DropReason, Estimate, Extent, Inertia, LAST, MarginQuestion, Margins, NAMES,
    NameSpec, OFFSET, OMEGA0, PlotPoint, Q0, R, Record, Signal, StartKind, averaged,
    length_in_metres, parameters, rate, row_of,
};
use crate::flow::Problem;
use crate::model::{Knob, State, Units, dimension_of};
use crate::numerics::{powi, real};

/// The whole result of a fit.
#[derive(Clone, Debug)]
pub struct FitResult {
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
    /// All points of the record; none in a list of peaks without times.
    pub points: Vec<RecordPoint>,
    /// Those that are drawn as a line; `None` at each gap.
    pub line: Vec<Option<RecordPoint>>,
    /// Increase of chi-squared caused by the numbers held after the fit.
    pub rise: f64,
    /// Whether the distribution of the margin takes these numbers into account.
    pub drawn: bool,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// A point of the record, as measured and in the units of the oscillator: time in `1/omega0`, lengths in the record's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordPoint {
    /// Time in s.
    pub t: f64,
    /// The signal.
    pub x: f64,
    /// Measured minus computed; NaN where nothing is fitted.
    pub residual: f64,
    /// Dimensionless time since the release, or since the first sample.
    pub tau: f64,
    /// Displacement from the offset, as measured; of a velocity from the fit, of an acceleration NaN.
    pub q: f64,
    /// Velocity divided by omega0, from the fit, and 0 if the fit does not know it; as measured if it was, of an
    /// acceleration NaN.
    pub v: f64,
    /// Why it does not count in the fit; `None` if it does.
    pub dropped: Option<DropReason>,
}

impl RecordPoint {
    /// What was measured, if a time series can show it.
    #[must_use]
    pub fn shown(&self, signal: Signal) -> Option<f64> {
        match signal {
            Signal::Displacement => Some(self.q),
            Signal::Velocity => Some(self.v),
            Signal::Acceleration => None,
        }
    }
}

impl FitResult {
    /// A fit with its curves.
    #[must_use]
    pub fn new(name: String, record: Record, estimate: Estimate, margins: Margins) -> Self {
        let curves = Curves::of(&estimate, &margins);
        let points = points(&record, &estimate);
        let line = line_through(&points, &estimate.data);
        let (rise, drawn, seconds) = (0.0, true, 0.0);
        FitResult { name, record, estimate, margins, curves, points, line, rise, drawn, seconds }
    }

    /// The samples of the fitted motion as a line through the places that `of` reads, without outliers and jumps, and with a
    /// break (NaN) at each gap; of a long record every second, third, .. sample. None for a record of peaks.
    #[must_use]
    pub fn line(&self, of: impl Fn(&RecordPoint) -> PlotPoint) -> Vec<PlotPoint> {
        self.line.iter().map(|point| point.as_ref().map_or([f64::NAN; 2], &of)).collect()
    }

    /// The window in which the residuals are shown; `None` for a record of peaks.
    #[must_use]
    pub fn residual_extent(&self) -> Option<Extent> {
        let line = self.line(|it| [it.t, it.residual]);
        let sizes = line.iter().map(|[_, residual]| residual.abs());
        let far = 1.06 * sizes.fold(2.0 * self.estimate.covariance.deviation, f64::max);
        Some([line.first()?[0], line.last()?[0], -far, far])
    }

    /// The question about its margin with these half widths and a disturbance in the unit of r.
    #[must_use]
    pub fn disturbed(&self, disturbance: f64, half_widths: [f64; 4]) -> MarginQuestion {
        // In N where there is a mass.
        let force = self.units().map(|units| units.force).filter(|force| force.is_finite());
        let disturbance = disturbance * force.unwrap_or(1.0);
        MarginQuestion { disturbance, half_widths, ..self.margins.question }
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

    /// The unit of a number: the offset is one of the signal.
    #[must_use]
    pub fn unit_of(&self, row: &NameSpec) -> String {
        let length = row.unit(self.unit());
        if row.place == OFFSET {
            self.record.signal.unit(&length)
        } else {
            length
        }
    }

    /// The fitted motion; the method and whatever else the fit does not determine are those of `before`.
    pub fn problem(&self, before: Problem) -> Problem {
        let p = &self.estimate.p;
        let last = self.points.iter().rfind(|point| point.dropped.is_none());
        let last = last.map_or(before.until, |point| point.tau);
        Problem {
            parameters: parameters(p),
            initial: self.estimate.start.beginning(p, &[]).1,
            until: if last > 0.0 { last } else { before.until },
            ..before
        }
    }

    /// The place of a number of the oscillator among the unknowns of the fit.
    fn place(&self, symbol: Knob) -> Option<usize> {
        match symbol {
            Knob::Q0 => Some(Q0),
            Knob::V0 => (self.estimate.start == StartKind::Moving).then_some(LAST),
            _ => row_of(symbol).map(|row| row.place),
        }
    }

    /// Whether a number is held, by hand or by the choice with which the record was opened.
    #[must_use]
    pub fn holds(&self, symbol: Knob) -> bool {
        self.place(symbol).is_some_and(|place| !self.estimate.free[place])
    }

    /// Standard error of a number; `None` where it was not estimated.
    #[must_use]
    pub fn error(&self, symbol: Knob) -> Option<f64> {
        let place = self.place(symbol).filter(|place| self.estimate.free[*place])?;
        Some(self.estimate.covariance.error(place))
    }
}

/// The points that are drawn as a line, see [`FitResult::line`].
fn line_through(points: &[RecordPoint], data: &Record) -> Vec<Option<RecordPoint>> {
    /// Maximum number of samples.
    const MOST: usize = 4000;
    /// A step longer than the average one by this factor is a gap.
    const GAP: f64 = 6.0;
    if data.has_peaks() {
        return Vec::new();
    }
    let every = data.t.len().div_ceil(MOST);
    let gap = GAP * real(every) / rate(&data.t);
    let fitted = points.iter().filter(|it| !it.dropped.is_some_and(DropReason::is_outside));
    let (mut line, mut last) = (Vec::new(), f64::INFINITY);
    for point in fitted.step_by(every) {
        if matches!(point.dropped, Some(DropReason::Outlier | DropReason::Jump)) {
            continue;
        }
        if point.t - last > gap {
            line.push(None);
        }
        line.push(Some(*point));
        last = point.t;
    }
    line
}

/// The measured points, relative to the fitted motion.
fn points(record: &Record, estimate: &Estimate) -> Vec<RecordPoint> {
    let p = &estimate.p;
    let data = &estimate.data;
    let (origin, _) = estimate.start.beginning(p, &data.t);
    let mut fitted = estimate.states.iter().copied().zip(estimate.residuals.iter().copied());
    let all = record.t.iter().zip(&record.x).zip(&estimate.dropped);
    all.map(|((&t, &x), &dropped)| {
        let is_outside = dropped.is_some_and(DropReason::is_outside);
        let fitted = if is_outside { None } else { fitted.next() };
        let (State { q, v }, residual) = fitted.unwrap_or((State { q: 0.0, v: 0.0 }, f64::NAN));
        let seen = x - data.zero(p, t);
        // What is measured is seen, the rest of the state is that of the fit; of an acceleration nothing is seen.
        let (q, v) = match data.signal {
            Signal::Displacement => (seen, v),
            Signal::Velocity => (q, seen / p[OMEGA0]),
            Signal::Acceleration => (f64::NAN, f64::NAN),
        };
        RecordPoint { t, x, residual, tau: p[OMEGA0] * (t - origin), q, v, dropped }
    })
    .collect()
}

/// An estimated number in SI units.
#[derive(Clone, Debug, Serialize)]
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

/// A quantity as the mass times a factor, powers of `omega0` and of the unit of length that its unit tells, and one of the
/// unknowns.
struct Law {
    name: &'static str,
    unit: &'static str,
    factor: f64,
    unknown: Option<usize>,
}

/// With `x = offset + q` and `tau = omega0 t`, the model multiplied by the stiffness is
/// `m x'' + d1 x' + d2 x'^2 + d3 x'^3 + c (x - offset) = friction within -R .. R`.
const LAWS: [Law; 6] = [
    Law { name: "m", unit: "kg", factor: 1.0, unknown: None },
    Law { name: "c", unit: "N/m", factor: 1.0, unknown: None },
    Law { name: "d1", unit: "N s/m", factor: 2.0, unknown: Some(D) },
    Law { name: "d2", unit: "N s^2/m^2", factor: 1.0, unknown: Some(D2) },
    Law { name: "d3", unit: "N s^3/m^3", factor: 1.0, unknown: Some(D3) },
    Law { name: "R", unit: "N", factor: 1.0, unknown: Some(R) },
];

/// The physical numbers with standard errors from the covariance of the fit; none if neither mass nor stiffness is
/// known.
pub fn rows(fitted: &FitResult) -> Vec<EstimatedNumber> {
    let Some((inertia, metres)) = fitted.inertia() else { return Vec::new() };
    let Estimate { p, covariance, .. } = &fitted.estimate;
    let row = |Law { name, unit, factor, unknown }| {
        let [_, length, time] = dimension_of(unit).map(i32::from);
        let constant = factor * powi(metres, length) * inertia.times(p[OMEGA0], -time);
        let value = constant * unknown.map_or(1.0, |unknown| p[unknown]);
        let power = f64::from(-time - inertia.power());
        let mut gradient = vec![(OMEGA0, value * power / p[OMEGA0])];
        gradient.extend(unknown.map(|unknown| (unknown, constant)));
        let standard_error = covariance.error_of(&gradient);
        EstimatedNumber { name, unknown, value, standard_error, unit }
    };
    LAWS.map(row).to_vec()
}

/// A combination of numbers that are not known separately.
#[derive(Clone, Debug)]
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

/// The combination to report; `None` if every number is known separately.
pub fn combination(estimate: &Estimate) -> Option<Combination> {
    let (low, high) = estimate.amplitudes();
    if !(low > 0.0 && high >= low) {
        return None;
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
        .filter_map(|row| Some((row, scale(row.place)?)))
        .filter(|(row, scale)| estimate.covariance.error(row.place) * scale > UNKNOWN * largest)
        .collect();
    if unknown.len() < 2 {
        None
    } else {
        best_known(estimate, &unknown)
    }
}

/// The combination with the smallest error: the principal direction of the information that remains when all other
/// unknowns are estimated as well.
fn best_known(estimate: &Estimate, unknown: &[(&'static NameSpec, f64)]) -> Option<Combination> {
    let size = unknown.len();
    let covariance = DMatrix::from_fn(size, size, |i, j| {
        let ((one, by), (other, and)) = (unknown[i], unknown[j]);
        estimate.covariance.of(one.place, other.place) * by * and
    });
    let information = covariance.lu().try_inverse()?;
    let eigen = information.symmetric_eigen();
    let strongest = eigen.eigenvalues.imax();
    let direction = eigen.eigenvectors.column(strongest);
    let weight = |index: usize| direction[index] * unknown[index].1;
    let rows = unknown.iter().enumerate();
    let terms: Vec<_> = rows.map(|(index, row)| (row.0, weight(index) / weight(0))).collect();
    let value = terms.iter().map(|(row, weight)| weight * estimate.p[row.place]).sum();
    let weighted: Vec<_> = terms.iter().map(|(row, weight)| (row.place, *weight)).collect();
    Some(Combination { value, standard_error: estimate.covariance.error_of(&weighted), terms })
}
