//! Curves as polylines: functions sampled as finely as print can show, how far chords are from the curves that
//! they approximate, and which points cannot be seen.
//!
//! Between neighbours of a smooth curve the chord misses it by an eighth of the second difference. What
//! turns by more than [`CORNER`] at a point is a corner that is meant.

use super::elements::{PLOT, Spot};
use crate::numerics::{atan2, hypot};
use crate::scene::{Point, Span, Window};

/// Intervals that are always evaluated, so that no narrow feature is missed.
const INTERVALS: u32 = 256;

/// Maximum number of halvings of such an interval: where a function jumps, the jump is as steep as this.
const HALVINGS: u32 = 12;

/// Largest distance between the function and its polyline in the middle of an interval, as a fraction of the window's
/// height: a thirtieth of a pixel of a panel 300 pixels high. Elsewhere it may be twice as large.
const CHORD: f64 = 1e-4;

/// The graph of a function over the window. A point that is not a number stands where it has no value.
pub fn graph(value: &dyn Fn(f64) -> Option<f64>, window: Window) -> Vec<Point> {
    let at = |x: f64| Point { x, y: value(x).filter(|y| y.is_finite()).unwrap_or(f64::NAN) };
    let within = |point: Point| point.y.clamp(window.y.at(-0.5), window.y.at(1.5));
    let is_close = |from: Point, middle: Point, to: Point| {
        let chord = f64::midpoint(within(from), within(to));
        (within(middle) - chord).abs() <= CHORD * window.y.width()
    };
    let mut points = vec![at(window.x.from())];
    for x in window.x.evenly(INTERVALS).skip(1) {
        // The points to be reached, the next one last, each with the halvings that are left on the way to it.
        let mut ahead = vec![(at(x), HALVINGS)];
        while let Some((to, halvings)) = ahead.pop() {
            let from = points[points.len() - 1];
            let halves = halvings > 0 && !(from.y.is_nan() && to.y.is_nan());
            let middle = halves.then(|| at(f64::midpoint(from.x, to.x)));
            match middle.filter(|middle| !is_close(from, *middle, to)) {
                Some(middle) => ahead.extend([(to, halvings - 1), (middle, halvings - 1)]),
                None => points.push(to),
            }
        }
    }
    // Runs without a value keep one point, which interrupts the curve.
    points.dedup_by(|next, last| next.y.is_nan() && last.y.is_nan());
    points
}

pub fn lattice(window: Window) -> impl Iterator<Item = Point> {
    const COUNT: u32 = 17;
    let fraction = |index: u32| (f64::from(index) + 0.5) / f64::from(COUNT);
    let all = (0..COUNT).flat_map(|row| (0..COUNT).map(move |column| (row, column)));
    all.map(move |(row, column)| window.at([column, row].map(fraction)))
}

/// What is too small to be seen, in pixels.
pub const FAINT: f64 = 0.05;

/// An angle between two chords, in radians, that is not a bend of a curve sampled for print.
const CORNER: f64 = 0.3;

/// Where a point stands on the paper, in pixels from the lower left corner of its panel.
fn place([x, y]: [f64; 2], window: Window) -> (f64, f64) {
    (PLOT.0 * window.x.fraction(x), PLOT.1 * window.y.fraction(y))
}

/// Whether a box around these points touches the window.
fn in_sight(points: &[[f64; 2]], window: Window) -> bool {
    let touches = |axis: usize, span: Span| {
        let values = points.iter().map(|point| point[axis]);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        low <= span.to() && values.fold(f64::NEG_INFINITY, f64::max) >= span.from()
    };
    touches(0, window.x) && touches(1, window.y)
}

pub fn missed(line: &[[f64; 2]], window: Window) -> f64 {
    let bend = |three: &[[f64; 2]]| {
        let [before, here, after] = [0, 1, 2].map(|index| place(three[index], window));
        let (one, other) =
            ((here.0 - before.0, here.1 - before.1), (after.0 - here.0, after.1 - here.1));
        let turn = atan2(one.0 * other.1 - one.1 * other.0, one.0 * other.0 + one.1 * other.1);
        // The longer chord, turned by half of the angle at each of its ends.
        let length = hypot(one.0, one.1).max(hypot(other.0, other.1));
        if turn.abs() < CORNER {
            length * turn.abs() / 8.0
        } else {
            0.0
        }
    };
    let finite = |three: &&[[f64; 2]]| three.iter().flatten().all(|value| value.is_finite());
    let seen = line.windows(3).filter(finite).filter(|three| in_sight(three, window));
    seen.map(bend).fold(0.0, f64::max)
}

