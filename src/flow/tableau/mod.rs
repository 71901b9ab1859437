//! Coefficients of the methods, one file for each but the shortest.
//!
//! [`Scheme`] is the form in which the explicit steppers read theirs.

pub mod dop853;
pub mod dopri5;
pub mod radau;

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
    /// From the coefficients as published: the triangle of the weights of the slopes in each stage from the second on, row
    /// by row; the weights in the solution; and those in the error estimates. A last stage that is missing lies at the end
    /// of the step.
    const fn new(
        stages: &[f64],
        weights: [f64; S],
        errors: &[&[f64; S]],
        estimate: ErrorEstimate,
    ) -> Self {
        let mut columns = [[0.0; R]; S];
        let mut next = 0;
        let mut i = 0;
        while i < S {
            let mut j = 0;
            while j <= i && next < stages.len() {
                columns[j][i] = stages[next];
                next += 1;
                j += 1;
            }
            columns[i][S - 1] = weights[i];
            let mut e = 0;
            while e < errors.len() {
                columns[i][S + e] = errors[e][i];
                e += 1;
            }
            i += 1;
        }
        let last_is_end = stages.len() < S * (S - 1) / 2;
        if last_is_end {
            let mut j = 0;
            while j < S {
                columns[j][S - 2] = weights[j];
                j += 1;
            }
        }
        Scheme { columns, weights, estimate, last_is_end }
    }
}

/// The classical method of order 4 (Kutta 1901), for steps of fixed length.
pub static CLASSICAL: Scheme<4, 4> = Scheme::new(
    &[0.5, 0.0, 0.5, 0.0, 0.0, 1.0],
    [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    &[],
    ErrorEstimate::None,
);

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
        is_consistent(&dop853::SCHEME);
        is_consistent(&dopri5::SCHEME);
        is_consistent(&CLASSICAL);
    }
}
