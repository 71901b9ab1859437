//! The covariance of the unknowns, also for correlated noise.

use nalgebra::{DMatrix, DVector};

use super::levenberg_marquardt::{Optimum, Task};
use super::noise::IMPOSSIBLE;
use super::observation::{Data, Residual, UNKNOWNS, Unknowns};
use crate::numerics::count::real;
use crate::numerics::elementary::{cos, pow, powi, sin};

/// The covariance of the free unknowns about a minimum.
#[derive(Clone, Debug)]
pub struct Covariance {
    /// The free unknowns.
    pub columns: Vec<usize>,
    /// Their covariance for the noise of the record.
    pub matrix: DMatrix<f64>,
    /// Their covariance for white noise of the same size: the inverse curvature of the loss.
    pub white: DMatrix<f64>,
    /// Standard deviation of the noise.
    pub deviation: f64,
    /// Its variance as it acts on the unknowns: a unit of chi-squared.
    pub variance: f64,
    /// Degrees of freedom: the number of residuals minus the noise absorbed by the unknowns.
    pub freedom: f64,
    /// The noise absorbed by the unknowns, in residuals.
    absorbed: f64,
    /// For each column, the degrees of freedom of its variance if all residuals are independent.
    freedoms: Vec<f64>,
}

impl Covariance {
    /// The covariance at a minimum, for noise with these autocorrelations (none: white).
    ///
    /// With correlated noise `cov(J'e) = s^2 sum_l rho_l J_t' J_(t+l)`, which is multiplied by the inverse of
    /// `J'J` from both sides. `None` if an unknown has no influence at all.
    pub fn at(task: &Task, optimum: &Optimum, autocorrelation: &[f64]) -> Option<Self> {
        let columns = task.columns();
        let width = columns.len();
        let factor = task.factor(&optimum.seen, &columns);
        let upper = factor.view((0, 0), (width, width)).into_owned();
        let inverse = upper.solve_upper_triangular(&DMatrix::identity(width, width))?;
        let bread = &inverse * inverse.transpose();
        let used = task.used_residuals(&optimum.seen);
        let rows: Vec<Vec<f64>> = used
            .iter()
            .map(|it| {
                let root = task.loss.weight(it.value).sqrt();
                columns.iter().map(|&column| root * it.by[column]).collect()
            })
            .collect();
        let spread = if autocorrelation.is_empty() {
            bread.clone()
        } else {
            &bread * correlated(&rows, autocorrelation, width) * &bread
        };
        // Each unknown absorbs the noise along its gradient, which for white noise is that of one residual.
        let absorbed = if autocorrelation.is_empty() {
            real(width)
        } else {
            (&upper * &spread * upper.transpose()).trace()
        };
        let freedom = real(used.len()) - absorbed;
        if freedom < 1.0 || !spread.iter().all(|value| value.is_finite()) {
            return None;
        }
        // For a robust loss the influence of a residual is its weight times its value.
        let weighted = used.iter().map(|it| (task.loss.weight(it.value), it.value));
        let (sum, influence) = weighted.fold((0.0, 0.0), |(sum, influence), (weight, value)| {
            (sum + weight * value * value, influence + powi(weight * value, 2))
        });
        let variance = influence / freedom * powi(widening(task, optimum, influence / freedom), 2);
        let freedoms = match &task.observation.data {
            Data::Peaks { t: Some(_), x, .. } => of_two_kinds(&rows, x.len(), &bread),
            _ => vec![freedom; width],
        };
        Some(Covariance {
            columns,
            matrix: spread * variance,
            white: bread * variance,
            deviation: (sum / freedom).sqrt(),
            variance,
            freedom,
            absorbed,
            freedoms,
        })
    }

    /// Whether noise can have the autocorrelations: then all variances are positive, and the unknowns absorb
    /// some of the noise.
    pub fn is_possible(&self) -> bool {
        self.absorbed > 0.0 && self.matrix.diagonal().iter().all(|variance| *variance > 0.0)
    }

    fn place(&self, unknown: usize) -> Option<usize> {
        self.columns.iter().position(|&column| column == unknown)
    }

    /// Covariance of two unknowns; 0 if one is held.
    pub fn of(&self, one: usize, other: usize) -> f64 {
        match (self.place(one), self.place(other)) {
            (Some(one), Some(other)) => self.matrix[(one, other)],
            _ => 0.0,
        }
    }

    /// Standard error of an unknown; 0 if it is held.
    pub fn error(&self, unknown: usize) -> f64 {
        self.of(unknown, unknown).max(0.0).sqrt()
    }

    /// Correlation of two free unknowns.
    pub fn correlation(&self, one: usize, other: usize) -> f64 {
        self.of(one, other) / (self.error(one) * self.error(other))
    }

