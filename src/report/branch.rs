//! The cycles as a parameter varies, and the special points.

use super::certified::{decided, piece_columns};
use super::columns::{Columns, Quantity};
use super::cycle_numbers::{cycle_fields, number_columns};
use super::json::Document;
use super::table::{cost, digits, parameters};
use crate::branch::{Branch, BranchPoint, Special};
use crate::model::Parameters;
use crate::proof::range::{Range, RangePiece};
use crate::words::number::significant;
use crate::words::stability;

/// A point with the number of the connected piece to which it belongs, or a part of the range of which something is
/// proved.
enum PieceRow<'a> {
    Point(usize, &'a BranchPoint),
    Proved(&'a RangePiece),
}

impl<'a> PieceRow<'a> {
    fn proved(&self) -> Option<&'a RangePiece> {
        if let PieceRow::Proved(piece) = self { Some(piece) } else { None }
    }

    /// Something of a point.
    fn of<T>(&self, part: impl Fn(usize, &BranchPoint) -> T) -> Option<T> {
        if let PieceRow::Point(piece, point) = self { Some(part(*piece, point)) } else { None }
    }
}

/// The columns of points; `value` names the number that varies.
fn columns<'a>(value: &str) -> Columns<'a, PieceRow<'a>> {
    Columns::default()
        .file("piece", |row: &PieceRow| row.of(|piece, _| piece))
        .file(value, |row| row.of(|_, point| point.value))
        .and(cycle_fields(|row: &PieceRow| row.of(|_, point| point.cycle)))
}

fn rows(branch: &Branch) -> impl Iterator<Item = PieceRow<'_>> {
    let pieces = branch.pieces.iter().enumerate();
    pieces.flat_map(|(piece, points)| points.iter().map(move |it| PieceRow::Point(piece, it)))
}

pub fn json(branch: &Branch, certified: Option<&Range>, seconds: f64) -> String {
    Document::default()
        .with("parameter", branch.parameter)
        .with("points", columns("value").objects(rows(branch)))
        .with("special", &branch.special)
        .with("vague", &branch.vague)
        .with_any("certified", certified.map(decided))
        .cost(&branch.cost, seconds)
        .text()
}

/// One row for each point, and for each part of the range in which the number of cycles is proved or open.
pub fn csv(branch: &Branch, certified: Option<&Range>) -> String {
    let name = branch.parameter.spec().name;
    let proved = certified.map(|range| {
        Columns::default().part("certified", piece_columns(range, name), PieceRow::proved)
    });
    let parts = certified.iter().flat_map(|range| &range.pieces).map(PieceRow::Proved);
    columns(name).and(proved).csv(rows(branch).chain(parts))
}

/// A table for each connected piece, then the special points.
pub fn table(branch: &Branch, base: &Parameters, tolerance: f64, seconds: f64) -> String {
    let places = digits(tolerance).min(10);
    let name = branch.parameter.spec().name;
    let columns = Columns::default()
        .text(name, |point: &&BranchPoint| significant(point.value, places))
        .text("cycle", |point| stability(point.cycle.stable).to_owned());
    let columns = number_columns(columns, |point, number| number.text(&point.cycle, places));
    let mut out = format!("{}\n", parameters(base, Some(branch.parameter)));
    for (number, piece) in branch.pieces.iter().enumerate() {
        out += &format!("\npiece {}\n", number + 1);
        out += &columns.table(piece).to_string();
    }
    if branch.pieces.is_empty() {
        out += "\nno limit cycle\n";
    }
    let number = Quantity::pure(digits(tolerance));
    let special = Columns::default()
        .text("special point", |it: &&Special| it.kind.name(it.cycle.as_ref()).to_owned())
        .number(name, number, |it| it.value)
        .number("q_max", number, |it| it.q_max)
        .table(&branch.special);
    if !special.is_empty() {
        out += &format!("\n{special}");
    }
    if let (Some(&first), Some(&last)) = (branch.vague.first(), branch.vague.last()) {
        let [first, last] = [first, last].map(|value| significant(value, 6));
        let count = branch.vague.len();
        out += &format!("\nleft out, too vague: {count}, {name} = {first} .. {last}\n");
    }
    out + "\n" + &cost(branch.cost, seconds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::SpecialKind;
    use crate::closed_form::piecewise_linear::LinearCycle;
    use crate::model::Knob;
    use crate::portrait::Cycle;

    #[test]
    fn a_branch_ends_where_two_cycles_meet_or_where_one_grazes_the_rest() {
        let linear = Cycle::from(&LinearCycle::new(-0.3, 0.1).unwrap());
        let end = |log_multiplier| {
            let cycle = Cycle { log_multiplier, ..linear };
            let special = vec![Special::new(SpecialKind::Fold, -1.5, Some(cycle))];
            let cost = crate::flow::Cost::default();
            let vague = vec![-1.4, -1.2];
            let found = Branch { parameter: Knob::D, pieces: Vec::new(), special, vague, cost };
            table(&found, &Parameters { d: -1.5, d2: 0.0, d3: 10.0, r: 1.0 }, 1e-6, 0.0)
        };
        assert!(end(-1e-6).contains("fold") && !end(-1e-6).contains("grazing"));
        assert!(end(-28.0).contains("grazing") && !end(-28.0).contains("fold"));
        assert!(end(-28.0).contains("left out, too vague: 2, D = -1.4"));
    }

    #[test]
    fn numbers_that_do_not_exist_are_null_and_the_others_come_back() {
        let branch = Branch {
            parameter: Knob::D,
            pieces: Vec::new(),
            special: vec![Special::new(SpecialKind::Escape, 0.1, None)],
            vague: vec![-1.5],
            cost: crate::flow::Cost::default(),
        };
        let expected = r#"{"parameter":"D","points":[],"special":[{"kind":"escape","value":0.1,"q_max":null}],"vague":[-1.5],"cost":{"evaluations":0,"steps":0,"rejected":0,"seconds":null}}"#;
        assert_eq!(json(&branch, None, f64::NAN), format!("{expected}\n"));
    }
}
