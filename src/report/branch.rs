//! The cycles as a parameter varies, and the special points.

use serde::Serialize;

use super::certified::{PieceBounds, ProvedRange, decided};
use super::csv::CsvSheet;
use super::cycles::{COLUMNS, cells};
use super::json::{self, CountedCost};
use super::table::{Table, digits, parameters, rounded};
use crate::oscillator::{Knob, Parameters};
use crate::proof::range::Range;
use crate::study::{Branch, BranchPoint, Special};
use crate::words::number::{duration, significant};

/// A point, with the number of the connected piece to which it belongs.
#[derive(Default, Serialize)]
struct BranchRow {
    piece: Option<usize>,
    #[serde(flatten)]
    point: Option<BranchPoint>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<PieceBounds>,
}

fn rows(branch: &Branch) -> impl Iterator<Item = BranchRow> {
    let pieces = branch.pieces.iter().enumerate();
    pieces.flat_map(|(piece, points)| {
        points.iter().map(move |point| BranchRow {
            piece: Some(piece),
            point: Some(*point),
            certified: None,
        })
    })
}

#[derive(Serialize)]
struct BranchDocument<'a> {
    parameter: Knob,
    points: Vec<BranchRow>,
    special: &'a [Special],
    vague: &'a [f64],
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<ProvedRange>,
    cost: CountedCost,
}

pub fn json(branch: &Branch, certified: Option<&Range>, seconds: f64) -> String {
    json::text(&BranchDocument {
        parameter: branch.parameter,
        points: rows(branch).collect(),
        special: &branch.special,
        vague: &branch.vague,
        certified: certified.map(decided),
        cost: CountedCost { counted: branch.cost, seconds },
    })
}

/// One row for each point, and for each part of the range in which the number of cycles is proved or open.
pub fn csv(branch: &Branch, certified: Option<&Range>) -> String {
    let name = branch.parameter.spec().name;
    let bounds = ["lower", "upper"].map(|end| (format!("value_{end}"), format!("{name}_{end}")));
    let called = [("value", name), (&bounds[0].0, &bounds[0].1), (&bounds[1].0, &bounds[1].1)];
    let like = BranchRow {
        point: Some(BranchPoint::default()),
        certified: certified.map(|_| PieceBounds::like()),
        ..BranchRow::default()
    };
    let mut sheet = CsvSheet::like(&like, &called);
    rows(branch).for_each(|row| sheet.row(&row));
    let parts = certified.map(PieceBounds::of).unwrap_or_default();
    for part in parts {
        sheet.row(&BranchRow { certified: Some(part), ..BranchRow::default() });
    }
    sheet.into_text()
}

/// A table for each connected piece, then the special points.
pub fn table(branch: &Branch, base: &Parameters, tolerance: f64, seconds: f64) -> String {
    let places = digits(tolerance).min(10);
    let mut out = format!("{}\n", parameters(base, Some(branch.parameter)));
    for (number, piece) in branch.pieces.iter().enumerate() {
        out += &format!("\npiece {}\n", number + 1);
        let mut titles = vec![branch.parameter.spec().name];
        titles.extend(COLUMNS);
        let mut table = Table::new(&titles);
        for point in piece {
            let mut row = vec![significant(point.value, places)];
            row.extend(cells(&point.cycle, places));
            table.row(row);
        }
        out += &table.to_string();
    }
    if branch.pieces.is_empty() {
        out += "\nno limit cycle\n";
    }
    let special = Table::of(
        &branch.special,
        &[
            ("special point", &|point| point.kind.name(point.cycle.as_ref()).to_owned()),
            (branch.parameter.spec().name, &|point| significant(point.value, digits(tolerance))),
            ("q_max", &|point| rounded(point.q_max, digits(tolerance))),
        ],
    );
    if !special.is_empty() {
        out += &format!("\n{special}");
    }
    if let (Some(&first), Some(&last)) = (branch.vague.first(), branch.vague.last()) {
        let [first, last] = [first, last].map(|value| significant(value, 6));
        let (count, name) = (branch.vague.len(), branch.parameter.spec().name);
        out += &format!("\nleft out, too vague: {count}, {name} = {first} .. {last}\n");
    }
    out += &format!("\n{} evaluations, {}\n", branch.cost.evaluations, duration(seconds));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_form::piecewise_linear::LinearCycle;
    use crate::portrait::Cycle;
    use crate::study::SpecialKind;

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
