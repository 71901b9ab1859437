//! A figure as a page: its panels beside and above each other, the legend and the scales of maps below.

use tiny_skia_path::PathBuilder;

use super::elements::{
    Anchor, Color, Element, Page, PageUnit, Pen, Shape, Spot, TextLine, WHITE, lead, single,
};
use super::paper::{self, DARK, ENTRY, Frame, HEAD, MARGIN, PANEL, PLOT, ink, pen, shading};
use super::{Figure, MarkedPoint, Outline, Panel, areas::loops, captions, map};
use crate::numerics::{atan2, hypot, real, sin_cos, truncated};
use crate::picture::legend::distinct;
use crate::picture::{Dash, LegendEntry, LegendSample, Mark, Marks, ScanMap, Ticks, passes};
use crate::scene::Point;

/// A page of all panels, below a title.
pub fn page(figure: &Figure) -> Page {
    let (panels, columns) = (count(figure), paper::columns(count(figure)));
    let mut out = Vec::new();
    let width = PANEL.0 * f64::from(columns);
    out.push(TextLine::new((width / 2.0, 22.0), Anchor::Middle, 14.0, &figure.title).into());
    for (number, panel) in (0..).zip(&figure.panels) {
        draw(&mut out, panel, Frame::of(number, columns, HEAD, panel.window));
    }
    let rows = f64::from(panels.div_ceil(columns));
    finished(figure, out, (width, HEAD + PANEL.1 * rows))
}

/// A page of the only panel of a figure, which needs no title above its own.
pub fn alone(figure: &Figure) -> Page {
    let mut out = Vec::new();
    for panel in &figure.panels {
        draw(&mut out, panel, Frame::of(0, 1, 0.0, panel.window));
    }
    finished(figure, out, PANEL)
}

fn count(figure: &Figure) -> u32 {
    u32::try_from(figure.panels.len()).unwrap_or(u32::MAX).max(1)
}

/// A page with these panels, which take this much room, and with the legend and the scales of maps below.
fn finished(figure: &Figure, mut out: Vec<Element>, (width, mut height): Spot) -> Page {
    let across = truncated(((width - 2.0 * MARGIN.1) / ENTRY.0).floor().max(1.0));
    let entries = legend(figure);
    for (number, entry) in entries.iter().enumerate() {
        let x = MARGIN.1 + real(number % across) * ENTRY.0;
        let y = height + real(number / across) * ENTRY.1 + 8.0;
        sample(&mut out, entry, (x, y));
    }
    height += real(entries.len().div_ceil(across)) * ENTRY.1;
    for shown in figure.panels.iter().filter_map(|panel| panel.map.as_ref()) {
        map::scale(&mut out, shown, (MARGIN.0, height));
        height += map::SCALE;
    }
    Page { size: (width, height + 12.0), unit: PageUnit::Pixel, elements: out }
}

fn draw(out: &mut Vec<Element>, panel: &Panel, frame: Frame) {
    let mut inside = Vec::new();
    if let Some(shown) = &panel.map {
        inside.extend(map::cells(shown, frame));
    }
    // Parts of the same area are one path: between two paths a hair of paper would show.
    let alike = |one: &Outline, other: &Outline| (&one.name, one.role) == (&other.name, other.role);
    for same in panel.areas.chunk_by(alike) {
        inside.push(shade(same, frame).into());
    }
    inside.extend(panel.arrows.iter().filter_map(|(at, way)| arrow(*at, *way, frame)));
    for guide in &panel.guides {
        inside.extend(polyline(guide, Pen::solid(0.6, [0xb0; 3]), frame));
    }
    for curve in &panel.curves {
        inside.extend(polyline(
            &curve.points,
            pen(curve.role, curve.style.unwrap_or(Dash::Solid)),
            frame,
        ));
    }
    inside.extend(panel.marks.iter().filter_map(|mark| dot(mark, frame)));
    out.push(Element::Clipped((frame.left, frame.top), PLOT, inside));
    axes(out, panel, frame);
    captions::write(out, panel, frame);
}

