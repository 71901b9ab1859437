//! A drift of the zero beside the motion, along a line or a parabola over the record.

use serde::Serialize;

use super::decrements::robust;
use super::levenberg_marquardt::{Optimum, Task};
use super::names::NAMES;
use super::observation::{BEND, SLOPE, UNKNOWNS, Unknowns, drift};
use super::residuals::autocorrelations;
use super::turning_points::Extreme;
use super::uncertainty::Covariance;
use crate::numerics::count::real;
use crate::numerics::elementary::powi;

/// A drift that a fit leaves over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeftDrift {
    /// By how much chi-squared falls if the zero may drift along a parabola; for noise with memory divided by the factor
    /// by which that raises chance.
    pub evidence: f64,
    /// The change of the zero from the beginning to the end of the record.
    pub change: f64,
    /// The distance by which it would move an estimated number, in standard errors of that number without a drift; the
    /// largest of all.
    pub moved: f64,
}

/// A drift that is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FittedDrift {
    /// The change of the zero from the beginning to the end of the record.
    pub change: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// How far its ends lie above its middle; 0 along a line.
    pub bend: f64,
    /// The standard error of that.
    pub bend_standard_error: f64,
}

/// Chance exceeds this fall of chi-squared for two more unknowns three times in ten thousand.
const RARE: f64 = 16.0;

impl LeftDrift {
    /// Whether the drift is real.
    pub fn is_seen(&self) -> bool {
        self.evidence > RARE
    }

    /// The drift by the linear model about a minimum, with the step of all unknowns to it; none for peaks.
    pub fn with_step(task: &Task, optimum: &Optimum) -> Option<(Self, Unknowns)> {
        let mut columns = task.columns();
        if task.observation.data.has_peaks() || columns.contains(&SLOPE) {
            return None;
        }
        let free = columns.len();
        columns.extend([SLOPE, BEND]);
        let width = columns.len();
        let factor = task.factor(&optimum.seen, &columns);
        let upper = factor.view((0, 0), (width, width));
        let right = factor.view((0, width), (width, 1)).into_owned();
        let solution = upper.solve_upper_triangular(&right)?;
        let mut step = [0.0; UNKNOWNS];
        for (&column, value) in columns.iter().zip(solution.iter()) {
            step[column] = *value;
        }
        let used = task.used_residuals(&optimum.seen);
        let told = |by: &Unknowns| by.iter().zip(&step).map(|(by, step)| by * step).sum::<f64>();
        let left: Vec<f64> = used.iter().map(|it| it.value - told(&it.by)).collect();
        let variance = powi(factor[(width, width)], 2) / (real(left.len()) - real(width)).max(1.0);
        let fall = powi(factor[(free, width)], 2) + powi(factor[(free + 1, width)], 2);
        let evidence = fall / variance * independent(&left);
        Some((LeftDrift { evidence, change: step[SLOPE], moved: 0.0 }, step))
    }

    /// The drift by the linear model about a minimum with this covariance; none for peaks, or if it is fitted.
    pub fn of(task: &Task, optimum: &Optimum, covariance: &Covariance) -> Self {
        let Some((drift, step)) = LeftDrift::with_step(task, optimum) else {
            return LeftDrift::default();
        };
        let named = NAMES.iter().map(|row| row.place).filter(|place| task.free[*place]);
        let moved = named.map(|place| step[place].abs() / covariance.error(place));
        LeftDrift { moved: moved.fold(0.0, f64::max), ..drift }
    }
}

/// The share of residuals that are independent, by the memory between neighbours.
pub fn independent(residuals: &[f64]) -> f64 {
    let memory = autocorrelations(residuals, &[1])[0].clamp(0.0, 0.99);
    (1.0 - memory) / (1.0 + memory)
}

/// The slope and the bend of the middles of the swings; zero for fewer than three.
pub fn of_swings(t: &[f64], extremes: &[Extreme]) -> [f64; 2] {
    /// Fewest middles that show a parabola.
    const FEWEST: usize = 6;
    let rows: Vec<(Vec<f64>, f64)> = extremes
        .windows(3)
        .map(|three| {
            let [slope, bend] = drift(t, three[1].t);
            let middle = 0.25 * (three[0].x + 2.0 * three[1].x + three[2].x);
            (vec![1.0, slope, bend], middle)
        })
        .collect();
    let width = if rows.len() < FEWEST { 2 } else { 3 };
    let rows: Vec<_> = rows.iter().map(|(row, middle)| (row[..width].to_vec(), *middle)).collect();
    let found = Some(rows).filter(|rows| rows.len() > 2).and_then(|rows| robust(&rows));
    found.map_or([0.0; 2], |it| [it[1], it.get(2).copied().unwrap_or(0.0)])
}

/// Takes a drift off a record.
pub fn without(t: &[f64], x: &[f64], [slope, bend]: [f64; 2]) -> Vec<f64> {
    let at = |time: f64| {
        let [by_slope, by_bend] = drift(t, time);
        slope * by_slope + bend * by_bend
    };
    t.iter().zip(x).map(|(&t, x)| x - at(t)).collect()
}
