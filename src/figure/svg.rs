//! A figure as SVG: every line a vector path, every letter text.

use std::fmt::Write;

use super::elements::{Anchor, circle, path, rectangle, text};
use super::paper::{self, ENTRY, Frame, HEAD, MARGIN, PANEL, PLOT, Spot, ink, shading, stroke};
use super::{Figure, MarkedPoint, Outline, Panel, areas::loops, captions, data::remarks, map};
use crate::numerics::{atan2, hypot, real, truncated};
use crate::picture::legend::distinct;
use crate::picture::{Dash, LegendEntry, LegendSample, Mark, Marks, ScanMap, Ticks, passes};
use crate::scene::Point;
use crate::words::printable::xml;

/// The whole figure as one picture.
pub fn svg(figure: &Figure) -> String {
    picture(figure, None)
}

/// Each panel as a picture of its own with its part of the legend, so that a page of any width can hold them.
pub fn panels(figure: &Figure) -> Vec<String> {
    let alone = |panel: &Panel| Figure {
        title: panel.title.clone(),
        panels: vec![panel.clone()],
        ..figure.clone()
    };
    (0..).zip(&figure.panels).map(|(place, panel)| picture(&alone(panel), Some(place))).collect()
}

/// A picture of all panels, or of the one that has this place on a page: it needs no title above its own, and the
/// names of its parts differ from those of the others.
fn picture(figure: &Figure, alone: Option<u32>) -> String {
    let panels = u32::try_from(figure.panels.len()).unwrap_or(u32::MAX).max(1);
    let columns = paper::columns(panels);
    let width = PANEL.0 * f64::from(columns);
    let below = HEAD + PANEL.1 * f64::from(panels.div_ceil(columns));
    let entries = legend(figure);
    let across = truncated(((width - 2.0 * MARGIN.1) / ENTRY.0).floor().max(1.0));
    let lines = real(entries.len().div_ceil(across));
    let maps = || figure.panels.iter().filter_map(|panel| panel.map.as_ref());
    let legend_height = lines * ENTRY.1;
    let above = if alone.is_some() { HEAD } else { 0.0 };
    let height = below + legend_height + real(maps().count()) * map::SCALE + 12.0 - above;
    let mut out = format!(
        include_str!("../../assets/figure.svg"),
        above = above,
        width = width,
        height = height,
        title = xml(&figure.title),
        remarks = xml(&remarks(figure).join("\n")),
    );
    if alone.is_none() {
        let spot = (width / 2.0, 22.0);
        text(&mut out, spot, Anchor::Middle, "font-size=\"14\"", &figure.title);
    }
    for (number, panel) in (0..).zip(&figure.panels) {
        draw(&mut out, alone.unwrap_or(number), panel, Frame::of(number, panels, panel.window));
    }
    for (number, entry) in entries.iter().enumerate() {
        let x = MARGIN.1 + real(number % across) * ENTRY.0;
        let y = below + real(number / across) * ENTRY.1 + 8.0;
        sample(&mut out, entry, (x, y));
    }
    for (number, shown) in maps().enumerate() {
        let y = below + legend_height + real(number) * map::SCALE;
        map::scale(&mut out, shown, (MARGIN.0, y));
    }
    out + "</svg>\n"
}

fn draw(out: &mut String, number: u32, panel: &Panel, frame: Frame) {
    let Frame { left, top, .. } = frame;
    let (width, height) = PLOT;
    let clip = format!("panel{number}");
    let _ = write!(
        out,
        "<clipPath id=\"{clip}\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" \
         height=\"{height}\"/></clipPath>\n<g clip-path=\"url(#{clip})\" fill=\"none\" \
         stroke-linejoin=\"round\">\n"
    );
    if let Some(shown) = &panel.map {
        map::draw(out, shown, frame);
    }
    // Parts of the same area are one path: between two paths a hair of paper would show.
    let alike = |one: &Outline, other: &Outline| (&one.name, one.role) == (&other.name, other.role);
    for same in panel.areas.chunk_by(alike) {
        shade(out, same, frame);
    }
    for (at, way) in &panel.arrows {
        arrow(out, *at, *way, frame);
    }
    for guide in &panel.guides {
        polyline(out, guide, "stroke=\"#b0b0b0\" stroke-width=\"0.6\"", frame);
    }
    for curve in &panel.curves {
        let dash = curve.style.unwrap_or(Dash::Solid);
        polyline(out, &curve.points, &stroke(curve.role, dash), frame);
    }
    for mark in &panel.marks {
        dot(out, mark, frame);
    }
    out.push_str("</g>\n");
    axes(out, panel, frame);
    captions::write(out, panel, frame);
}

