//! The segment of equilibria that dry friction makes of the steady state (equation 10).

use super::parameters::State;

/// Whether a motion at this point rests forever: `v = 0` and `abs(q) <= r`.
#[must_use]
pub fn rests(state: State, r: f64) -> bool {
    state.v == 0.0 && state.q.abs() <= r
}
