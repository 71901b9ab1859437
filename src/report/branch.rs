//! The cycles as a number varies and the special points, and these along a second number.

use super::cycle_numbers::{cycle_fields, machine_cycles, number_columns};
use super::{
    About, Answer, BorderProof, Columns, Document, PLACES, Quantity, border_columns, decided,
    digits, piece_columns, range_changes, range_pieces,
};
use crate::branch::{
    Boundary, BoundaryPoint, Branch, BranchPoint, Jump, JumpEnd, MachineBranch, PortraitPoint,
    Special,
};
use crate::flow::{Cost, Result};
use crate::model::Knob;
use crate::portrait::Cycle;
use crate::proof::range::MOST_STEPS;
use crate::proof::{Range, RangePiece};
use crate::words::{significant, stability, with_unit};

/// A point with the number of the connected piece to which it belongs.
#[derive(Clone, Copy)]
struct PieceRow<'a> {
    piece: usize,
    point: &'a BranchPoint,
}

/// A point, or a part of the range of which something is proved.
#[derive(Default)]
struct BranchRow<'a> {
    point: Option<PieceRow<'a>>,
    proved: Option<&'a RangePiece>,
}

/// The columns of points; `value` names the number that varies.
fn point_columns<'a>(value: &'static str, digits: usize) -> Columns<'a, PieceRow<'a>> {
    let columns = Columns::default()
        .file("piece", |row: &PieceRow| row.piece)
        .number(value, Quantity::pure(digits), |row| row.point.value)
        .and(cycle_fields(|row: &PieceRow| Some(row.point.cycle)))
        .text("piece", |row| row.piece)
        .text("cycle", |row| stability(row.point.cycle.stable));
    number_columns(columns, move |row, number| number.text(&row.point.cycle, digits))
}

/// The branch of the oscillator of the paper: one row for each point, and for each part of the range in which the number
/// of cycles is proved or open; then the special points.
pub fn branch(
    about: &About,
    branch: &Branch,
    certified: Option<&Range>,
    tolerance: f64,
    seconds: f64,
) -> Answer {
    let points = || {
        let pieces = branch.pieces.iter().enumerate();
        pieces.flat_map(|(piece, points)| points.iter().map(move |point| PieceRow { piece, point }))
    };
    let name = branch.parameter.spec().name;
    let shown = digits(tolerance).min(10);
    let proved = certified.map(|range| {
        Columns::default()
            .part("certified", piece_columns(range, name), |row: &BranchRow| row.proved)
    });
    let columns = Columns::default()
        .part("point", point_columns(name, shown), |row: &BranchRow| row.point)
        .and(proved);
    let parts = certified.into_iter().flat_map(|range| &range.pieces);
    let parts = parts.map(|part| BranchRow { proved: Some(part), ..BranchRow::default() });
    let rows = points().map(|point| BranchRow { point: Some(point), ..BranchRow::default() });
    let special = Quantity::pure(digits(tolerance));
    let special = Columns::default()
        .text("special point", |it: &Special| it.kind.name(it.cycle.as_ref()))
        .number(name, special, |it| it.value)
        .number("q_max", special, |it| it.q_max);
    let mut answer = about
        .answer()
        .with("parameter", branch.parameter)
        .with_rows("points", &point_columns("value", shown), points())
        .with("special", &branch.special)
        .with("vague", &branch.vague)
        .with_any("certified", certified.map(decided))
        .csv(&columns, rows.chain(parts))
        .table_of(&point_columns(name, shown), points())
        .lines(branch.pieces.is_empty().then_some("no limit cycle"))
        .table(special.table(&branch.special))
        .lines(vague(branch));
    if let Some(range) = certified {
        let open = || format!("open after {MOST_STEPS} steps: a narrower range may be decided");
        answer = answer
            .table(range_pieces().table(&range.pieces))
            .table(range_changes().table(&range.changes))
            .lines(range.exhausted.then(open));
    }
    answer.cost(branch.cost, seconds)
}

