//! The pair of order 5 with an error estimate of order 4.
//!
//! Dormand and Prince, *A family of embedded Runge-Kutta formulae*, Journal of Computational and Applied
//! Mathematics 6 (1980).

use super::{ErrorEstimate, Scheme};

pub static SCHEME: Scheme<STAGES, 8> =
    Scheme::new(&A, WEIGHTS, &[&ERROR], ErrorEstimate::Embedded(5.0));

/// Number of stages; the last one is at the end of the step.
const STAGES: usize = 7;

/// The stages between the first and the last from the slopes of those before, each on a line of its own.
#[rustfmt::skip]
const A: [f64; (STAGES - 1) * (STAGES - 2) / 2] = [
    1.0 / 5.0,
    3.0 / 40.0, 9.0 / 40.0,
    44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0,
    19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0,
    9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0,
];

/// Weights of the solution of order 5.
#[rustfmt::skip]
const WEIGHTS: [f64; STAGES] = [
    35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0,
];

/// Difference from the embedded solution of order 4.
#[rustfmt::skip]
const ERROR: [f64; STAGES] = [
    71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0,
    -1.0 / 40.0,
];
