//! Energy `V = (q^2 + v^2)/2` and where it goes: one ledger for each term of the model.
//!
//! `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. The four integrals must add up to the change of `V`;
//! what is missing is an error estimate that costs almost nothing.

use serde::Serialize;

use super::parameters::State;

/// Work done along a motion by each term of equation (4), and what remains unaccounted for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Ledger {
    /// Energy at the start.
    pub start: f64,
    /// Energy at the end.
    pub end: f64,
    /// Work of `-2 D v`.
    pub linear: f64,
    /// Work of `-D2 v^2`.
    pub quadratic: f64,
    /// Work of `-D3 v^3`.
    pub cubic: f64,
    /// Work of dry friction, never positive.
    pub friction: f64,
    /// `end - start` minus the sum of the four works.
    pub residual: f64,
}

/// The energy `(q^2 + v^2)/2` of a state.
#[must_use]
pub fn energy(state: State) -> f64 {
    0.5 * (state.q * state.q + state.v * state.v)
}