/// A polyline, run by run between points that are not finite, if any of it is seen. What lies far outside of the plot is
/// moved to where its lines still run where they ran, and left out where they cannot be seen.
fn polyline(points: &[[f64; 2]], pen: Pen, frame: Frame) -> Option<Element> {
    let mut path = PathBuilder::new();
    let mut down = false;
    for (index, point) in points.iter().enumerate() {
        let around = &points[index.saturating_sub(1)..points.len().min(index + 2)];
        let seen = around.iter().any(|point| near(*point, frame));
        let drawn = seen && point.iter().all(|value| value.is_finite());
        if drawn {
            let (x, y) = reached(*point, frame);
            let (x, y) = (single(x), single(y));
            if down { path.line_to(x, y) } else { path.move_to(x, y) }
        }
        down = drawn;
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
        lead(&mut path, polygon.into_iter().map(|point| reached(point, frame)));
        path.close();
    }
    Shape::along(path).filled(shading(areas[0].role))
}

/// An arrow about a point of the world, which points a way in the world.
fn arrow(at: Point, way: Point, frame: Frame) -> Option<Element> {
    let across = way.x * PLOT.0 / frame.window.x.width();
    let down = -way.y * PLOT.1 / frame.window.y.width();
    let length = hypot(across, down);
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    let (x, y) = frame.spot(at);
    let (sin, cos) = sin_cos(atan2(down, across));
    let turned =
        |(along, aside): Spot| (x + along * cos - aside * sin, y + along * sin + aside * cos);
    let mut path = PathBuilder::new();
    lead(&mut path, [(-6.0, 0.0), (6.0, 0.0)].map(turned));
    lead(&mut path, [(3.0, 1.8), (6.0, 0.0), (3.0, -1.8)].map(turned));
    Some(Shape::along(path).drawn(Pen::solid(0.7, [0xa8; 3])).into())
}

fn dot(mark: &MarkedPoint, frame: Frame) -> Option<Element> {
    let (_, color) = ink(mark.role);
    if let Some((at, above)) = Marks::edge(mark.at, frame.window).filter(|_| mark.at_edge) {
        let (x, y) = frame.spot(at);
        let foot = y + if above { 8.0 } else { -8.0 };
        return Some(
            Shape::polygon([(x, y), (x - 4.0, foot), (x + 4.0, foot)]).solid(color).into(),
        );
    }
    let (x, y) = frame.spot(mark.at);
    let seen = x.is_finite() && y.is_finite() && near(mark.at.into(), frame);
    seen.then(|| spot(mark.mark, (x, y), color).into())
}

/// A mark at a place on paper.
fn spot(mark: Mark, (x, y): Spot, color: Color) -> Shape {
    let round = |radius: f64| Shape::circle((x, y), radius);
    match mark {
        Mark::Rest => Shape::rectangle((x - 3.0, y - 3.0), (6.0, 6.0)).solid(color),
        Mark::Head | Mark::Stable => round(3.2).solid(color),
        Mark::Start | Mark::Turn | Mark::Unstable => {
            round(3.2).solid(WHITE).drawn(Pen::solid(1.2, color))
        }
        Mark::Outlier => {
            let mut path = PathBuilder::new();
            lead(&mut path, [(x - 3.0, y - 3.0), (x + 3.0, y + 3.0)]);
            lead(&mut path, [(x - 3.0, y + 3.0), (x + 3.0, y - 3.0)]);
            Shape::along(path).drawn(Pen::solid(1.4, color))
        }
        Mark::Saturated => {
            let corners = [(x - 3.0, y), (x, y - 3.0), (x + 3.0, y), (x, y + 3.0)];
            Shape::polygon(corners).solid(color)
        }
        Mark::Aside => round(1.2).solid(color),
    }
}

/// Size of letters at axes.
const LETTERS: f64 = 12.0;

