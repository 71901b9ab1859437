//! Basin stability: what fraction of a window of starts is captured.
//!
//! The edge of the basin is a graph over the displacement ([`super::arc`]), so the captured part is an
//! integral, and no start has to be followed: at each displacement, how much of the window's velocities
//! lies between the lower and the upper arc.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use crate::numerics::{Integral, TO_ROUNDING, asin, bisect, cos, integrate, powi, sin};
use crate::portrait::{Edge, StartWindow};

/// A fraction, and a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Share {
    /// The fraction, from 0 to 1.
    pub part: f64,
    /// Estimated absolute error.
    pub error: f64,
}

impl Share {
    /// A fraction that follows without integration.
    pub(crate) fn exact(part: f64) -> Self {
        Share { part, error: 0.0 }
    }
}

/// Absolute error to which each interval is integrated.
const TOLERANCE: f64 = 1e-12;

/// The fraction of a window's area that lies within a border; both in the same units.
///
/// Adaptive Gauss-Kronrod quadrature over the displacements inside it. The error is ten times the sum of the
/// differences between its two rules, and rounding.
pub(crate) fn part_within(edge: &Edge, window: &StartWindow) -> Share {
    let Some((left, right)) = support(edge, window.q) else {
        return Share::exact(0.0);
    };
    let (width, height) = (window.q.1 - window.q.0, window.v.1 - window.v.0);
    let density = |q: f64| {
        let (low, high) = edge.span_at(q).unwrap_or((0.0, 0.0));
        (high.min(window.v.1) - low.max(window.v.0)).max(0.0) / height / width
    };
    let Integral { value, error } = over_scales(density, (left, right), edge);
    Share { part: value.clamp(0.0, 1.0), error: error + f64::EPSILON }
}

/// Integrates over displacements inside an edge, in the angle of a circle over them, in which the turning points of
/// the edge are smooth.
///
/// Next to the ends and to the sticking set the integrand may vary fast, and slowly far from them: each piece is
/// some times as wide as all between it and the nearest of these, so that none is overlooked. Pieces end at the
/// corners of the edge.
pub(crate) fn over_scales(
    density: impl Fn(f64) -> f64,
    (left, right): (f64, f64),
    edge: &Edge,
) -> Integral {
    const SCALES: i32 = 8;
    const WIDER: f64 = 30.0;
    /// At a kink both rules may agree by chance to a part of their error.
    const KINKED: f64 = 10.0;
    let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
    let lengths = (1..=SCALES).map(|power| (right - left) * powi(WIDER, -power));
    let places = lengths.flat_map(|length| [left + length, -length, length, right - length]);
    let angles = places
        .chain(edge.corners())
        .filter(|q| (left..right).contains(q))
        .map(|q| asin(((q - middle) / half).clamp(-1.0, 1.0)));
    let mut ends: Vec<f64> = angles.chain([-FRAC_PI_2, FRAC_PI_2]).collect();
    ends.sort_by(f64::total_cmp);
    let over = |angle: f64| density(middle + half * sin(angle)) * half * cos(angle);
    let mut sum = Integral { value: 0.0, error: 0.0 };
    for piece in ends.windows(2).filter(|piece| piece[0] < piece[1]) {
        let Integral { value, error } = integrate(&over, (piece[0], piece[1]), TOLERANCE);
        sum = Integral { value: sum.value + value, error: sum.error + KINKED * error };
    }
    sum
}

