//! Level curves: their points, and where they end.

use super::{About, Answer, Columns, Document, Quantity};
use crate::model::Knob;
use crate::picture::map::absence;
use crate::scan::{LevelCurve, LevelEnd, LevelTarget, Levels, Scan};
use crate::words::joined;
use crate::words::level::nowhere;

/// A curve by its number, and one of its points.
type PointRow = (usize, [f64; 2]);

/// The curves of a scan over two numbers, one row for each point; below them in text, where each ends.
pub fn level(
    about: About,
    scan: &Scan,
    target: LevelTarget,
    (found, seconds): &(Levels, f64),
) -> Answer {
    let knobs: Vec<Knob> = scan.over().iter().map(|sweep| sweep.symbol).collect();
    let mut columns = Columns::default().word("curve", |row: &PointRow| row.0);
    for (axis, (name, knob)) in ["x", "y"].into_iter().zip(&knobs).enumerate() {
        let quantity = Quantity::of(knob.spec().unit, 12);
        columns = columns
            .file(name, move |row: &PointRow| row.1[axis])
            .text(knob.spec().name, move |row: &PointRow| quantity.text(row.1[axis]));
    }
    let numbered = || (1_usize..).zip(&found.curves);
    let rows = numbered().flat_map(|(number, it)| it.points.iter().map(move |at| (number, *at)));
    let ends = |it: &LevelCurve| it.ends.map(|ends| ends.map(|end| word(end, target)));
    let document = |curve: &LevelCurve| {
        Document::of("points", &curve.points)
            .with("closed", curve.ends.is_none())
            .with("ends", ends(curve))
            .with("step", curve.step)
    };
    let sentence = |(number, curve): (usize, &LevelCurve)| match ends(curve) {
        Some(ends) => format!("curve {number} ends: {}", joined(ends, " and ")),
        None => format!("curve {number} is closed"),
    };
    about
        .but(&knobs)
        .answer()
        .with("of", target)
        .with("over", knobs)
        .with("curves", found.curves.iter().map(document).collect::<Vec<_>>())
        .with("seen", found.seen)
        .rows(&columns, rows)
        .lines(numbered().map(sentence))
        .lines(nowhere(target, found))
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
