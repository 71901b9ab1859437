//! A map and its scale as SVG: cells of one hue, the stronger the more dangerous.

use super::elements::{Anchor, path, text};
use super::paper::{Frame, PLOT, Spot, shading};
use crate::numerics::{real, truncated};
use crate::picture::{Danger, MapCell, Role, ScanMap};
use crate::scene::Point;
use crate::words::significant;

/// Height of the scale of a map with its name and its numbers, in pixels.
pub const SCALE: f64 = 54.0;

/// Steps of the scale.
const STEPS: usize = 32;

/// Red, green and blue of the weakest and of the strongest step.
const ENDS: [[f64; 3]; 2] = [[253.0, 246.0, 233.0], [122.0, 59.0, 0.0]];

/// What a word on a map stands for, as far as its colour goes.
pub fn role(word: &str) -> Role {
    match word {
        "every kick survived" | "captured" => Role::Safe,
        "moving" => Role::Danger,
        "escaped" => Role::Failure,
        _ => Role::Field,
    }
}

/// The attributes of a cell.
fn paint(cell: MapCell, scale: Option<Danger>) -> String {
    match (cell, scale) {
        (MapCell::Number(value), Some(scale)) => color(scale.strength(scale.part(value))),
        (MapCell::Number(_), None) => "fill=\"none\"".to_owned(),
        (MapCell::Word(word), _) => shading(role(word)),
    }
}

/// The attributes of a strength from 0 to 1: the colour of one of the steps.
fn color(strength: f64) -> String {
    let step = truncated(strength * real(STEPS)).min(STEPS - 1);
    let part = real(step) / real(STEPS - 1);
    let [weak, strong] = ENDS;
    let mixed =
        [0, 1, 2].map(|index| truncated(weak[index] + part * (strong[index] - weak[index])));
    format!("fill=\"#{:02x}{:02x}{:02x}\" fill-opacity=\"1\"", mixed[0], mixed[1], mixed[2])
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

/// Draws the cells, equal neighbours above each other as one.
pub fn draw(out: &mut String, map: &ScanMap, frame: Frame) {
    let (across, upward) = (borders(&map.x), borders(&map.y));
    out.push_str("<g shape-rendering=\"crispEdges\" stroke=\"none\">\n");
    for (column, cells) in across.windows(2).zip(&map.values) {
        let mut row = 0;
        for same in cells.chunk_by(|one, other| paint(*one, map.scale) == paint(*other, map.scale))
        {
            let (low, high) = (upward[row], upward[row + same.len()]);
            row += same.len();
            let (left, bottom) = frame.spot(Point { x: column[0], y: low });
            let (right, top) = frame.spot(Point { x: column[1], y: high });
            let cell = format!("M{left:.2} {bottom:.2}H{right:.2}V{top:.2}H{left:.2}Z");
            path(out, &cell, &paint(same[0], map.scale));
        }
    }
    out.push_str("</g>\n");
}

/// Draws the scale at a place, if the map has numbers: what is measured, the colours, and the numbers that they
/// stand for.
pub fn scale(out: &mut String, map: &ScanMap, (x, y): Spot) {
    let Some(scale) = map.scale else { return };
    let (width, top) = (PLOT.0, y + 20.0);
    text(out, (x + width / 2.0, y + 14.0), Anchor::Middle, "font-size=\"11\"", &map.name);
    out.push_str("<g shape-rendering=\"crispEdges\" stroke=\"none\">\n");
    for step in 0..STEPS {
        let [from, to] = [step, step + 1].map(|edge| x + width * real(edge) / real(STEPS));
        let fill = color(scale.strength((real(step) + 0.5) / real(STEPS)));
        path(out, &format!("M{from:.2} {top}H{to:.2}v10H{from:.2}Z"), &fill);
    }
    out.push_str("</g>\n");
    let [lowest, highest] = scale.ends();
    let ends =
        [(0.0, Anchor::Start, lowest), (0.5, Anchor::Middle, ""), (1.0, Anchor::End, highest)];
    for (part, anchor, end) in ends {
        let value = significant(scale.at(part), 4);
        let words = if end.is_empty() {
            value
        } else {
            format!("{value} ({end})")
        };
        text(out, (x + part * width, top + 22.0), anchor, "font-size=\"10\"", &words);
    }
}
