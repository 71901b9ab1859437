//! Coefficients of the methods, which stand as published in `assets/tableaux.txt`.
//!
//! [`Scheme`] is the form in which the explicit steppers read theirs, [`radau`] has those of the implicit one.

pub mod radau;

pub(crate) use radau::*;

use std::sync::LazyLock;

use crate::numerics::cells;

/// The classical method of order 4 (Kutta 1901), for steps of fixed length.
pub static CLASSICAL: LazyLock<Scheme<4, 4>> =
    LazyLock::new(|| Scheme::read("rk4", ErrorEstimate::None));

/// Order 5 with an error estimate of order 4 (Dormand and Prince 1980).
pub static DOPRI5: LazyLock<Scheme<7, 8>> =
    LazyLock::new(|| Scheme::read("dopri5", ErrorEstimate::Embedded(5.0)));

/// Order 8 with error estimates of order 5 and 3 (Hairer, Norsett and Wanner 1993).
pub static DOP853: LazyLock<Scheme<12, 16>> =
    LazyLock::new(|| Scheme::read("dop853", ErrorEstimate::Combined(8.0)));

/// The rows of numbers of a scheme.
fn rows(scheme: &str) -> impl Iterator<Item = Vec<f64>> {
    let lines = include_str!("../../../assets/tableaux.txt").lines().filter_map(cells);
    let own = lines.filter(move |[name, _]| *name == scheme);
    own.map(|[_, numbers]| numbers.split(' ').map(number).collect())
}

/// A number, or a fraction.
fn number(text: &str) -> f64 {
    let parsed = |text: &str| text.parse().unwrap_or(f64::NAN);
    let fraction = text.split_once('/');
    fraction.map_or_else(|| parsed(text), |(over, under)| parsed(over) / parsed(under))
}

/// An explicit Runge-Kutta scheme of S stages as a stepper reads it: by slopes, not by stages.
///
/// As soon as a slope is known it is added, with its weights, to all sums that need it. Unlike the additions
/// within one stage, these do not depend on each other.
#[derive(Debug)]
pub struct Scheme<const S: usize, const R: usize> {
    /// `columns[j][i]` is the weight of slope `j` in sum `i`. Sums `0 .. S - 1` belong to stages `1 .. S` and
    /// sum `S - 1` to the solution. The error estimates follow, and zeros fill the rest.
    pub columns: [[f64; R]; S],
    /// Weights of the solution.
    pub weights: [f64; S],
    /// How the error of a step is estimated.
    pub estimate: ErrorEstimate,
    /// Whether the last stage is evaluated at the end of the step, where the next one begins.
    pub last_is_end: bool,
}

/// How the error of a step is estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorEstimate {
    /// Not at all: the step has a fixed length.
    None,
    /// By an embedded solution; the error grows with this power of the step.
    Embedded(f64),
    /// By two embedded solutions of order 5 and 3; the combined error grows with this power.
    Combined(f64),
}

impl<const S: usize, const R: usize> Scheme<S, R> {
    /// From the coefficients as published, a row for each sum.
    fn read(name: &str, estimate: ErrorEstimate) -> Self {
        let mut columns = [[0.0; R]; S];
        for (sum, row) in rows(name).enumerate() {
            for (column, weight) in columns.iter_mut().zip(row) {
                column[sum] = weight;
            }
        }
        let weights = columns.map(|column| column[S - 1]);
        let last_is_end = columns.iter().all(|column| column[S - 2] == column[S - 1]);
        Scheme { columns, weights, estimate, last_is_end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::powi;

    fn is_consistent<const S: usize, const R: usize>(scheme: &Scheme<S, R>) {
        assert!((scheme.weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        for error in S..R {
            let sum: f64 = scheme.columns.iter().map(|column| column[error]).sum();
            assert!(sum.abs() < 1e-15, "error estimate {error} of a constant: {sum:e}");
        }
        // The quadrature condition of order 3: the stages lie where their weights assume them.
        let nodes = |i: usize| scheme.columns.iter().map(|column| column[i]).sum::<f64>();
        for (power, integral) in [(1, 1.0 / 2.0), (2, 1.0 / 3.0), (3, 1.0 / 4.0)] {
            let sum: f64 = (1..S).map(|i| scheme.weights[i] * powi(nodes(i - 1), power)).sum();
            assert!((sum - integral).abs() < 1e-14, "{S} stages, degree {power}: {sum}");
        }
    }

    #[test]
    fn schemes_are_consistent() {
        is_consistent(&DOP853);
        is_consistent(&DOPRI5);
        is_consistent(&CLASSICAL);
    }
}
