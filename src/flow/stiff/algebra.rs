//! The small linear algebra of a collocation step: elimination, and polynomials through the stages.

/// Maximum number of stages.
pub(super) const MOST: usize = 7;

/// The sum of the values of the stages, weighted by a row of the scheme.
pub(super) fn weighted(weights: &[f64], values: &[f64; MOST]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// Solves `matrix * x = right` in place by elimination with partial pivoting; `None` if singular.
pub(super) fn solve(
    matrix: &mut [[f64; MOST]; MOST],
    right: &mut [f64; MOST],
    size: usize,
) -> Option<()> {
    for column in 0..size {
        let magnitude = |row: &usize| matrix[*row][column].abs();
        let pivot = (column..size).max_by(|a, b| magnitude(a).total_cmp(&magnitude(b)))?;
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        let own = matrix[column];
        if own[column] == 0.0 {
            return None;
        }
        for row in column + 1..size {
            let factor = matrix[row][column] / own[column];
            for k in column + 1..size {
                matrix[row][k] -= factor * own[k];
            }
            right[row] -= factor * right[column];
        }
    }
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    Some(())
}

/// Newton's divided differences over 0 and the nodes.
pub(super) fn differences(nodes: &[f64], first: f64, values: &[f64; MOST]) -> [f64; MOST + 1] {
    let place = |index: usize| if index == 0 { 0.0 } else { nodes[index - 1] };
    let mut table = [0.0; MOST + 1];
    table[0] = first;
    table[1..].copy_from_slice(values);
    for level in 1..=nodes.len() {
        for index in (level..=nodes.len()).rev() {
            table[index] =
                (table[index] - table[index - 1]) / (place(index) - place(index - level));
        }
    }
    table
}

/// The polynomial with these divided differences.
pub(super) fn interpolated(nodes: &[f64], differences: &[f64; MOST + 1], at: f64) -> f64 {
    let stages = nodes.len();
    let inner = (1..=stages).rev().fold(0.0, |sum, index| {
        let before = if index == 1 { 0.0 } else { nodes[index - 2] };
        (sum + differences[index]) * (at - before)
    });
    differences[0] + inner
}
