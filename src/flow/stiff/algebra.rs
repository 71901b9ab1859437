//! Polynomials through the stages of a collocation step.

use crate::flow::tableau::radau::{MOST, Stages};

/// Newton's divided differences over 0 and the nodes.
pub(super) fn differences(nodes: &[f64], first: f64, values: &Stages) -> [f64; MOST + 1] {
    let place = |index: usize| if index == 0 { 0.0 } else { nodes[index - 1] };
    let mut table = [0.0; MOST + 1];
    table[0] = first;
    table[1..].copy_from_slice(values.as_slice());
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