    /// The ratio of the variance of an unknown to that with white noise of the same size.
    pub fn inflation(&self, unknown: usize) -> f64 {
        self.place(unknown).map_or(1.0, |at| self.matrix[(at, at)] / self.white[(at, at)])
    }

    /// The number of independent residuals that would determine the variance of an unknown as well
    /// (Satterthwaite).
    ///
    /// For correlated noise the correlation is estimated, too. A first-order autoregression inflates the
    /// variance of unknowns with slowly varying gradients by `I = (1 + rho)/(1 - rho)`; the relative variance
    /// of this variance is `2 (1 + 2 I)/n`.
    pub fn independent(&self, unknown: usize) -> f64 {
        let inflation = self.inflation(unknown);
        let repeated = if inflation == 1.0 { 1.0 } else { 1.0 + 2.0 * inflation.max(1.0) };
        self.place(unknown).map_or(self.freedom, |at| self.freedoms[at]) / repeated
    }

    /// The changes of all unknowns for a unit change of one of them, with the loss kept as small as possible.
    pub fn along(&self, unknown: usize) -> Unknowns {
        let mut along = [0.0; UNKNOWNS];
        if let Some(at) = self.place(unknown) {
            for (place, &column) in self.columns.iter().enumerate() {
                along[column] = self.white[(place, at)] / self.white[(at, at)];
            }
        }
        along
    }
}

/// The factor of all errors that is due to samples left out because they do not belong to the motion. If the noise reaches
/// beyond the limit, a small change of the motion puts some samples out and others in, so that those that count see only
/// a part of it. That part follows from the density of residuals at the limit, here from their number up to twice the
/// limit: with Student's distribution of three degrees of freedom it falls with the fourth power.
fn widening(task: &Task, optimum: &Optimum, variance: f64) -> f64 {
    /// The density of magnitudes at the limit times the limit, by their share between the limit and its double.
    const AT_LIMIT: f64 = 3.0 / (1.0 - 0.125);
    /// Largest share of the residuals that may be lost in this way.
    const MOST: f64 = 0.3;
    let limit = IMPOSSIBLE * variance.sqrt();
    let out = optimum.seen.residuals.iter().zip(task.used).filter(|(_, used)| !**used);
    let near = out.filter(|(it, _)| (limit..2.0 * limit).contains(&it.value.abs())).count();
    let share = real(near) / real(optimum.seen.residuals.len());
    1.0 / (1.0 - (AT_LIMIT * share).min(MOST))
}

/// The degrees of freedom of each unknown's variance if the first `count` residuals and the others are of two kinds,
/// displacements and times of peaks, the errors of which are estimated separately (Welch and Satterthwaite).
fn of_two_kinds(rows: &[Vec<f64>], count: usize, bread: &DMatrix<f64>) -> Vec<f64> {
    let width = bread.nrows();
    // For each kind: its degrees of freedom, and the variance of each unknown that is due to it.
    let mut kinds = [(0.0, vec![0.0; width]), (0.0, vec![0.0; width])];
    for (index, row) in rows.iter().enumerate() {
        let (freedom, variances) = &mut kinds[usize::from(index >= count)];
        let row = DVector::from_column_slice(row);
        let influence = bread * &row;
        *freedom += 1.0 - influence.dot(&row);
        for (variance, influence) in variances.iter_mut().zip(influence.iter()) {
            *variance += influence * influence;
        }
    }
    let of = |unknown: usize| {
        let parts = kinds.iter().map(|(freedom, variances)| (freedom, variances[unknown]));
        let (sum, spread) = parts.fold((0.0, 0.0), |(sum, spread), (freedom, variance)| {
            (sum + variance, spread + variance * variance / freedom.max(f64::MIN_POSITIVE))
        });
        sum * sum / spread
    };
    (0..width).map(of).collect()
}

/// The sum of the outer products of all pairs of rows, weighted by their correlation.
fn correlated(rows: &[Vec<f64>], autocorrelation: &[f64], width: usize) -> DMatrix<f64> {
    let mut meat = DMatrix::<f64>::zeros(width, width);
    for (row, ahead) in rows.iter().zip(blurred(rows, autocorrelation)) {
        for (i, one) in row.iter().enumerate() {
            for (j, other) in ahead.iter().enumerate() {
                meat[(i, j)] += one * other;
            }
        }
    }
    &meat + meat.transpose()
}

/// For each row, half of it plus all later rows, weighted by their correlation with it.
fn blurred(rows: &[Vec<f64>], autocorrelation: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    rows.iter().enumerate().map(|(index, row)| {
        let mut ahead: Vec<f64> = row.iter().map(|value| 0.5 * value).collect();
        for (rho, later) in autocorrelation.iter().zip(&rows[index + 1..]) {
            for (ahead, value) in ahead.iter_mut().zip(later) {
                *ahead += rho * value;
            }
        }
        ahead
    })
}

