//! The classical method of order 4 (Kutta 1901), for steps of fixed length.

use super::{ErrorEstimate, Scheme};

pub static SCHEME: Scheme<STAGES, 4> = Scheme {
    columns: Scheme::<STAGES, 4>::columns(&A, &WEIGHTS, &[]),
    weights: WEIGHTS,
    estimate: ErrorEstimate::None,
    last_is_end: false,
};

const STAGES: usize = 4;

/// Row `i` gives stage `i + 1` from the slopes of the previous stages.
const A: [&[f64]; STAGES - 1] = [&[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]];

/// Weights of the solution.
const WEIGHTS: [f64; STAGES] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];
