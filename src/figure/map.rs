//! A map and its scale on paper: cells of one hue, the stronger the more dangerous.

use super::elements::{Anchor, Element, PlotPen, Shape, Spot, TextLine, Tint};
use super::paper::{Frame, PageLayout};
use crate::numerics::{real, truncated};
use crate::picture::{Danger, MapCell, Role, ScanMap};
use crate::scene::Point;
use crate::words::significant;

/// Height of the scale of a map with its name and its numbers, in pixels.
pub const SCALE: f64 = 54.0;

/// Steps of the scale.
const STEPS: usize = 32;

/// Red, green and blue of the weakest and of the strongest step, in colour and in shades of grey.
const ENDS: [[f64; 3]; 2] = [[253.0, 246.0, 233.0], [122.0, 59.0, 0.0]];
const GREYS: [[f64; 3]; 2] = [[247.0; 3], [64.0; 3]];

/// What a word on a map stands for, as far as its colour goes.
pub fn role(word: &str) -> Role {
    match word {
        "every kick survived" | "captured" => Role::Safe,
        "moving" => Role::Danger,
        "escaped" => Role::Failure,
        _ => Role::Field,
    }
}

/// How a cell is filled; nothing where it has a number and there is no scale.
fn paint(cell: MapCell, scale: Option<Danger>, paper: &PageLayout) -> Option<Tint> {
    match (cell, scale) {
        (MapCell::Number(value), scale) => scale.map(|it| tint(it.strength(it.part(value)), paper)),
        (MapCell::Word(word), _) => Some(paper.shading(role(word))),
    }
}

/// The colour of a strength from 0 to 1: one of the steps.
fn tint(strength: f64, paper: &PageLayout) -> Tint {
    let step = truncated(strength * real(STEPS)).min(STEPS - 1);
    let part = real(step) / real(STEPS - 1);
    let [weak, strong] = if paper.grey { GREYS } else { ENDS };
    let mixed = |index: usize| truncated(weak[index] + part * (strong[index] - weak[index]));
    let color = [0, 1, 2].map(|index| u8::try_from(mixed(index)).unwrap_or(u8::MAX));
    Tint { color, opacity: 1.0 }
}

/// A cell with a hair of its colour around it: between two smooth edges the paper would show.
fn covered(cell: Shape, tint: Tint) -> Shape {
    // A colour through which one sees would be darker along these hairs.
    let tint = tint.on_white();
    cell.filled(tint).drawn(PlotPen::solid(0.3, tint.color))
}

/// The borders of cells around these places: in the middle between neighbours, and as far beyond the ends.
fn borders(places: &[f64]) -> Vec<f64> {
    let [first, second, ..] = places else { return Vec::new() };
    let (last, before) = (places[places.len() - 1], places[places.len() - 2]);
    let between = places.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
    std::iter::once(first - 0.5 * (second - first))
        .chain(between)
        .chain([last + 0.5 * (last - before)])
        .collect()
}

/// The cells, equal neighbours above each other as one.
pub fn cells(map: &ScanMap, frame: Frame) -> Vec<Element> {
    let (across, upward) = (borders(&map.x), borders(&map.y));
    let mut shapes = Vec::new();
    for (column, cells) in across.windows(2).zip(&map.values) {
        let mut row = 0;
        let paint = |cell: &MapCell| paint(*cell, map.scale, &frame.paper);
        for same in cells.chunk_by(|one, other| paint(one) == paint(other)) {
            let (low, high) = (upward[row], upward[row + same.len()]);
            row += same.len();
            let (left, bottom) = frame.spot(Point { x: column[0], y: low });
            let (right, top) = frame.spot(Point { x: column[1], y: high });
            let cell = Shape::rectangle((left, top), (right - left, bottom - top));
            shapes.extend(paint(&same[0]).map(|tint| covered(cell, tint).into()));
        }
    }
    shapes
}

/// Draws the scale at a place, if the map has numbers: what is measured, the colours, and the numbers that they
/// stand for.
pub fn scale(out: &mut Vec<Element>, map: &ScanMap, (x, y): Spot, paper: &PageLayout) {
    let Some(danger) = map.scale else { return };
    let (width, scale) = (paper.plot.0, paper.scale);
    let top = y + 20.0 * scale;
    let at = (x + width / 2.0, y + 14.0 * scale);
    let name = TextLine::new(at, Anchor::Middle, 11.0 * scale, &map.name);
    let step = |step: usize| {
        let [from, to] = [step, step + 1].map(|edge| x + width * real(edge) / real(STEPS));
        let strength = danger.strength((real(step) + 0.5) / real(STEPS));
        let cell = Shape::rectangle((from, top), (to - from, 10.0 * scale));
        covered(cell, tint(strength, paper)).into()
    };
    out.push(name.into());
    out.extend((0..STEPS).map(step));
    let [lowest, highest] = danger.ends();
    let ends =
        [(0.0, Anchor::Start, lowest), (0.5, Anchor::Middle, ""), (1.0, Anchor::End, highest)];
    for (part, anchor, end) in ends {
        let value = significant(danger.at(part), 4);
        let words = if end.is_empty() {
            value
        } else {
            format!("{value} ({end})")
        };
        let at = (x + part * width, top + 22.0 * scale);
        out.push(TextLine::new(at, anchor, 10.0 * scale, &words).into());
    }
}