fn axes(out: &mut Vec<Element>, panel: &Panel, frame: Frame) {
    let Frame { left, top, window } = frame;
    let (width, height) = PLOT;
    let (right, bottom) = (left + width, top + height);
    out.push(Shape::rectangle((left, top), PLOT).drawn(Pen::solid(0.9, DARK)).into());
    let rightward = Ticks::on(panel.scales[0], window.x, |ticks| ticks.len() <= 7);
    let mut upward = Ticks::on(panel.scales[1], window.y, |ticks| ticks.len() <= 7);
    if panel.y.name.is_empty() {
        // What has no name is not a quantity: a place on paper, the number of a line.
        upward.ticks.clear();
    }
    let mut notches = PathBuilder::new();
    let mut notch = |from: Spot, to: Spot| lead(&mut notches, [from, to]);
    for tick in &rightward.ticks {
        let x = left + tick.fraction * width;
        notch((x, bottom), (x, bottom - 5.0));
        notch((x, top), (x, top + 5.0));
        out.push(TextLine::new((x, bottom + 17.0), Anchor::Middle, LETTERS, &tick.label).into());
    }
    for tick in &upward.ticks {
        let y = top + (1.0 - tick.fraction) * height;
        notch((left, y), (left + 5.0, y));
        notch((right, y), (right - 5.0, y));
        out.push(TextLine::new((left - 8.0, y + 4.0), Anchor::End, LETTERS, &tick.label).into());
    }
    out.push(Shape::along(notches).drawn(Pen::solid(0.8, DARK)).into());
    let (center, middle) = (left + width / 2.0, top + height / 2.0);
    let around = |at: Spot, size: f64, text: &str| TextLine::new(at, Anchor::Middle, size, text);
    out.push(around((center, top - 9.0), 12.5, &panel.title).into());
    let names = [rightward.named(&panel.names[0]), upward.named(&panel.names[1])];
    out.push(around((center, bottom + 35.0), LETTERS, &names[0]).into());
    let beside = around((left - 46.0, middle), LETTERS, &names[1]);
    out.push(TextLine { upward: true, ..beside }.into());
    // Clause by clause, as none is wider than the plot.
    let clauses =
        panel.nothing.iter().flat_map(|sentence| sentence.split_inclusive([':', ';', ',']));
    for (line, clause) in clauses.enumerate() {
        out.push(around((center, middle + 16.0 * real(line)), LETTERS, clause.trim()).into());
    }
}

/// Everything with a name that is seen, once, lines before areas; which of several variants a curve is stands beside it.
fn legend(figure: &Figure) -> Vec<LegendEntry> {
    let entry = |text: &str, role, sample| LegendEntry { sample, role, text: text.to_owned() };
    let of_panel = |panel: &Panel| {
        let is_seen = |curve: &&Outline| passes(&Point::all(&curve.points), panel.window);
        let seen = panel.curves.iter().filter(is_seen);
        let lines = seen.chain(&panel.areas).map(|it| {
            entry(&it.kind, it.role, it.style.map_or(LegendSample::Shade, LegendSample::Line))
        });
        let words = panel.map.iter().flat_map(ScanMap::words);
        let words = words.map(|word| entry(word, map::role(word), LegendSample::Shade));
        let dropped = [Mark::Outlier, Mark::Saturated, Mark::Aside];
        let marks = panel.marks.iter().filter(|it| dropped.contains(&it.mark));
        let marks = marks.map(|it| entry(&it.name, it.role, LegendSample::Point(it.mark)));
        lines.chain(words).chain(marks).collect::<Vec<_>>()
    };
    distinct(figure.panels.iter().flat_map(of_panel))
}

/// What stands before its name in the legend, and the name.
fn sample(out: &mut Vec<Element>, entry: &LegendEntry, (x, y): Spot) {
    let LegendEntry { sample, role, text } = entry;
    let shape = match sample {
        LegendSample::Point(mark) => spot(*mark, (x + 15.0, y), ink(*role).1),
        LegendSample::Line(dash) => Shape::line([(x, y), (x + 30.0, y)]).drawn(pen(*role, *dash)),
        LegendSample::Shade | LegendSample::Spot | LegendSample::Arrow => {
            Shape::rectangle((x, y - 5.0), (30.0, 10.0)).filled(shading(*role))
        }
    };
    out.push(shape.into());
    out.push(TextLine::new((x + 37.0, y + 4.0), Anchor::Start, 11.0, text).into());
}
