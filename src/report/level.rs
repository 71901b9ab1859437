//! Level curves: their points, and where they end.

use super::{About, Answer, Columns, Document, Quantity};
use crate::model::Knob;
use crate::picture::map::absence;
use crate::scan::{LevelCurve, LevelEnd, LevelTarget, Levels, Scan};
use crate::words::{counted, joined, significant};

/// A curve by its number, and one of its points.
type PointRow = (usize, [f64; 2]);

/// The curves of a scan over two numbers, one row for each point; below them in text, where each ends.
pub fn level(
    about: About,
    scan: &Scan,
    target: LevelTarget,
    (found, seconds): &(Levels, f64),
) -> Answer {
    /// A part of the value below which a jump across a curve is rounding.
    const ROUNDING: f64 = 1e-6;
    let knobs: Vec<Knob> = scan.over().iter().map(|sweep| sweep.symbol).collect();
    let columns = ["x", "y"].into_iter().zip(&knobs).enumerate().fold(
        Columns::default().text("curve", |row: &PointRow| row.0).file("curve", |row| row.0),
        |columns, (axis, (name, knob))| {
            let quantity = Quantity::of(knob.spec().unit, 12);
            let shown = move |row: &PointRow| quantity.text(row.1[axis]);
            columns.file(name, move |row| row.1[axis]).text(knob.spec().name, shown)
        },
    );
    let numbered = || (1_usize..).zip(&found.curves);
    let rows = numbered().flat_map(|(number, it)| it.points.iter().map(move |at| (number, *at)));
    let document = |curve: &LevelCurve| {
        Document::of("points", &curve.points)
            .with("closed", curve.ends.is_none())
            .with("ends", curve.ends.map(|ends| ends.map(|end| word(end, target))))
            .with("step", curve.step)
    };
    let sentence = |(number, curve): (usize, &LevelCurve)| {
        let ends = curve.ends.map(|ends| joined(ends.map(|end| word(end, target)), " and "));
        let course = ends.map_or_else(|| "closed".to_owned(), |ends| format!("ends: {ends}"));
        let jumps = curve.step > ROUNDING * target.value.abs();
        let step =
            jumps.then(|| format!("jumps by up to {} across it", significant(curve.step, 3)));
        let points = counted(curve.points.len(), "point");
        let parts = [format!("curve {number}: {points}"), course].into_iter().chain(step);
        joined(parts, ", ")
    };
    let nowhere = found.curves.is_empty().then(|| match found.seen {
        Some([low, high]) => {
            let [low, high] = [low, high].map(|end| significant(end, 6));
            format!("no curve {target}: {} is {low} .. {high} on it", target.column)
        }
        None => format!("no curve {target}: {} has no number on it", target.column),
    });
    about
        .but(&knobs)
        .answer()
        .with("of", target)
        .with("over", knobs)
        .with("curves", found.curves.iter().map(document).collect::<Vec<_>>())
        .with("seen", found.seen)
        .rows(&columns, rows)
        .lines(numbered().map(sentence))
        .lines(nowhere)
        .cost(found.cost, *seconds)
}

/// What is beyond an end.
fn word(end: LevelEnd, target: LevelTarget) -> &'static str {
    match end {
        LevelEnd::Edge => "edge",
        LevelEnd::Ceases => absence(target.column),
        LevelEnd::Unknown => "unknown",
    }
}
