//! The area that a curve does not separate from the origin, as a polygon.

use crate::numerics::elementary::{atan2, sin_cos};
use crate::scene::Window;

type Pair = [f64; 2];

/// How far around the window an open curve is closed, in sizes of the window.
const AROUND: f64 = 4.0;

/// The loops whose even-odd filling is the area: the curve where it is closed, else the curve closed
/// around the window, and a rectangle around all where the origin lies outside of that.
pub(super) fn loops(edge: &[Pair], window: Window) -> Vec<Vec<Pair>> {
    let (Some(first), Some(last)) = (edge.first(), edge.last()) else { return Vec::new() };
    if first == last {
        return vec![edge.to_vec()];
    }
    let mut closed = edge.to_vec();
    closed.extend(detour(*last, *first, window));
    if contains(&closed, [0.0, 0.0]) { vec![closed] } else { vec![rectangle(window), closed] }
}

fn rectangle(window: Window) -> Vec<Pair> {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|corner| place(window, corner))
        .to_vec()
}

/// A point of the rectangle around the window; its sides lie at -1 and 1.
fn place(window: Window, (x, y): (f64, f64)) -> Pair {
    let center = window.center();
    [center.x + 0.5 * AROUND * window.x.width() * x, center.y + 0.5 * AROUND * window.y.width() * y]
}

/// The way from one point outside of the window to another, around it.
fn detour(from: Pair, to: Pair, window: Window) -> Vec<Pair> {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
    let center = window.center();
    let angle =
        |[x, y]: Pair| atan2((y - center.y) / window.y.width(), (x - center.x) / window.x.width());
    let outward = |angle: f64| {
        let (sin, cos) = sin_cos(angle);
        let longest = sin.abs().max(cos.abs());
        place(window, (cos / longest, sin / longest))
    };
    let (start, end) = (angle(from), angle(to));
    // The shorter way round.
    let turn = (end - start + PI).rem_euclid(TAU) - PI;
    let corners = (-8..=8).map(|corner| FRAC_PI_4 + FRAC_PI_2 * f64::from(corner));
    let mut between: Vec<f64> = corners
        .filter(|corner| (corner - start) * turn > 0.0 && (corner - start).abs() < turn.abs())
        .collect();
    if turn < 0.0 {
        between.reverse();
    }
    let way = std::iter::once(start).chain(between).chain(std::iter::once(end));
    way.map(outward).collect()
}

/// Whether a polygon contains a point, by counting crossings.
fn contains(polygon: &[Pair], [x, y]: Pair) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(next).filter(|([x0, y0], [x1, y1])| {
        (*y0 > y) != (*y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Span;

    const WINDOW: Window = Window { x: Span::known(-1.0, 1.0), y: Span::known(-1.0, 1.0) };

    fn inside(loops: &[Vec<Pair>], point: Pair) -> bool {
        loops.iter().filter(|polygon| contains(polygon, point)).count() % 2 == 1
    }

    #[test]
    fn a_closed_curve_around_the_origin_holds_its_inside() {
        let square = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]];
        let area = loops(&square, WINDOW);
        assert!(inside(&area, [0.4, 0.4]) && !inside(&area, [0.6, 0.0]));
    }

    #[test]
    fn an_open_curve_holds_the_side_of_the_origin() {
        for turned in [false, true] {
            let mut line = vec![[0.5, -3.0], [0.5, 0.0], [0.5, 3.0]];
            if turned {
                line.reverse();
            }
            let area = loops(&line, WINDOW);
            assert!(inside(&area, [-0.9, 0.9]) && inside(&area, [0.4, -0.9]), "{turned}");
            assert!(!inside(&area, [0.9, 0.0]), "{turned}");
        }
    }
}
