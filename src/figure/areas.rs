//! Areas as polygons: the side of a curve that holds the origin, and what fills a window.
//!
//! To fill it, the window is cut into level strips. Along each edge of a strip the places are bisected at which the
//! filling changes; where all edges have the same fillings in the same order and the places lie on straight
//! lines, the strip is a row of trapezoids between these places, else it is halved. Trapezoids above each
//! other become one polygon.

use crate::numerics::{atan2, bisect, sin_cos};
use crate::picture::{Fill, Texture};
use crate::scene::{Point, Window};

type Pair = [f64; 2];

/// How far around the window an open curve is closed, in sizes of the window.
const AROUND: f64 = 4.0;

/// The loops whose even-odd filling is the area: the curve where it is closed, else the curve closed
/// around the window, and a rectangle around all where the origin lies outside of that.
pub fn loops(edge: &[Pair], window: Window) -> Vec<Vec<Pair>> {
    let (Some(first), Some(last)) = (edge.first(), edge.last()) else { return Vec::new() };
    if first == last {
        return vec![edge.to_vec()];
    }
    let mut closed = edge.to_vec();
    closed.extend(detour(*last, *first, window));
    if contains(&closed, [0.0, 0.0]) {
        vec![closed]
    } else {
        vec![rectangle(window), closed]
    }
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

/// The way from one point outside of the window to another, around it counterclockwise.
fn detour(from: Pair, to: Pair, window: Window) -> Vec<Pair> {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
    let center = window.center();
    let angle =
        |[x, y]: Pair| atan2((y - center.y) / window.y.width(), (x - center.x) / window.x.width());
    let outward = |angle: f64| {
        let (sin, cos) = sin_cos(angle);
        let longest = sin.abs().max(cos.abs());
        place(window, (cos / longest, sin / longest))
    };
    let start = angle(from);
    let end = start + (angle(to) - start).rem_euclid(TAU);
    let corners = (-2..=6).map(|corner| FRAC_PI_4 + FRAC_PI_2 * f64::from(corner));
    let between = corners.filter(|corner| (start..end).contains(corner));
    std::iter::once(start).chain(between).chain([end]).map(outward).collect()
}

/// Whether a polygon contains a point, by counting crossings.
fn contains(polygon: &[Pair], [x, y]: Pair) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(next).filter(|([x0, y0], [x1, y1])| {
        (*y0 > y) != (*y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    });
    crossed.count() % 2 == 1
}

/// Strips that a window is cut into at least.
const STRIPS: u32 = 150;

/// Places along an edge that are always evaluated.
const PLACES: u32 = 190;

/// Number of halvings between two places: a border is known to 1e-7 of the window.
const BISECTIONS: u32 = 16;

/// Maximum number of halvings of a strip.
const HALVINGS: u32 = 6;

/// Largest distance between a border and its chord, as a fraction of the window.
const CHORD: f64 = 1e-4;

/// How far inside of a strip its edges are looked at, as a fraction of the window: a border may lie on them.
const INSIDE: f64 = 1e-9;

/// What fills the window, each part as the corners of a closed polygon.
pub fn polygons(at: &Texture, window: Window) -> Vec<(Fill, Vec<Point>)> {
    let mut cutter = Cutter { at, window, open: Vec::new(), done: Vec::new() };
    for strip in 0..STRIPS {
        let [low, high] = [strip, strip + 1].map(|edge| f64::from(edge) / f64::from(STRIPS));
        cutter.strip(low, high, HALVINGS);
    }
    cutter.close();
    cutter.done
}

/// A part of an edge: where it ends, and what fills it.
type FillRun = (f64, Option<Fill>);

/// A polygon that the next strip may continue with.
struct Polygon {
    fill: Option<Fill>,
    left: Vec<Point>,
    right: Vec<Point>,
}

struct Cutter<'a> {
    at: &'a Texture<'a>,
    window: Window,
    open: Vec<Polygon>,
    done: Vec<(Fill, Vec<Point>)>,
}

