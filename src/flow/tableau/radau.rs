//! Radau IIA collocation with 3, 5 and 7 stages: orders 5, 9 and 13, L-stable.
//!
//! Butcher and Ehle; Hairer and Wanner, *Solving Ordinary Differential Equations II*, 2nd edition
//! (1996), section IV.8, and *Stiff differential equations solved by Radau methods*, Journal of
//! Computational and Applied Mathematics 111 (1999). The nodes are known to twice the precision; the
//! other coefficients follow from them, each to the last digit.

use std::sync::LazyLock;

use nalgebra::{SMatrix, SVector};

use super::rows;
use crate::numerics::{Scalar, Twofold, real};

/// Maximum number of stages.
pub const MOST: usize = 7;

/// A number for each stage; 0 beyond those of the scheme.
pub type Stages = SVector<f64, MOST>;

/// A number for each pair of stages; 0 beyond those of the scheme.
pub type StageMatrix = SMatrix<f64, MOST, MOST>;

/// Divided differences over the start and the nodes.
pub type Differences = [f64; MOST + 1];

/// A collocation scheme.
#[derive(Debug)]
pub struct Collocation {
    /// Positions of the stages as fractions of the step; the last one is at its end.
    pub nodes: Vec<f64>,
    /// Integrals of the Lagrange polynomials from 0 to each node; the last row gives the quadrature weights.
    pub integrals: StageMatrix,
    /// Their square.
    pub square: StageMatrix,
    /// Difference from the embedded solution of order S, without the term with the weight below.
    pub error: Stages,
    /// Weight of the slope at the start in that difference: the real eigenvalue of `integrals`.
    pub start: f64,
    /// Length of a step, in damping times, at which the order is half reduced in the sense of
    /// [`Collocation::reduced_order`].
    pub stiff: f64,
}

impl Collocation {
    /// The scheme with the nodes of this name, each the double next to it and what that leaves out. The difference from the
    /// embedded solution vanishes for polynomials of degree below S.
    fn read(name: &str, start: f64, stiff: f64) -> Self {
        let node = |row: Vec<f64>| Twofold { high: row[0], low: row[1] };
        let nodes: Vec<_> = rows(name).map(node).collect();
        let polynomials: Vec<_> = (0..nodes.len()).map(|own| lagrange(&nodes, own)).collect();
        let integrals = StageMatrix::from_fn(|stage, own| {
            let pair = nodes.get(stage).zip(polynomials.get(own));
            pair.map_or(0.0, |(end, one)| integral(one, *end))
        });
        let error = |own: usize| polynomials.get(own).map_or(0.0, |it| -start * it[0].value());
        Collocation {
            nodes: nodes.iter().map(|node| node.value()).collect(),
            integrals,
            square: integrals * integrals,
            error: Stages::from_fn(|own, _| error(own)),
            start,
            stiff,
        }
    }

    /// The error of the solution as a fraction of that of the embedded solution, given the order reduction.
    ///
    /// Derived from `v' = -k (v - t^(S+1)) + (S + 1) t^S`, where the solution of order `2 S - 1` would be exact
    /// without damping (the problem of Prothero and Robinson; Hairer and Wanner, section IV.15). With k h
    /// damping times in a step this fraction grows as `(k h)^(S-1)` towards S. The formula is accurate to a fifth.
    pub fn reduced_order(&self, damping_times: f64) -> f64 {
        let growth = damping_times / (damping_times + self.stiff);
        let stages = real(self.nodes.len());
        self.nodes[1..].iter().fold(stages, |part, _| part * growth)
    }

    /// Newton's divided differences over 0 and the nodes.
    pub fn differences(&self, first: f64, values: &Stages) -> Differences {
        let place = |index: usize| if index == 0 { 0.0 } else { self.nodes[index - 1] };
        let mut table = [first; MOST + 1];
        table[1..].copy_from_slice(values.as_slice());
        for level in 1..=self.nodes.len() {
            for index in (level..=self.nodes.len()).rev() {
                table[index] =
                    (table[index] - table[index - 1]) / (place(index) - place(index - level));
            }
        }
        table
    }

    /// The polynomial with these divided differences.
    pub fn interpolated(&self, differences: &Differences, at: f64) -> f64 {
        let inner = (1..=self.nodes.len()).rev().fold(0.0, |sum, index| {
            let before = if index == 1 { 0.0 } else { self.nodes[index - 2] };
            (sum + differences[index]) * (at - before)
        });
        differences[0] + inner
    }
}

