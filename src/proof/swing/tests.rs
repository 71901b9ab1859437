//! The criterion for motions that never return, by the polynomial that decides it.

use super::never_returns;
use crate::numerics::Interval;
use crate::proof::field::Field;

/// `P = m - (a + 2) v - b v^2 - c v^3` is bounded from below by its coefficients. Where it is negative
/// somewhere, nothing may be claimed.
#[test]
fn what_never_returns_is_told_from_what_may() {
    for (coefficients, [x, v], never) in [
        // `(v - 1)^2 + m - 1`.
        ([0.0, -1.0, 0.0], [-1.001, 0.0], true),
        ([0.0, -1.0, 0.0], [-0.98, 0.0], false),
        ([0.0, -1.0, 0.0], [-0.501, 0.5], true),
        ([0.0, -1.0, 0.0], [-0.48, 0.5], false),
        // `m - 2.1756.. + (v - 1.475)^2`, `m = 1 - x`.
        ([0.95, -1.0, 0.0], [-1.18, 1.0], true),
        ([0.95, -1.0, 0.0], [-1.17, 1.0], false),
        ([0.95, -1.0, 0.0], [-1.1, 1.0], false),
        // `m - 0.05 v + 0.001 v^2`, at least `m - 0.625`.
        ([-1.95, -0.001, 0.0], [-0.63, 0.0], true),
        ([-1.95, -0.001, 0.0], [-0.62, 0.0], false),
        // `m - 3 v + v^3`, at least `m - 2`.
        ([1.0, 0.0, -1.0], [-1.99, 0.0], false),
        // `m - 3 v^2 + v^3`, at least `m - 4`.
        ([-2.0, 3.0, -1.0], [-3.99, 0.0], false),
        // The centre is at rest, and cubic damping brings every motion back.
        ([-3.0, -1.0, 0.0], [0.0, 0.0], false),
        ([-3.0, -1.0, 1e-9], [-1.0, 0.0], false),
    ] {
        let [a, b, c] = coefficients.map(Interval::point);
        assert_eq!(never_returns(&Field { a, b, c }, x, v), never, "{coefficients:?} {x} {v}");
    }
}