/// A polyline with these attributes, run by run between points that are not finite. What lies far outside of the plot
/// is moved to where its lines still run where they ran, and left out where they cannot be seen.
fn polyline(out: &mut String, points: &[[f64; 2]], attributes: &str, frame: Frame) {
    let mut commands = String::new();
    let mut down = false;
    for (index, point) in points.iter().enumerate() {
        let around = &points[index.saturating_sub(1)..points.len().min(index + 2)];
        let seen = around.iter().any(|point| near(*point, frame));
        let drawn = seen && point.iter().all(|value| value.is_finite());
        if drawn {
            reach(&mut commands, down, *point, frame);
        }
        down = drawn;
    }
    if !commands.is_empty() {
        path(out, &commands, attributes);
    }
}

/// Leads a path to a point, or begins it there. Coordinates of paper have six digits; what is far outside keeps its side.
fn reach(commands: &mut String, down: bool, point: [f64; 2], frame: Frame) {
    let (across, along) = frame.spot(point.into());
    let (across, along) = (across.clamp(-1e5, 1e5), along.clamp(-1e5, 1e5));
    let command = if down { 'L' } else { 'M' };
    let _ = write!(commands, "{command}{across:.3} {along:.3}");
}

/// Whether a point lies within a few sizes of the plot.
fn near([x, y]: [f64; 2], frame: Frame) -> bool {
    let window = frame.window;
    (-3.0..=4.0).contains(&window.x.fraction(x)) && (-3.0..=4.0).contains(&window.y.fraction(y))
}

fn shade(out: &mut String, areas: &[Outline], frame: Frame) {
    let mut commands = String::new();
    for polygon in areas.iter().flat_map(|area| loops(&area.points, frame.window)) {
        for (index, point) in polygon.iter().enumerate() {
            reach(&mut commands, index > 0, *point, frame);
        }
        commands.push('Z');
    }
    path(out, &commands, &format!("{} fill-rule=\"evenodd\"", shading(areas[0].role)));
}

/// An arrow about a point of the world, which points a way in the world.
fn arrow(out: &mut String, at: Point, way: Point, frame: Frame) {
    let across = way.x * PLOT.0 / frame.window.x.width();
    let down = -way.y * PLOT.1 / frame.window.y.width();
    let length = hypot(across, down);
    if !(length.is_finite() && length > 0.0) {
        return;
    }
    let (x, y) = frame.spot(at);
    let angle = atan2(down, across).to_degrees();
    let turned = format!("transform=\"translate({x:.2} {y:.2}) rotate({angle:.1})\"");
    let attributes = format!("{turned} stroke=\"#a8a8a8\" stroke-width=\"0.7\"");
    path(out, "M-6 0H6M3 1.8L6 0L3 -1.8", &attributes);
}

fn dot(out: &mut String, mark: &MarkedPoint, frame: Frame) {
    let (_, color) = ink(mark.role);
    if let Some((at, above)) = Marks::edge(mark.at, frame.window).filter(|_| mark.at_edge) {
        let (x, y) = frame.spot(at);
        let down = if above { 8 } else { -8 };
        path(out, &format!("M{x:.2} {y:.2}l-4 {down}h8z"), &format!("fill=\"{color}\""));
        return;
    }
    let (x, y) = frame.spot(mark.at);
    if x.is_finite() && y.is_finite() && near(mark.at.into(), frame) {
        spot(out, mark.mark, (x, y), color);
    }
}

