//! A drift of the zero as an alternative to the model: a line and a parabola over the record.

use nalgebra::DVector;

use super::levenberg_marquardt::{Optimum, Task};
use super::observation::Data;
use super::residuals::autocorrelations;
use super::triangle::triangle;
use crate::numerics::count::real;
use crate::numerics::elementary::powi;

/// A drift that a record shows beside the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// By how much chi-squared falls if the zero may drift along a parabola; for noise with memory divided by the factor
    /// by which that raises chance.
    pub evidence: f64,
    /// The change of the zero from the beginning to the end of the record.
    pub change: f64,
}

impl Drift {
    /// Whether the drift is real. Chance exceeds this fall of chi-squared for two more unknowns three times in ten
    /// thousand.
    pub fn is_seen(&self) -> bool {
        const RARE: f64 = 16.0;
        self.evidence > RARE
    }

    /// The drift by the linear model about a minimum; none for peaks.
    pub fn of(task: &Task, optimum: &Optimum) -> Self {
        let Data::Samples { t, .. } = &task.observation.data else { return Drift::default() };
        let columns = task.columns();
        let width = columns.len() + 3;
        let counts = |index: usize| task.used.get(index).copied().unwrap_or(true);
        let row = |index: usize, row: &mut [f64]| {
            row.fill(0.0);
            if !counts(index) {
                return;
            }
            let residual = &optimum.seen.residuals[index];
            for (cell, &column) in row.iter_mut().zip(&columns) {
                *cell = residual.by[column];
            }
            let part = (t[index] - t[0]) / (t[t.len() - 1] - t[0]) - 0.5;
            (row[width - 3], row[width - 2]) = (part, part * part);
            row[width - 1] = residual.value;
        };
        let factor = triangle(width, t.len(), row);
        let upper = factor.view((0, 0), (width - 1, width - 1));
        let right = factor.view((0, width - 1), (width - 1, 1));
        let Some(solution) = upper.solve_upper_triangular(&right.into_owned()) else {
            return Drift::default();
        };
        let mut cells = vec![0.0; width];
        let solution = DVector::from_column_slice(solution.as_slice());
        let left: Vec<f64> = (0..t.len())
            .filter(|index| counts(*index))
            .map(|index| {
                row(index, &mut cells);
                cells[width - 1] - DVector::from_column_slice(&cells[..width - 1]).dot(&solution)
            })
            .collect();
        let freedom = (real(left.len()) - real(width) + 1.0).max(1.0);
        let variance = left.iter().map(|it| it * it).sum::<f64>() / freedom;
        let memory = autocorrelations(&left, &[1])[0].clamp(0.0, 0.99);
        let fall: f64 =
            [width - 3, width - 2].map(|it| powi(factor[(it, width - 1)], 2)).iter().sum();
        Drift {
            evidence: fall / variance * (1.0 - memory) / (1.0 + memory),
            change: solution[width - 3],
        }
    }
}