/// How many points are left out, and between which values.
fn vague(branch: &Branch) -> Option<String> {
    let [first, last] = [branch.vague.first()?, branch.vague.last()?].map(|it| significant(*it, 6));
    let (count, name) = (branch.vague.len(), branch.parameter);
    Some(format!("left out, too vague: {count}, {name} = {first} .. {last}"))
}

/// The fold and the escape point at one value of the second parameter, and what is proved of them.
type BorderRow<'a> = (&'a BoundaryPoint, Option<&'a BorderProof>);

/// The fold and the escape point of the oscillator of the paper, one row for each value of the second parameter.
pub fn border<'a>(
    about: &About,
    found: &'a Boundary,
    certified: Option<&'a [BorderProof]>,
    seconds: f64,
) -> Answer {
    const EXACT: Quantity = Quantity::pure(12);
    const SHORT: Quantity = Quantity::pure(8);
    let name = found.second.spec().name;
    let proved =
        Columns::default().part("certified", border_columns(), |(_, proof): &BorderRow<'a>| *proof);
    let columns = Columns::default()
        .number(name, Quantity::pure(10), |(point, _): &BorderRow<'a>| point.value)
        .number("D_F", EXACT, |(point, _)| Some(point.fold?.d))
        .text("is a", |(point, _)| Some(if point.fold?.grazes { "grazing" } else { "fold" }))
        .number("q_max", SHORT, |(point, _)| Some(point.fold?.q_max))
        .number("period", SHORT, |(point, _)| Some(point.fold?.period))
        .number("D_F_harmonic", SHORT, |(point, _)| point.harmonic_fold)
        .number("D_c", EXACT, |(point, _)| point.escape)
        .file("reason", |(point, _)| point.reason.clone())
        .and(certified.map(|_| proved));
    let proofs = certified.into_iter().flatten().map(Some).chain(std::iter::repeat(None));
    let rows = found.points.iter().zip(proofs);
    let given_up = found.points.iter().filter_map(|point| {
        let reason = point.reason.as_ref()?;
        Some(format!("{name} = {}: {reason}", significant(point.value, 10)))
    });
    let document = |all: &[BorderProof]| all.iter().map(BorderProof::document).collect::<Vec<_>>();
    about
        .answer()
        .with("parameter", found.second)
        .with("points", &found.points)
        .with_any("certified", certified.map(document))
        .rows(&columns, rows)
        .lines(given_up)
        .cost(found.cost, seconds)
}

/// A value, and a cycle of a machine there; one without an answer has one row, with the reason.
type MachineBranchRow = (f64, Result<Cycle>);

/// The branch of a machine: a row for each cycle at each value; below them in text, each change in a sentence.
pub fn of_machine(about: &About, varied: Knob, found: &MachineBranch, seconds: f64) -> Answer {
    let (name, unit) = (varied.spec().name, varied.spec().unit);
    let columns = |name| {
        Columns::default()
            .number(name, Quantity::of(unit, PLACES), |(value, _): &MachineBranchRow| *value)
            .and(machine_cycles(|(_, cycle): &MachineBranchRow| cycle.ok()))
            .file("reason", |(_, cycle)| cycle.err())
    };
    let mut rows = Vec::new();
    for PortraitPoint { value, found } in &found.points {
        match found {
            Ok(found) => rows.extend(found.cycles.iter().map(|cycle| (*value, Ok(*cycle)))),
            Err(why) => rows.push((*value, Err(*why))),
        }
    }
    let cost = Cost { steps: found.cost.steps, ..Cost::default() };
    about
        .answer()
        .with("parameter", name)
        .with("unit", unit)
        .with_rows("points", &columns("value"), &rows)
        .with("special", &found.special)
        .rows(&columns(name), &rows)
        .table(special_columns(varied, |special| special).table(&found.special))
        .cost(cost, seconds)
}

/// The columns of the changes of a machine along a number.
fn special_columns<'a, R: 'a>(along: Knob, of: fn(&R) -> &Special) -> Columns<'a, R> {
    Columns::default()
        .number(along.spec().name, Quantity::of(along.spec().unit, 13), move |row| of(row).value)
        .file("kind", move |row| of(row).kind)
        .number("q_max", Quantity::of("m", PLACES), move |row| of(row).q_max)
        .text("what happens", move |row| of(row).kind.meaning().to_owned() + &jumps(of(row)))
}

/// The stable states that end at a change, as the number increases and as it decreases.
fn jumps(special: &Special) -> String {
    let place = |x: f64| match x {
        0.0 => "rest".to_owned(),
        x => format!("x = {}", with_unit(x, 5, "m")),
    };
    let sentence = |jump: Option<Jump>, way: &str| {
        let Some(Jump { from, to }) = jump else { return String::new() };
        let to = match to {
            JumpEnd::Rest => "rest".to_owned(),
            JumpEnd::Cycle { q_max } => place(q_max),
            JumpEnd::Escaped => "beyond all bounds".to_owned(),
            JumpEnd::Unknown => "where the friction law ends".to_owned(),
        };
        format!("; {way}, from {} to {to}", place(from))
    };
    let jumps = special.jumps.unwrap_or_default();
    sentence(jumps.up, "growing") + &sentence(jumps.down, "falling")
}

/// The changes of a machine along one number, a row for each, at each value of the other.
pub fn border_of_machine(
    about: &About,
    (along, over): (Knob, Knob),
    found: &[(f64, MachineBranch)],
    seconds: f64,
) -> Answer {
    let [over_name, along_name] = [over, along].map(|knob| knob.spec().name);
    // Why a value has no row.
    let reason = |branch: &MachineBranch| {
        let failed = branch.points.iter().find_map(|point| point.found.as_ref().err());
        let none = || format!("nothing changes along {along_name}");
        let why = failed.map_or_else(none, |why| format!("not all is known: {why}"));
        branch.special.is_empty().then_some(why)
    };
    let columns = Columns::default()
        .number(over_name, Quantity::of(over.spec().unit, 13), |(value, _): &(f64, _)| *value)
        .and(special_columns(along, |(_, special): &(f64, &Special)| special));
    let rows = found
        .iter()
        .flat_map(|(value, branch)| branch.special.iter().map(move |special| (*value, special)));
    let points = found.iter().map(|(value, branch)| {
        let point = Document::of("value", value).with("special", &branch.special);
        point.with("reason", reason(branch))
    });
    let nothing = found.iter().filter_map(|(value, branch)| {
        let at = with_unit(*value, PLACES, over.spec().unit);
        Some(format!("{over_name} = {at}: {}", reason(branch)?))
    });
    about
        .answer()
        .with("parameter", over_name)
        .with("along", along_name)
        .with("points", points.collect::<Vec<_>>())
        .rows(&columns, rows)
        .lines(nothing)
        .cost(Cost::default(), seconds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::SpecialKind;
    use crate::model::{Body, Parameters, Side};
    use crate::portrait::closing::pair::SwingPair;
    use crate::report::Format;

    fn oscillator(parameters: Parameters) -> About {
        About::new("", "", &Body::Paper(parameters).into())
    }

    #[test]
    fn a_branch_ends_where_two_cycles_meet_or_where_one_grazes_the_rest() {
        let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.0, r: 0.1 };
        let linear = SwingPair::linear(&parameters).unwrap().describe(&parameters, Side::Upper);
        let end = |log_multiplier| {
            let cycle = Cycle { log_multiplier, ..linear };
            let special = vec![Special::new(SpecialKind::Fold, -1.5, Some(cycle))];
            let cost = crate::flow::Cost::default();
            let vague = vec![-1.4, -1.2];
            let found = Branch { parameter: Knob::D, pieces: Vec::new(), special, vague, cost };
            let about = oscillator(Parameters { d: -1.5, d2: 0.0, d3: 10.0, r: 1.0 });
            super::branch(&about, &found, None, 1e-6, 0.0).told(Format::Table)
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
        let about = oscillator(Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 1.0 });
        let expected = r#""parameter":"D","points":[],"special":[{"kind":"escape","value":0.1,"q_max":null}],"vague":[-1.5],"cost":{"evaluations":0,"steps":0,"rejected":0,"seconds":null}}"#;
        let told = super::branch(&about, &branch, None, 1e-6, f64::NAN).told(Format::Json);
        assert!(told.ends_with(&format!(",{expected}\n")), "{told}");
    }
}