/// The mean autocorrelations at lags 1, 2, .. of the residuals of a fit to noise with these autocorrelations.
/// The unknowns absorb the projection `H = Q Q'` of the noise, so the residuals have the covariance
/// `(1 - H) S (1 - H)`.
pub fn left_over(task: &Task, optimum: &Optimum, noise: &[f64], lags: usize) -> Vec<f64> {
    let columns = task.columns();
    let width = columns.len();
    let factor = task.factor(&optimum.seen, &columns);
    let upper = factor.view((0, 0), (width, width)).transpose();
    let used = task.used_residuals(&optimum.seen);
    let row = |it: &&Residual| {
        let root = task.loss.weight(it.value).sqrt();
        let row = DVector::from_iterator(width, columns.iter().map(|&c| root * it.by[c]));
        upper.solve_lower_triangular(&row).map(|row| row.data.into())
    };
    let Some(q) = used.iter().map(row).collect::<Option<Vec<Vec<f64>>>>() else {
        return vec![0.0; lags];
    };
    let forward: Vec<Vec<f64>> = blurred(&q, noise).collect();
    let backward: Vec<Vec<f64>> = {
        let reversed: Vec<Vec<f64>> = q.iter().rev().cloned().collect();
        let mut blurred: Vec<Vec<f64>> = blurred(&reversed, noise).collect();
        blurred.reverse();
        blurred
    };
    // S Q and Q' S Q.
    let add = |(one, other): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        one.iter().zip(other).map(|(one, other)| one + other).collect()
    };
    let sq: Vec<Vec<f64>> = forward.iter().zip(&backward).map(add).collect();
    let mut qsq = DMatrix::<f64>::zeros(width, width);
    for (one, other) in q.iter().zip(&sq) {
        for i in 0..width {
            for j in 0..width {
                qsq[(i, j)] += one[i] * other[j];
            }
        }
    }
    let dot = |one: &[f64], other: &[f64]| -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    };
    let at = |lag: usize| -> f64 {
        let rho = if lag == 0 { 1.0 } else { noise.get(lag - 1).copied().unwrap_or(0.0) };
        let mut sum = rho * real(q.len() - lag);
        for (t, later) in q.iter().skip(lag).enumerate() {
            let both: f64 =
                (0..width).map(|j| later[j] * dot(&q[t], qsq.column(j).as_slice())).sum();
            sum += both - dot(&sq[t], later) - dot(&q[t], &sq[t + lag]);
        }
        sum
    };
    let power = at(0);
    (1..=lags).map(|lag| at(lag) / power).collect()
}

/// The value that a chi-squared variable exceeds with the same probability as a normal one exceeds `z` (Wilson and
/// Hilferty).
pub fn chi_squared(freedom: f64, z: f64) -> f64 {
    let part = 2.0 / (9.0 * freedom);
    freedom * powi(1.0 - part + z * part.sqrt(), 3)
}

/// The deviation within which a variable with Student's distribution lies with a probability of 95 %: for few degrees
/// of freedom `n` by the integral of `cos^(n-1)` over the angle whose tangent is the deviation over `sqrt(n)`, else by
/// the expansion about the normal distribution in `1/n` (error below 1e-5).
pub fn deviation_of_95_percent(freedom: f64) -> f64 {
    const FEW: f64 = 12.0;
    const PANELS: u32 = 4000;
    let n = freedom.max(1.0);
    if n < FEW {
        let width = std::f64::consts::FRAC_PI_2 / f64::from(PANELS);
        let angle = |panel: u32| width * (f64::from(panel) + 0.5);
        let density: Vec<f64> = (0..PANELS).map(|panel| pow(cos(angle(panel)), n - 1.0)).collect();
        let mut left = 0.95 * density.iter().sum::<f64>();
        let mut reached = 0.0;
        for part in density {
            reached += width * (left / part).min(1.0);
            left -= part;
            if left <= 0.0 {
                break;
            }
        }
        return n.sqrt() * sin(reached) / cos(reached);
    }
    let z: f64 = 1.959_963_984_540_054;
    let (z3, z5, z7) = (powi(z, 3), powi(z, 5), powi(z, 7));
    z + (z3 + z) / (4.0 * n)
        + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        + (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_quantiles_are_those_of_tables() {
        for (freedom, value) in [
            (1.0, 12.706),
            (2.0, 4.303),
            (3.0, 3.182),
            (5.0, 2.571),
            (10.0, 2.228),
            (11.9, 2.181),
            (12.0, 2.179),
            (30.0, 2.042),
            (1e9, 1.960),
        ] {
            let found = deviation_of_95_percent(freedom);
            assert!((found / value - 1.0).abs() < 1e-3, "{freedom}: {found}");
        }
    }
}
