//! Gaussian elimination that can be stopped: some hundred harmonics take it tens of milliseconds, longer
//! than a superseded computation may go on.

use nalgebra::{DMatrix, DVector};

/// A square matrix decomposed with partial pivoting.
pub struct Elimination {
    /// The upper factor, and below the diagonal the lower one.
    factors: DMatrix<f64>,
    /// The row that was exchanged with each row in turn.
    exchanged: Vec<usize>,
}

impl Elimination {
    /// Decomposes a square matrix; `None` when interrupted, which is asked for at each column.
    #[must_use]
    pub fn of(mut matrix: DMatrix<f64>, interrupted: &dyn Fn() -> bool) -> Option<Self> {
        let size = matrix.nrows();
        let mut exchanged = Vec::with_capacity(size);
        for column in 0..size {
            if interrupted() {
                return None;
            }
            let pivot = column + matrix.column(column).rows_range(column..).iamax();
            matrix.swap_rows(column, pivot);
            exchanged.push(pivot);
            let (known, rest) = matrix.as_mut_slice().split_at_mut((column + 1) * size);
            let (above, below) = known[column * size..].split_at_mut(column + 1);
            let pivot = above[column];
            for factor in &mut *below {
                *factor /= pivot;
            }
            for other in rest.chunks_exact_mut(size) {
                let (head, tail) = other.split_at_mut(column + 1);
                for (value, factor) in tail.iter_mut().zip(&*below) {
                    *value -= factor * head[column];
                }
            }
        }
        Some(Elimination { factors: matrix, exchanged })
    }

    /// The solution for this right-hand side; not finite where the matrix is singular.
    #[must_use]
    pub fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        let mut solution = right.clone();
        let size = solution.len();
        for (row, &other) in self.exchanged.iter().enumerate() {
            solution.swap_rows(row, other);
        }
        for column in 0..size {
            let value = solution[column];
            for row in column + 1..size {
                solution[row] -= self.factors[(row, column)] * value;
            }
        }
        for column in (0..size).rev() {
            let value = solution[column] / self.factors[(column, column)];
            solution[column] = value;
            for row in 0..column {
                solution[row] -= self.factors[(row, column)] * value;
            }
        }
        solution
    }

    /// Whether the determinant is positive; its size may well overflow.
    #[must_use]
    pub fn is_positive(&self) -> bool {
        let exchanges = self.exchanged.iter().enumerate().filter(|(row, other)| row != *other);
        let negative = self.factors.diagonal().iter().filter(|pivot| **pivot < 0.0).count();
        (exchanges.count() + negative).is_multiple_of(2)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    fn matrix(size: usize) -> DMatrix<f64> {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        DMatrix::from_fn(size, size, |row, column| (((1 + row) * (2 + 3 * column)) as f64).sin())
    }

    #[test]
    fn it_solves_what_it_decomposed_and_knows_the_sign_of_the_determinant() {
        for size in [1, 2, 5, 31] {
            let whole = Elimination::of(matrix(size), &|| false).unwrap();
            let expected = DVector::from_fn(size, |row, _| if row % 2 == 0 { 1.0 } else { -0.3 });
            let error = (whole.solve(&(matrix(size) * &expected)) - &expected).amax();
            assert!(error < 1e-10, "{size}: {error:e}");
            assert_eq!(whole.is_positive(), matrix(size).determinant() > 0.0, "{size}");
        }
    }

    #[test]
    fn every_column_asks_and_the_first_no_stops_it() {
        let asked = Cell::new(0);
        let after = |most: usize| {
            asked.set(0);
            Elimination::of(matrix(40), &|| {
                asked.set(asked.get() + 1);
                asked.get() > most
            })
            .is_none()
        };
        assert!(!after(40) && asked.get() == 40);
        assert!(after(17) && asked.get() == 18);
    }
}