impl Cutter<'_> {
    /// Adds the strip between two heights, as fractions of the window.
    fn strip(&mut self, low: f64, high: f64, halvings: u32) {
        let height = f64::midpoint(low, high);
        let (lower, upper) = (self.runs(low + INSIDE), self.runs(high - INSIDE));
        let middle = self.runs(height);
        if alike(&lower, &middle) && alike(&middle, &upper) && straight(&lower, &middle, &upper) {
            self.add((low, &lower), (height, &middle));
            self.add((height, &middle), (high, &upper));
        } else if halvings > 0 {
            self.strip(low, height, halvings - 1);
            self.strip(height, high, halvings - 1);
        } else {
            self.add((low, &middle), (high, &middle));
        }
    }

    /// What fills the window at a height, from left to right.
    fn runs(&self, height: f64) -> Vec<FillRun> {
        let y = self.window.y.at(height);
        let fill = |part: f64| (self.at)(Point { x: self.window.x.at(part), y });
        let mut runs: Vec<FillRun> = Vec::new();
        let (mut last, mut filled) = (INSIDE, fill(INSIDE));
        for place in 1..=PLACES {
            let part = (f64::from(place) / f64::from(PLACES)).min(1.0 - INSIDE);
            let here = fill(part);
            if here != filled {
                let (before, after) = bisect(last, part, BISECTIONS, |part| fill(part) != filled);
                runs.push((f64::midpoint(before, after), filled));
                filled = here;
            }
            last = part;
        }
        runs.push((1.0, filled));
        runs
    }

    /// Adds a row of trapezoids, on top of those below where they fit.
    fn add(&mut self, lower: (f64, &[FillRun]), upper: (f64, &[FillRun])) {
        let corners = |(height, runs): (f64, &[FillRun])| -> Vec<Point> {
            let ends = runs.iter().map(|(end, _)| *end);
            std::iter::once(0.0).chain(ends).map(|part| self.window.at([part, height])).collect()
        };
        let (below, above) = (corners(lower), corners(upper));
        let apart = 0.1 / f64::from(PLACES) * self.window.x.width();
        let begun = |((_, fill), ends): (&FillRun, &[Point])| Polygon {
            fill: *fill,
            left: vec![ends[0]],
            right: vec![ends[1]],
        };
        let begun: Vec<_> = lower.1.iter().zip(below.windows(2)).map(begun).collect();
        let meets =
            |side: &[Point], begun: &[Point]| (side[side.len() - 1].x - begun[0].x).abs() < apart;
        let goes_on = |(open, next): (&Polygon, &Polygon)| {
            let sides = meets(&open.left, &next.left) && meets(&open.right, &next.right);
            open.fill == next.fill && sides
        };
        let fits = self.open.len() == begun.len() && self.open.iter().zip(&begun).all(goes_on);
        if !fits {
            self.close();
            self.open = begun;
        }
        for (open, ends) in self.open.iter_mut().zip(above.windows(2)) {
            open.left.push(ends[0]);
            open.right.push(ends[1]);
        }
    }

    /// Ends the polygons that are open.
    fn close(&mut self) {
        for Polygon { fill, left: mut corners, right } in self.open.drain(..) {
            let Some(fill) = fill else { continue };
            corners.extend(right.into_iter().rev());
            corners.extend(corners.first().copied());
            self.done.push((fill, corners));
        }
    }
}

/// Whether two edges have the same fillings in the same order.
fn alike(lower: &[FillRun], upper: &[FillRun]) -> bool {
    lower.iter().map(|run| run.1).eq(upper.iter().map(|run| run.1))
}

/// Whether the borders on three edges lie on straight lines, as far as print shows.
fn straight(lower: &[FillRun], middle: &[FillRun], upper: &[FillRun]) -> bool {
    let mut ends = lower.iter().zip(middle).zip(upper);
    ends.all(|((a, b), c)| (b.0 - f64::midpoint(a.0, c.0)).abs() <= CHORD)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::hypot;
    use crate::picture::Role;
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

    const FILL: Fill = Fill { role: Role::Stable, name: "inside" };

    /// The area of closed polygons, by the trapezoidal rule.
    fn area_of(polygons: &[(Fill, Vec<Point>)]) -> f64 {
        let of = |corners: &[Point]| -> f64 {
            corners
                .windows(2)
                .map(|pair| 0.5 * (pair[1].y - pair[0].y) * (pair[1].x + pair[0].x))
                .sum()
        };
        polygons.iter().map(|(_, corners)| of(corners).abs()).sum()
    }

    #[test]
    fn a_disc_has_its_area_and_a_half_plane_is_one_rectangle() {
        let span = Span::known(-1.0, 1.0);
        let window = Window { x: span, y: span };
        let disc: Texture = Box::new(|at| (hypot(at.x, at.y) < 0.8).then_some(FILL));
        let found = area_of(&polygons(&disc, window));
        assert!((found - std::f64::consts::PI * 0.64).abs() < 2e-4, "{found}");
        let half: Texture = Box::new(|at| (at.y > 0.0).then_some(FILL));
        let [(_, corners)] = &polygons(&half, window)[..] else { panic!("one polygon") };
        assert!((area_of(&[(FILL, corners.clone())]) - 2.0).abs() < 1e-12);
        assert_eq!(corners.first(), corners.last());
    }

    #[test]
    fn neighbours_share_their_border_and_leave_nothing_between_them() {
        let other = Fill { name: "outside", ..FILL };
        let window = Window { x: Span::known(0.0, 0.5), y: Span::known(0.02, 2.0) };
        let both: Texture =
            Box::new(|at| Some(if at.x * at.x * at.y < 0.0078 { FILL } else { other }));
        let found = polygons(&both, window);
        assert!((area_of(&found) - 0.5 * 1.98).abs() < 1e-9, "{}", area_of(&found));
    }
}