/// The points around the window, and every nth of the others.
pub fn kept(line: &[[f64; 2]], window: Window, times: usize) -> Vec<[f64; 2]> {
    let needed = |index: usize, point: &[f64; 2]| {
        let near = &line[index.saturating_sub(times)..(index + times + 1).min(line.len())];
        let ends = index == 0 || index + 1 == line.len();
        ends || index.is_multiple_of(times)
            || point.iter().any(|value| !value.is_finite())
            || in_sight(near, window)
    };
    let all = line.iter().enumerate();
    all.filter(|(index, point)| needed(*index, point)).map(|(_, point)| *point).collect()
}

/// The corners that a picture of a line needs: drawn through them, it misses none of its other points by more than can be
/// seen. The farthest point from a chord becomes a corner until none is [`FAINT`] away (Douglas and Peucker, 1973).
pub fn corners(line: &[Spot]) -> Vec<Spot> {
    let Some(last) = line.len().checked_sub(1) else { return Vec::new() };
    let mut needed = vec![false; line.len()];
    (needed[0], needed[last]) = (true, true);
    let mut chords = vec![(0, last)];
    while let Some((from, to)) = chords.pop() {
        let away = |index: usize| (beside(line[index], line[from], line[to]), index);
        let farthest = (from + 1..to).map(away).max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, corner)) = farthest.filter(|(apart, _)| *apart > FAINT) {
            needed[corner] = true;
            chords.extend([(from, corner), (corner, to)]);
        }
    }
    line.iter().zip(needed).filter(|(_, needed)| *needed).map(|(spot, _)| *spot).collect()
}

/// The distance of a spot from a chord.
fn beside((x, y): Spot, from: Spot, to: Spot) -> f64 {
    let (across, down) = (to.0 - from.0, to.1 - from.1);
    let (right, below) = (x - from.0, y - from.1);
    let length = (across * across + down * down).max(f64::MIN_POSITIVE);
    let part = ((right * across + below * down) / length).clamp(0.0, 1.0);
    hypot(right - part * across, below - part * down)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::{cos, sin};
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

    fn circle(points: u32) -> Vec<[f64; 2]> {
        let angle = |index: u32| std::f64::consts::TAU * f64::from(index) / f64::from(points);
        (0..=points).map(angle).map(|angle| [cos(angle), sin(angle)]).collect()
    }

    /// A window around (1, 0) in which a circle looks like one on paper.
    fn around(half: f64) -> Window {
        let span = |middle: f64, half: f64| Span::known(middle - half, middle + half);
        Window { x: span(1.0, half * PLOT.0 / PLOT.1), y: span(0.0, half) }
    }

    #[test]
    fn the_chords_of_a_circle_miss_it_by_their_sagitta() {
        for (points, half) in [(200, 1.0), (2000, 0.01)] {
            // 1 - cos(s/2) is s^2/8, to within a relative s^2/48.
            let chord = std::f64::consts::TAU / f64::from(points);
            let sagitta = PLOT.1 * chord * chord / 8.0 / (2.0 * half);
            let measured = missed(&circle(points), around(half));
            assert!((measured / sagitta - 1.0).abs() < 1e-3, "{measured} for {sagitta}");
        }
        let corner = [[0.9, 0.0], [1.0, 0.0], [1.0, 0.1]];
        assert_eq!(missed(&corner, around(1.0)), 0.0);
    }

    #[test]
    fn what_is_out_of_sight_is_thinned_and_what_is_seen_is_not() {
        let line = circle(2000);
        let thin = kept(&line, around(0.01), 10);
        assert!(thin.len() < line.len() / 8, "{}", thin.len());
        let seen = |line: &[[f64; 2]]| {
            line.iter().filter(|[x, y]| around(0.01).contains(Point { x: *x, y: *y })).count()
        };
        assert!(seen(&line) > 2);
        assert_eq!(seen(&thin), seen(&line));
    }

    #[test]
    fn a_circle_keeps_the_corners_that_its_sagitta_asks_for() {
        let dense: Vec<Spot> =
            circle(10_000).into_iter().map(|[x, y]| (150.0 * x, 150.0 * y)).collect();
        let thin = corners(&dense);
        // A chord of half an angle a misses the circle by r (1 - cos a): 61 are the fewest at 0.2, 122 at 0.05, and halving
        // arcs takes less than twice as many.
        assert!((122..=256).contains(&thin.len()), "{}", thin.len());
        let missed = |spot: &Spot| {
            let chords = thin.windows(2).map(|pair| beside(*spot, pair[0], pair[1]));
            chords.fold(f64::INFINITY, f64::min)
        };
        assert!(dense.iter().map(missed).fold(0.0, f64::max) <= FAINT);
        // The third lies on the way back.
        let hairpin = [(0.0, 0.0), (10.0, 0.0), (7.0, 0.01), (5.0, 0.0)];
        assert_eq!(corners(&hairpin), [hairpin[0], hairpin[1], hairpin[3]]);
        assert_eq!(corners(&[]), []);
    }
}
