//! The plotted points of a sampled record and of the fitted motion.

use super::dropped::{Dropped, dropped_of_fitted};
use super::estimate::Estimate;
use super::motion::{Way, follow};
use super::observation::{Data, LAST, OMEGA0, Q0, StartKind, parameters};
use crate::model::State;
use crate::numerics::count::real;

/// Maximum number of points plotted of a record. Of longer records every second, third, .. sample is plotted.
const POINTS: usize = 4000;

/// The plotted points of a sampled record, without outliers and jumps.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// Times in s; NaN in a gap.
    pub t: Vec<f64>,
    /// The signal.
    pub x: Vec<f64>,
    /// Differences from the fitted motion.
    pub residual: Vec<f64>,
    /// The fitted motion: time, displacement from the offset, velocity over omega0.
    pub motion: Vec<[f64; 3]>,
    /// The signal of the fitted motion at these times, with its offset.
    pub fitted: Vec<f64>,
}

impl Sampled {
    /// The plotted points of a fitted record; `None` for a record of peaks.
    pub fn of(estimate: &Estimate) -> Option<Self> {
        /// A step longer than the average one by this factor is a gap.
        const GAP: f64 = 6.0;
        let Data::Samples { t, x, .. } = &estimate.data else { return None };
        let every = t.len().div_ceil(POINTS);
        let (motion, fitted) = motion(estimate, t);
        let (measured, residual) = (Vec::new(), Vec::new());
        let mut seen = Sampled { t: Vec::new(), x: measured, residual, motion, fitted };
        let step = (t[t.len() - 1] - t[0]) * real(every) / real(t.len());
        for index in (0..t.len()).step_by(every) {
            if seen.t.last().is_some_and(|last| t[index] - last > GAP * step) {
                seen.push([f64::NAN; 3]);
            }
            let why = dropped_of_fitted(estimate, index);
            if !matches!(why, Some(Dropped::Outlier | Dropped::Jump)) {
                seen.push([t[index], x[index], estimate.residuals[index]]);
            }
        }
        Some(seen)
    }

    fn push(&mut self, [t, x, residual]: [f64; 3]) {
        self.t.push(t);
        self.x.push(x);
        self.residual.push(residual);
    }
}

/// The fitted motion at closely spaced times, and its signal.
fn motion(estimate: &Estimate, t: &[f64]) -> (Vec<[f64; 3]>, Vec<f64>) {
    /// Number of points for each half swing.
    const FINE: usize = 40;
    let p = &estimate.p;
    let (first, last) = (t[0], t[t.len() - 1]);
    let (origin, velocity) = match estimate.start {
        StartKind::Release => (p[LAST], 0.0),
        StartKind::Moving => (first, p[LAST]),
    };
    let count = (FINE * (estimate.half_swings + 2)).min(4 * POINTS);
    let at = |index: usize| origin + (last - origin) * real(index) / real(count);
    let taus: Vec<f64> = (0..=count).map(|index| p[OMEGA0] * (at(index) - origin)).collect();
    let signal = estimate.data.signal();
    let scale = (0..signal.order()).fold(1.0, |scale, _| scale * p[OMEGA0]);
    let (mut points, mut seen) = (Vec::new(), Vec::new());
    if first < origin {
        points.push([first, p[Q0], 0.0]);
        let held = if signal.is_displacement() { p[Q0] } else { 0.0 };
        seen.push(estimate.data.zero(p, first) + held);
    }
    let way =
        Way { linear: false, with_derivatives: false, reach: f64::MAX, turns: usize::MAX, signal };
    let start = State { q: p[Q0], v: velocity };
    // Cannot be lost: the fit has already followed this motion through the record.
    let _ = follow(&parameters(p), start, &taus, way, |index, point| {
        points.push([at(index), point.q, point.v]);
        seen.push(estimate.data.zero(p, at(index)) + scale * point.signal);
    });
    (points, seen)
}
