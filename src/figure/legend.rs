//! What the lines, areas and marks of a figure are: below its panels or within them.

use super::captions::Surroundings;
use super::elements::{Anchor, Element, Shape, Spot, TextLine, Tint, WHITE};
use super::panel::spot;
use super::paper::{LEGEND, PageLayout};
use super::{Figure, Outline, Panel, map};
use crate::numerics::real;
use crate::picture::legend::distinct;
use crate::picture::{LegendEntry, LegendSample, Mark, ScanMap, passes};
use crate::scene::Point;

/// Length of a sample, how far behind its start its name begins, and the height of a line.
const SAMPLE: f64 = 26.0;
const NAME: f64 = 32.0;
const ROW: f64 = 18.0;

/// What each panel has to explain that those before it have not: everything with a name that is seen, lines before areas;
/// which of several variants a curve is stands beside it.
pub fn of(figure: &Figure) -> Vec<Vec<LegendEntry>> {
    let mut known: Vec<LegendEntry> = Vec::new();
    let is_printed = figure.sheet.points().is_some();
    let mut new = |panel: &Panel| {
        let before = known.len();
        known = distinct(known.drain(..).chain(explained(panel, is_printed)));
        known[before..].to_vec()
    };
    figure.panels.iter().map(&mut new).collect()
}

fn explained(panel: &Panel, is_printed: bool) -> Vec<LegendEntry> {
    let entry = |text: &str, role, sample| LegendEntry { sample, role, text: text.to_owned() };
    let is_seen = |curve: &&Outline| passes(&Point::all(&curve.points), panel.window);
    let seen = panel.curves.iter().filter(is_seen);
    // A journal has no room for what has its name beside it, nor for a bar that has no length.
    let is_line = |points: &[[f64; 2]]| !matches!(points, [from, to] if from == to);
    let is_told = |it: &&Outline| !is_printed || (!it.captioned && is_line(&it.points));
    let told = seen.chain(&panel.areas).filter(is_told);
    let lines = told.map(|it| {
        entry(&it.kind, it.role, it.style.map_or(LegendSample::Shade, LegendSample::Line))
    });
    let words = panel.map.iter().flat_map(ScanMap::words);
    let words = words.map(|word| entry(word, map::role(word), LegendSample::Shade));
    let dropped = [Mark::Outlier, Mark::Saturated, Mark::Aside];
    let marks = panel.marks.iter().filter(|it| dropped.contains(&it.mark));
    let marks = marks.map(|it| entry(&it.name, it.role, LegendSample::Point(it.mark)));
    lines.chain(words).chain(marks).collect()
}

/// Width of the widest of these entries.
fn widest<'a>(entries: impl Iterator<Item = &'a LegendEntry>, paper: &PageLayout) -> f64 {
    let widths = entries.map(|entry| paper.width(&entry.text, LEGEND));
    NAME * paper.scale + widths.fold(0.0, f64::max)
}

/// Writes a legend into as many columns as fit a page of this width below this height. How high it is.
pub fn below(
    out: &mut Vec<Element>,
    entries: &[LegendEntry],
    (width, top): Spot,
    paper: &PageLayout,
) -> f64 {
    let (row, edge) = (ROW * paper.scale, 10.0 * paper.scale);
    // Each column is as wide as its entries; what is left is shared.
    let widths = |count: usize| -> Vec<f64> {
        let entries = |first| entries.iter().skip(first).step_by(count);
        (0..count).map(|first| edge + widest(entries(first), paper)).collect()
    };
    let left = |count: usize| width - edge - widths(count).iter().sum::<f64>();
    let columns = (1..=entries.len()).rev().find(|count| left(*count) >= 0.0).unwrap_or(1);
    let (widths, apart) = (widths(columns), left(columns).max(0.0) / real(columns));
    for (number, entry) in entries.iter().enumerate() {
        let column = number % columns;
        let x = edge + widths[..column].iter().sum::<f64>() + apart * real(column);
        let y = top + (real(number / columns) + 0.45) * row;
        sample(out, entry, (x, y), paper);
    }
    real(entries.len().div_ceil(columns)) * row
}

/// Writes a legend where it covers no curve of a plot. What is left where there is no such place.
pub fn inside(
    out: &mut Vec<Element>,
    entries: Vec<LegendEntry>,
    surroundings: &mut Surroundings,
    paper: &PageLayout,
) -> Vec<LegendEntry> {
    let (row, edge) = (15.0 * paper.scale, 5.0 * paper.scale);
    let width = widest(entries.iter(), paper) + 2.0 * edge;
    let size = (width, real(entries.len()) * row + 4.0 * paper.scale);
    let is_needed = !entries.is_empty();
    let Some((left, top)) = is_needed.then(|| surroundings.room(size)).flatten() else {
        return entries;
    };
    let tint = Tint { color: WHITE, opacity: 0.8 };
    out.push(Shape::rectangle((left, top), size).filled(tint).into());
    for (number, entry) in entries.iter().enumerate() {
        let y = top + 2.0 * paper.scale + (real(number) + 0.5) * row;
        sample(out, entry, (left + edge, y), paper);
    }
    Vec::new()
}

/// What stands before its name in the legend, and the name.
fn sample(out: &mut Vec<Element>, entry: &LegendEntry, (x, y): Spot, paper: &PageLayout) {
    let LegendEntry { sample, role, text } = entry;
    let (scale, long) = (paper.scale, SAMPLE * paper.scale);
    let shape = match sample {
        LegendSample::Point(mark) => spot(*mark, (x + 0.5 * long, y), paper.color(*role), paper),
        LegendSample::Line(dash) => {
            Shape::line([(x, y), (x + long, y)]).drawn(paper.pen(*role, *dash))
        }
        LegendSample::Shade | LegendSample::Spot | LegendSample::Arrow => {
            Shape::rectangle((x, y - 5.0 * scale), (long, 10.0 * scale))
                .filled(paper.shading(*role).on_white())
        }
    };
    out.push(shape.into());
    let at = (x + NAME * scale, y + 4.0 * scale);
    out.push(TextLine::new(at, Anchor::Start, LEGEND * scale, text).into());
}
