//! A panel: what its plot shows, within its axes.

use tiny_skia_path::PathBuilder;

use super::areas::loops;
use super::axes::axes;
use super::elements::{Color, Element, PlotPen, Shape, Spot, WHITE, lead};
use super::lines::corners;
use super::paper::{Frame, PageLayout};
use super::{MarkedPoint, Outline, Panel, map};
use crate::numerics::{atan2, hypot, sin_cos};
use crate::picture::{Dash, Mark, Marks};
use crate::scene::Point;

/// Draws a panel with its axes.
pub fn draw(out: &mut Vec<Element>, panel: &Panel, frame: Frame) {
    let paper = frame.paper;
    let mut inside = Vec::new();
    if let Some(shown) = &panel.map {
        inside.extend(map::cells(shown, frame));
    }
    // Parts of the same area are one path: between two paths a hair of paper would show.
    let alike = |one: &Outline, other: &Outline| (&one.name, one.role) == (&other.name, other.role);
    let areas: Vec<&[Outline]> = panel.areas.chunk_by(alike).collect();
    for same in &areas {
        let tint = paper.shading(same[0].role);
        // Journals, and what turns PDF into EPS, would rather have no colour through which one sees.
        let alone = areas.len() == 1 && panel.map.is_none();
        inside.push(shade(same, frame).filled(if alone { tint.on_white() } else { tint }).into());
    }
    inside.extend(panel.arrows.iter().filter_map(|(at, way)| arrow(*at, *way, frame)));
    for guide in &panel.guides {
        inside.extend(polyline(guide, paper.line(0.6, [0xb0; 3]), frame));
    }
    for curve in &panel.curves {
        let pen = paper.pen(curve.role, curve.style.unwrap_or(Dash::Solid));
        inside.extend(polyline(&curve.points, pen, frame));
    }
    inside.extend(panel.marks.iter().filter_map(|mark| dot(mark, frame)));
    out.push(Element::Clipped((frame.left, frame.top), paper.plot, inside));
    axes(out, panel, frame);
}

/// A polyline, run by run between points that are not finite, if any of it is seen. What lies far outside of the plot is
/// moved to where its lines still run where they ran, and left out where they cannot be seen; of the rest, as many points
/// are kept as can be told apart.
fn polyline(points: &[[f64; 2]], pen: PlotPen, frame: Frame) -> Option<Element> {
    let drawn = |index: usize| {
        let around = &points[index.saturating_sub(1)..points.len().min(index + 2)];
        let seen = around.iter().any(|point| near(*point, frame));
        seen && points[index].iter().all(|value| value.is_finite())
    };
    let drawn: Vec<(bool, Spot)> =
        points.iter().enumerate().map(|(index, at)| (drawn(index), reached(*at, frame))).collect();
    let runs = drawn.chunk_by(|one, other| one.0 == other.0).filter(|run| run[0].0);
    let mut path = PathBuilder::new();
    for run in runs {
        let spots: Vec<Spot> = run.iter().map(|(_, spot)| *spot).collect();
        lead(&mut path, corners(&spots));
    }
    (!path.is_empty()).then(|| Shape::along(path).drawn(pen).into())
}

/// Where a point stands; what is far outside keeps its side.
fn reached(point: [f64; 2], frame: Frame) -> Spot {
    let (across, along) = frame.spot(point.into());
    (across.clamp(-1e5, 1e5), along.clamp(-1e5, 1e5))
}

/// Whether a point lies within a few sizes of the plot.
fn near([x, y]: [f64; 2], frame: Frame) -> bool {
    let window = frame.window;
    (-3.0..=4.0).contains(&window.x.fraction(x)) && (-3.0..=4.0).contains(&window.y.fraction(y))
}

fn shade(areas: &[Outline], frame: Frame) -> Shape {
    let mut path = PathBuilder::new();
    for polygon in areas.iter().flat_map(|area| loops(&area.points, frame.window)) {
        let spots: Vec<Spot> = polygon.into_iter().map(|point| reached(point, frame)).collect();
        lead(&mut path, corners(&spots));
        path.close();
    }
    Shape::along(path)
}

/// An arrow about a point of the world, which points a way in the world.
fn arrow(at: Point, way: Point, frame: Frame) -> Option<Element> {
    let (paper, scale) = (frame.paper, frame.paper.scale);
    let across = way.x * paper.plot.0 / frame.window.x.width();
    let down = -way.y * paper.plot.1 / frame.window.y.width();
    let length = hypot(across, down);
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    let (x, y) = frame.spot(at);
    let (sin, cos) = sin_cos(atan2(down, across));
    let turned = |(along, aside): Spot| {
        (x + scale * (along * cos - aside * sin), y + scale * (along * sin + aside * cos))
    };
    let mut path = PathBuilder::new();
    lead(&mut path, [(-6.0, 0.0), (6.0, 0.0)].map(turned));
    lead(&mut path, [(3.0, 1.8), (6.0, 0.0), (3.0, -1.8)].map(turned));
    Some(Shape::along(path).drawn(paper.line(0.7, [0xa8; 3])).into())
}

fn dot(mark: &MarkedPoint, frame: Frame) -> Option<Element> {
    let (paper, color) = (frame.paper, frame.paper.color(mark.role));
    if let Some((at, above)) = Marks::edge(mark.at, frame.window).filter(|_| mark.at_edge) {
        let ((x, y), half) = (frame.spot(at), 4.0 * paper.scale);
        let foot = y + if above { 2.0 * half } else { -2.0 * half };
        return Some(
            Shape::polygon([(x, y), (x - half, foot), (x + half, foot)]).solid(color).into(),
        );
    }
    let (x, y) = frame.spot(mark.at);
    let seen = x.is_finite() && y.is_finite() && near(mark.at.into(), frame);
    seen.then(|| spot(mark.mark, (x, y), color, &paper).into())
}

/// A mark at a place on paper.
pub fn spot(mark: Mark, (x, y): Spot, color: Color, paper: &PageLayout) -> Shape {
    let round = |radius: f64| Shape::circle((x, y), radius * paper.scale);
    let half = 3.0 * paper.scale;
    match mark {
        Mark::Rest => Shape::rectangle((x - half, y - half), (2.0 * half, 2.0 * half)).solid(color),
        Mark::Head | Mark::Stable => round(3.2).solid(color),
        Mark::Start | Mark::Turn | Mark::Unstable => {
            round(3.2).solid(WHITE).drawn(paper.line(1.2, color))
        }
        Mark::Outlier => {
            let mut path = PathBuilder::new();
            lead(&mut path, [(x - half, y - half), (x + half, y + half)]);
            lead(&mut path, [(x - half, y + half), (x + half, y - half)]);
            Shape::along(path).drawn(paper.line(1.4, color))
        }
        Mark::Saturated => {
            let corners = [(x - half, y), (x, y - half), (x + half, y), (x, y + half)];
            Shape::polygon(corners).solid(color)
        }
        Mark::Aside => round(1.2).solid(color),
    }
}
