//! Functions as points, as finely as print can show.

use crate::scene::{Point, Window};

/// Intervals that are always evaluated, so that no narrow feature is missed.
const INTERVALS: u32 = 256;

/// Maximum number of halvings of such an interval: where a function jumps, the jump is as steep as this.
const HALVINGS: u32 = 12;

/// Largest distance between the function and its polyline in the middle of an interval, as a fraction of the window's
/// height: a thirtieth of a pixel of a panel 300 pixels high. Elsewhere it may be twice as large.
const CHORD: f64 = 1e-4;

/// The graph of a function over the window. A point that is not a number stands where it has no value.
pub(super) fn graph(value: &dyn Fn(f64) -> Option<f64>, window: Window) -> Vec<Point> {
    let at = |x: f64| Point { x, y: value(x).filter(|y| y.is_finite()).unwrap_or(f64::NAN) };
    let mut points = vec![at(window.x.from())];
    for interval in 1..=INTERVALS {
        let from = points[points.len() - 1];
        let to = at(window.x.at(f64::from(interval) / f64::from(INTERVALS)));
        halve(&at, from, to, window, HALVINGS, &mut points);
    }
    // Runs without a value keep one point, which interrupts the curve.
    points.dedup_by(|next, last| next.y.is_nan() && last.y.is_nan());
    points
}

/// Adds the points after `from` up to `to`.
fn halve(
    at: &dyn Fn(f64) -> Point,
    from: Point,
    to: Point,
    window: Window,
    halvings: u32,
    points: &mut Vec<Point>,
) {
    if halvings > 0 && !(from.y.is_nan() && to.y.is_nan()) {
        let middle = at(f64::midpoint(from.x, to.x));
        let within = |y: f64| y.clamp(window.y.at(-0.5), window.y.at(1.5));
        let chord = f64::midpoint(within(from.y), within(to.y));
        let close = (within(middle.y) - chord).abs() <= CHORD * window.y.width();
        if !close {
            halve(at, from, middle, window, halvings - 1, points);
            halve(at, middle, to, window, halvings - 1, points);
            return;
        }
    }
    points.push(to);
}

pub(super) fn lattice(window: Window) -> impl Iterator<Item = Point> {
    const COUNT: u32 = 17;
    let fraction = |index: u32| (f64::from(index) + 0.5) / f64::from(COUNT);
    let all = (0..COUNT).flat_map(|row| (0..COUNT).map(move |column| (row, column)));
    all.map(move |(row, column)| Point {
        x: window.x.at(fraction(column)),
        y: window.y.at(fraction(row)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::sin;
    use crate::scene::Span;

    fn window() -> Window {
        Window { x: Span::known(-1.0, 1.0), y: Span::known(0.0, 2.0) }
    }

    #[test]
    fn a_polyline_stays_within_the_tolerance_of_its_function_with_few_points() {
        let value = |x: f64| 1.0 + sin(40.0 * x);
        let points = graph(&|x| Some(value(x)), window());
        for pair in points.windows(2) {
            // Also away from the middle, where the sampling itself looks; the window is 2 high.
            for part in [0.2, 0.5, 0.7] {
                let between = |a: f64, b: f64| a + part * (b - a);
                let (x, chord) = (between(pair[0].x, pair[1].x), between(pair[0].y, pair[1].y));
                assert!((value(x) - chord).abs() < 4e-4, "{x}: {} and {chord}", value(x));
            }
        }
        assert!(points.len() < 3000, "{}", points.len());
    }

    #[test]
    fn a_function_ends_where_it_has_no_more_value() {
        let points = graph(&|x| (x < 0.25).then_some(0.5), window());
        let last = points.iter().rfind(|point| !point.y.is_nan()).unwrap();
        assert!((last.x - 0.25).abs() < 1e-5, "{last:?}");
        assert!(points.last().unwrap().y.is_nan());
    }
}
