//! Basin stability: which part of a window of starts is captured.
//!
//! The edge of the basin is a graph over the displacement ([`super::arc`]), so the captured part is an
//! integral, and no start has to be followed: at each displacement, how much of the window's velocities
//! lies between the lower and the upper arc.

use super::basin::{Basin, Fate, Window};
use super::border::Border;

/// A part of a whole, and a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The part, 0 .. 1.
    pub part: f64,
    /// Estimated absolute error.
    pub error: f64,
}

/// Absolute error to which each interval is integrated.
const TOLERANCE: f64 = 1e-10;

impl Basin {
    /// The part of a window's area that belongs to the basin of the sticking set.
    ///
    /// Adaptive Gauss-Kronrod quadrature over the displacements inside the edge, in the angle of a
    /// circle over them, in which the turning points of the edge are smooth. The error is the sum of the
    /// differences between its two rules.
    #[must_use]
    pub fn captured_share(&self, window: &Window) -> Share {
        let whole = |part| Share { part, error: 0.0 };
        if self.fates.first() != Some(&Fate::Captured) {
            return whole(0.0);
        }
        let Some(edge) = self.borders.first() else { return whole(1.0) };
        let Some((left, right)) = support(edge, window.q) else { return whole(0.0) };
        let (width, height) = (window.q.1 - window.q.0, window.v.1 - window.v.0);
        let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
        let density = |angle: f64| {
            let (low, high) = edge.span_at(middle + half * angle.sin()).unwrap_or((0.0, 0.0));
            let inside = (high.min(window.v.1) - low.max(window.v.0)).max(0.0);
            inside / height * half / width * angle.cos()
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        let share = integrate(&density, (-quarter, quarter));
        Share { part: share.part.clamp(0.0, 1.0), ..share }
    }
}

/// The displacements of a range at which some start lies inside the border: around the sticking set.
pub(super) fn support(edge: &Border, (from, to): (f64, f64)) -> Option<(f64, f64)> {
    let inside = |q: f64| edge.span_at(q).is_some();
    // Inside lies an interval with 0 in it.
    let nearest = 0.0_f64.clamp(from, to);
    inside(nearest).then(|| {
        let end = |outer: f64| if inside(outer) { outer } else { last(inside, nearest, outer) };
        (end(from), end(to))
    })
}

/// The last number, going from `yes` to `no`, for which something holds, by bisection to rounding.
fn last(holds: impl Fn(f64) -> bool, mut yes: f64, mut no: f64) -> f64 {
    loop {
        let middle = yes + 0.5 * (no - yes);
        if middle == yes || middle == no {
            return yes;
        }
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
}

/// Integrates over a range, halving intervals until both rules agree.
pub(super) fn integrate(function: &impl Fn(f64) -> f64, range: (f64, f64)) -> Share {
    /// Intervals are not halved more often: a kink is then 1e-9 of the range wide.
    const DEPTH: u32 = 30;
    let mut total = Share { part: 0.0, error: 0.0 };
    let mut waiting = vec![(range, DEPTH)];
    while let Some(((from, to), depth)) = waiting.pop() {
        let share = gauss_kronrod(function, from, to);
        if share.error <= TOLERANCE || depth == 0 {
            total.part += share.part;
            total.error += share.error;
        } else {
            let middle = 0.5 * (from + to);
            waiting.extend([((from, middle), depth - 1), ((middle, to), depth - 1)]);
        }
    }
    total
}

/// The 15-point rule of Kronrod, and its difference from the 7-point rule of Gauss within it.
///
/// Nodes and weights: Piessens et al., QUADPACK (1983), rounded to doubles.
fn gauss_kronrod(function: &impl Fn(f64) -> f64, from: f64, to: f64) -> Share {
    /// Node, Kronrod weight, Gauss weight (0 where the node is no node of Gauss).
    const NODES: [(f64, f64, f64); 8] = [
        (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
        (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
        (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
        (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
        (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
        (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
        (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
        (0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4),
    ];
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut kronrod, mut gauss) = (0.0, 0.0);
    for (node, of_kronrod, of_gauss) in NODES {
        let value = if node == 0.0 {
            function(middle)
        } else {
            function(middle - half * node) + function(middle + half * node)
        };
        kronrod += of_kronrod * value;
        gauss += of_gauss * value;
    }
    Share { part: half * kronrod, error: (half * (kronrod - gauss)).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;
    use crate::oscillator::Parameters;
    use crate::study::basin::basin;

    fn share(parameters: Parameters, window: Window) -> Share {
        let reach = window.q.0.abs().max(window.q.1.abs());
        basin(&parameters, reach, &Limits::PATIENT).unwrap().captured_share(&window)
    }

    fn square(half: f64) -> Window {
        Window { q: (-half, half), v: (-half, half) }
    }

    #[test]
    fn a_window_around_the_whole_basin_holds_its_area() {
        for (d, d2, d3) in [(-0.2, 0.0, 0.0), (-0.3, 0.4, 0.2), (0.2, 0.0, -0.1)] {
            let parameters = Parameters { d, d2, d3, r: 0.1 };
            let found = basin(&parameters, 10.0, &Limits::PATIENT).unwrap();
            let area = found.area().unwrap();
            for half in [5.0, 10.0] {
                let Share { part, error } = found.captured_share(&square(half));
                let whole = 4.0 * half * half;
                assert!((part * whole - area).abs() <= whole * (error + 1e-13), "{d} {d2} {d3}");
                assert!(error < 1e-8, "{error}");
            }
        }
    }

    #[test]
    fn windows_that_cut_the_basin_add_up() {
        let parameters = Parameters { d: -0.2, d2: 0.3, d3: 0.0, r: 0.1 };
        let whole = share(parameters, square(0.4));
        let quarters = [(-0.4, 0.0), (0.0, 0.4)];
        let mut sum = Share { part: 0.0, error: 0.0 };
        for q in quarters {
            for v in quarters {
                let quarter = share(parameters, Window { q, v });
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
    fn what_is_wholly_inside_or_outside_is_exact() {
        let inside = Parameters { d: 0.1, d2: 0.0, d3: 0.0, r: 0.1 };
        assert_eq!(share(inside, square(3.0)), Share { part: 1.0, error: 0.0 });
        let outside = Parameters { d: -0.3, d2: 0.0, d3: 0.0, r: 0.1 };
        let far = Window { q: (2.0, 3.0), v: (-1.0, 1.0) };
        assert_eq!(share(outside, far), Share { part: 0.0, error: 0.0 });
        let frictionless = Parameters { d: -0.3, d2: 0.0, d3: 0.1, r: 0.0 };
        assert_eq!(share(frictionless, square(3.0)), Share { part: 0.0, error: 0.0 });
    }

    #[test]
    fn a_counted_grid_comes_near_the_integral() {
        let parameters = Parameters { d: -0.05, d2: 0.5, d3: 0.0, r: 0.1 };
        let window = Window { q: (-2.0, 2.0), v: (-1.0, 3.0) };
        let found = basin(&parameters, 2.0, &Limits::PATIENT).unwrap();
        let share = found.captured_share(&window);
        let counts = found.count(&window, 2001, 2001, &Limits::PATIENT).unwrap();
        #[expect(clippy::cast_precision_loss, reason = "four million")]
        let counted = counts.captured as f64 / (2001.0 * 2001.0);
        assert!(share.part > 0.1 && share.part < 0.9, "{share:?}");
        assert!((share.part - counted).abs() < 2e-3, "{share:?} {counted}");
    }
}