/// Coefficients of the polynomial that is 1 at a node and 0 at the others.
fn lagrange(nodes: &[Twofold], own: usize) -> Vec<Twofold> {
    let mut coefficients = vec![Twofold::from(1.0)];
    for (_, &node) in nodes.iter().enumerate().filter(|(other, _)| *other != own) {
        let distance = nodes[own] - node;
        coefficients.push(Twofold::default());
        for power in (0..coefficients.len()).rev() {
            let shifted = if power == 0 {
                Twofold::default()
            } else {
                coefficients[power - 1]
            };
            coefficients[power] = (shifted - node * coefficients[power]) / distance;
        }
    }
    coefficients
}

/// The integral of a polynomial from 0.
fn integral(coefficients: &[Twofold], end: Twofold) -> f64 {
    let terms = coefficients.iter().enumerate().rev();
    terms
        .fold(Twofold::default(), |sum, (power, coefficient)| {
            (sum + coefficient.over_count(power + 1)) * end
        })
        .value()
}

/// The schemes of order 5, 9 and 13.
pub static SCHEMES: LazyLock<[Collocation; 3]> = LazyLock::new(|| {
    [
        Collocation::read("radau-3", 0.274_888_829_595_677_34, 8.2),
        Collocation::read("radau-5", 0.159_065_844_427_469_13, 11.0),
        Collocation::read("radau-7", 0.111_896_465_300_035_08, 14.1),
    ]
});

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::numerics::elementary::powi;

    fn collocates(scheme: &Collocation) {
        let nodes = &scheme.nodes;
        let stages = nodes.len();
        let error = scheme.start + scheme.error.iter().sum::<f64>();
        assert!(error.abs() < 1e-15, "{stages} stages: {error:e}");
        for (node, row) in nodes.iter().zip(scheme.integrals.row_iter()) {
            for degree in 0..i32::try_from(stages).unwrap() {
                let sum: f64 =
                    nodes.iter().zip(row.iter()).map(|(node, a)| a * powi(*node, degree)).sum();
                let integral = powi(*node, degree + 1) / f64::from(degree + 1);
                assert!((sum - integral).abs() < 1e-15, "{stages} stages, degree {degree}");
            }
        }
    }

    fn order(scheme: &Collocation) -> i32 {
        let integral = |degree: i32| -> f64 {
            let row = scheme.integrals.row(scheme.nodes.len() - 1);
            scheme
                .nodes
                .iter()
                .zip(row.iter())
                .map(|(node, weight)| weight * powi(*node, degree))
                .sum()
        };
        let wrong = |degree: &i32| (integral(*degree) * f64::from(degree + 1) - 1.0).abs() > 1e-12;
        (0..20).find(wrong).unwrap()
    }

    /// Errors of the solution and of the embedded one over a step of length 1, from their definitions.
    fn errors(scheme: &Collocation, damping: f64) -> (f64, f64) {
        let stages = scheme.nodes.len();
        let degree = i32::try_from(stages).unwrap() + 1;
        let integrals = DMatrix::from_fn(stages, stages, |i, k| scheme.integrals[(i, k)]);
        let drive = DVector::from_fn(stages, |i, _| {
            let node = scheme.nodes[i];
            damping * powi(node, degree) + f64::from(degree) * powi(node, degree - 1)
        });
        let system = DMatrix::identity(stages, stages) + damping * &integrals;
        let slopes = system.lu().solve(&drive).unwrap();
        let end = (&integrals * &slopes)[stages - 1];
        let difference: f64 = scheme.error.iter().zip(&slopes).map(|(e, slope)| e * slope).sum();
        ((end - 1.0).abs(), (difference / (1.0 + scheme.start * damping)).abs())
    }

    #[test]
    fn stiff_damping_reduces_the_order() {
        for scheme in &*SCHEMES {
            for damping in [10.0, 30.0, 100.0, 300.0, 1e3, 1e4] {
                let (solution, embedded) = errors(scheme, damping);
                let part = scheme.reduced_order(damping) * embedded / solution;
                assert!((part - 1.0).abs() < 0.2, "{scheme:?}, {damping}: {part}");
            }
        }
    }

    #[test]
    fn stages_collocate_and_ends_superconverge() {
        SCHEMES.iter().for_each(collocates);
        assert_eq!(SCHEMES.each_ref().map(order), [5, 9, 13]);
    }
}