/// A mark at a place on paper.
fn spot(out: &mut String, mark: Mark, (x, y): Spot, color: &str) {
    let filled = format!("fill=\"{color}\"");
    match mark {
        Mark::Rest => rectangle(out, (x - 3.0, y - 3.0), (6.0, 6.0), &filled),
        Mark::Head | Mark::Stable => circle(out, (x, y), 3.2, &filled),
        Mark::Start | Mark::Turn | Mark::Unstable => {
            let hollow = format!("fill=\"#ffffff\" stroke=\"{color}\" stroke-width=\"1.2\"");
            circle(out, (x, y), 3.2, &hollow);
        }
        Mark::Outlier => {
            let cross = format!("M{x:.2} {y:.2}m-3 -3l6 6m-6 0l6 -6");
            path(out, &cross, &format!("stroke=\"{color}\" stroke-width=\"1.4\""));
        }
        Mark::Saturated => path(out, &format!("M{x:.2} {y:.2}m-3 0l3 -3l3 3l-3 3z"), &filled),
        Mark::Aside => circle(out, (x, y), 1.2, &filled),
    }
}

fn axes(out: &mut String, panel: &Panel, frame: Frame) {
    let Frame { left, top, window } = frame;
    let (width, height) = PLOT;
    let (right, bottom) = (left + width, top + height);
    let edge = "fill=\"none\" stroke=\"#222222\" stroke-width=\"0.9\"";
    rectangle(out, (left, top), PLOT, edge);
    let rightward = Ticks::on(panel.scales[0], window.x, |ticks| ticks.len() <= 7);
    let mut upward = Ticks::on(panel.scales[1], window.y, |ticks| ticks.len() <= 7);
    if panel.y.name.is_empty() {
        // What has no name is not a quantity: a place on paper, the number of a line.
        upward.ticks.clear();
    }
    let mut notches = String::new();
    for tick in &rightward.ticks {
        let x = left + tick.fraction * width;
        let _ = write!(notches, "M{x:.2} {bottom}v-5M{x:.2} {top}v5");
        text(out, (x, bottom + 17.0), Anchor::Middle, "", &tick.label);
    }
    for tick in &upward.ticks {
        let y = top + (1.0 - tick.fraction) * height;
        let _ = write!(notches, "M{left} {y:.2}h5M{right} {y:.2}h-5");
        text(out, (left - 8.0, y + 4.0), Anchor::End, "", &tick.label);
    }
    path(out, &notches, "stroke=\"#222222\" stroke-width=\"0.8\"");
    let (center, middle) = (left + width / 2.0, top + height / 2.0);
    let mut around = |x: f64, y: f64, attributes: &str, words: &str| {
        text(out, (x, y), Anchor::Middle, attributes, words);
    };
    around(center, top - 9.0, "font-size=\"12.5\"", &panel.title);
    let italic = "font-style=\"italic\"";
    around(center, bottom + 35.0, italic, &rightward.named(&panel.names[0]));
    let x = left - 46.0;
    let turned = format!("{italic} transform=\"rotate(-90 {x:.2} {middle:.2})\"");
    around(x, middle, &turned, &upward.named(&panel.names[1]));
    // Clause by clause, as none is wider than the plot.
    let clauses =
        panel.nothing.iter().flat_map(|sentence| sentence.split_inclusive([':', ';', ',']));
    for (line, clause) in clauses.enumerate() {
        around(center, middle + 16.0 * real(line), "", clause.trim());
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

fn sample(out: &mut String, LegendEntry { sample, role, text: name }: &LegendEntry, (x, y): Spot) {
    match sample {
        LegendSample::Point(mark) => spot(out, *mark, (x + 15.0, y), ink(*role).1),
        LegendSample::Line(dash) => {
            path(out, &format!("M{x:.1} {y:.1}h30"), &stroke(*role, *dash));
        }
        LegendSample::Shade | LegendSample::Spot | LegendSample::Arrow => {
            rectangle(out, (x, y - 5.0), (30.0, 10.0), &shading(*role));
        }
    }
    text(out, (x + 37.0, y + 4.0), Anchor::Start, "font-size=\"11\"", name);
}