/// The displacements of a range at which some start lies inside the border: around the sticking set.
pub(crate) fn support(edge: &Edge, (from, to): (f64, f64)) -> Option<(f64, f64)> {
    let inside = |q: f64| edge.span_at(q).is_some();
    // Inside lies an interval with 0 in it.
    let nearest = 0.0_f64.clamp(from, to);
    inside(nearest).then(|| {
        let end = |outer: f64| {
            if inside(outer) {
                outer
            } else {
                bisect(nearest, outer, TO_ROUNDING, |q| !inside(q)).0
            }
        };
        (end(from), end(to))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;
    use crate::model::Parameters;
    use crate::portrait::Portrait;

    fn share(parameters: Parameters, window: StartWindow) -> Share {
        let reach = window.q.0.abs().max(window.q.1.abs());
        Portrait::of_oscillator(&parameters, reach, &Limits::PATIENT)
            .unwrap()
            .rest_share(window.q, window.v)
            .unwrap()
    }

    fn square(half: f64) -> StartWindow {
        StartWindow { q: (-half, half), v: (-half, half) }
    }

    #[test]
    fn windows_that_cut_the_basin_add_up() {
        let parameters = Parameters { d: -0.2, d2: 0.3, d3: 0.0, r: 0.1 };
        let whole = share(parameters, square(0.4));
        let quarters = [(-0.4, 0.0), (0.0, 0.4)];
        let mut sum = Share { part: 0.0, error: 0.0 };
        for q in quarters {
            for v in quarters {
                let quarter = share(parameters, StartWindow { q, v });
                sum = Share {
                    part: sum.part + quarter.part / 4.0,
                    error: sum.error + quarter.error / 4.0,
                };
            }
        }
        assert!(whole.part > 0.5 && whole.part < 0.99, "{whole:?}");
        assert!((whole.part - sum.part).abs() <= whole.error + sum.error + 1e-13);
    }

    #[test]
    fn a_window_far_wider_than_the_scale_of_the_edge_is_the_sum_of_its_parts() {
        for (d, d2, d3, r) in [(0.1, 0.5, 0.0, 0.1), (0.02, -0.5, 0.0, 0.1), (0.1, 50.0, 0.0, 1e-4)]
        {
            let parameters = Parameters { d, d2, d3, r };
            for half in [1e3, 1e5, 1e7] {
                let v = (-0.5, 0.4);
                let found = Portrait::of_oscillator(&parameters, half, &Limits::PATIENT).unwrap();
                let whole = found.rest_share((-half, half), v).unwrap();
                let ends = [-half, -300.0, -10.0, -3.0, -1.0, 0.0, 1.0, 3.0, 10.0, 300.0, half];
                let (mut sum, mut error) = (0.0, whole.error);
                for q in ends.windows(2) {
                    let share = found.rest_share((q[0], q[1]), v).unwrap();
                    let weight = (q[1] - q[0]) / (2.0 * half);
                    (sum, error) = (sum + weight * share.part, error + weight * share.error);
                }
                let off = (whole.part - sum).abs();
                assert!(
                    off <= error + 1e-13,
                    "{parameters:?} {half}: off by {off:e}, not {error:e}"
                );
            }
        }
    }

    #[test]
    fn what_is_wholly_inside_or_outside_is_exact() {
        let inside = Parameters { d: 0.1, d2: 0.0, d3: 0.0, r: 0.1 };
        assert_eq!(share(inside, square(3.0)), Share { part: 1.0, error: 0.0 });
        let outside = Parameters { d: -0.3, d2: 0.0, d3: 0.0, r: 0.1 };
        let far = StartWindow { q: (2.0, 3.0), v: (-1.0, 1.0) };
        assert_eq!(share(outside, far), Share { part: 0.0, error: 0.0 });
        let frictionless = Parameters { d: -0.3, d2: 0.0, d3: 0.1, r: 0.0 };
        assert_eq!(share(frictionless, square(3.0)), Share { part: 0.0, error: 0.0 });
    }

    #[test]
    fn a_counted_grid_comes_near_the_integral() {
        let parameters = Parameters { d: -0.05, d2: 0.5, d3: 0.0, r: 0.1 };
        let window = StartWindow { q: (-2.0, 2.0), v: (-1.0, 3.0) };
        let found = Portrait::of_oscillator(&parameters, 2.0, &Limits::PATIENT).unwrap();
        let share = found.rest_share(window.q, window.v).unwrap();
        let counts = found.count(&window, (2001, 2001), &Limits::PATIENT).unwrap();
        #[expect(clippy::cast_precision_loss, reason = "four million")]
        let counted = counts.captured as f64 / (2001.0 * 2001.0);
        assert!(share.part > 0.1 && share.part < 0.9, "{share:?}");
        assert!((share.part - counted).abs() < 2e-3, "{share:?} {counted}");
    }
}
