//! The cycles as a number varies and the special points, and these along a second number.

use super::answer::PLACES;
use super::certified::{
    BorderProof, border_columns, border_lines, decided, piece_columns, range_table,
};
use super::cycle_numbers::{cycle_fields, number_columns};
use super::cycles::machine_cycles;
use super::table::digits;
use super::{About, Answer, Columns, Document, Quantity};
use crate::branch::fold::{Boundary, BoundaryPoint};
use crate::branch::jump::Jump;
use crate::branch::machine::MachineBranch;
use crate::branch::{Branch, BranchPoint, Special, SpecialKind};
use crate::flow::{Cost, Fate};
use crate::model::Knob;
use crate::portrait::Cycle;
use crate::proof::range::{Range, RangePiece};
use crate::words::{significant, stability, with_unit};

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
fn piece_fields<'a>(value: &str) -> Columns<'a, PieceRow<'a>> {
    Columns::default()
        .file("piece", |row: &PieceRow| row.of(|piece, _| piece))
        .file(value, |row| row.of(|_, point| point.value))
        .and(cycle_fields(|row: &PieceRow| row.of(|_, point| point.cycle)))
}

/// The branch of the oscillator of the paper: one row for each point, and for each part of the range in which the number
/// of cycles is proved or open; in text a table for each connected piece, then the special points.
pub fn branch<'a>(
    about: &'a About,
    branch: &'a Branch,
    certified: Option<&'a Range>,
    tolerance: f64,
    seconds: f64,
) -> Answer<'a> {
    let rows = move || {
        let pieces = branch.pieces.iter().enumerate();
        pieces.flat_map(|(piece, points)| points.iter().map(move |it| PieceRow::Point(piece, it)))
    };
    let document = move || {
        Document::default()
            .with("parameter", branch.parameter)
            .with("points", piece_fields("value").objects(rows()))
            .with("special", &branch.special)
            .with("vague", &branch.vague)
            .with_any("certified", certified.map(decided))
    };
    let csv = move || {
        let name = branch.parameter.spec().name;
        let proved = certified.map(|range| {
            Columns::default().part("certified", piece_columns(range, name), PieceRow::proved)
        });
        let parts = certified.into_iter().flat_map(|range| &range.pieces).map(PieceRow::Proved);
        piece_fields(name).and(proved).csv(rows().chain(parts))
    };
    let text = move || text(about, branch, tolerance);
    let proved = move || certified.map(|it| range_table(it, branch.parameter)).unwrap_or_default();
    about.answer(branch.cost, seconds, document, csv, text).below(proved)
}

fn text(about: &About, branch: &Branch, tolerance: f64) -> String {
    let places = digits(tolerance).min(10);
    let name = branch.parameter.spec().name;
    let columns = Columns::default()
        .text(name, |point: &&BranchPoint| significant(point.value, places))
        .text("cycle", |point| stability(point.cycle.stable).to_owned());
    let columns = number_columns(columns, |point, number| number.text(&point.cycle, places));
    let mut out = format!("{}\n", about.heading(&[]));
    for (number, piece) in branch.pieces.iter().enumerate() {
        out += &format!("\npiece {}\n{}", number + 1, columns.table(piece));
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
    out + "\n"
}

/// The fold and the escape point at one value of the second parameter, and what is proved of them.
type BorderRow<'a> = (&'a BoundaryPoint, Option<&'a BorderProof>);

/// The fold and the escape point of the oscillator of the paper, one row for each value of the second parameter.
pub fn border<'a>(
    about: &'a About,
    found: &'a Boundary,
    certified: Option<&'a [BorderProof]>,
    seconds: f64,
) -> Answer<'a> {
    const EXACT: Quantity = Quantity::pure(12);
    const SHORT: Quantity = Quantity::pure(8);
    let kind = |grazes: bool| if grazes { "grazing" } else { "fold" };
    let columns = move || {
        let proved =
            || Columns::default().part("certified", border_columns(), |row: &BorderRow<'a>| row.1);
        Columns::default()
            .number(found.second.spec().name, Quantity::pure(10), |(point, _): &BorderRow<'a>| {
                point.value
            })
            .number("D_F", EXACT, |(point, _)| point.fold.map(|fold| fold.d))
            .text("is a", move |(point, _)| {
                point.fold.map_or("-", |fold| kind(fold.grazes)).to_owned()
            })
            .number("q_max", SHORT, |(point, _)| point.fold.map(|fold| fold.q_max))
            .titled("q_max there")
            .file("period", |(point, _)| point.fold.map(|fold| fold.period))
            .number("D_F_harmonic", SHORT, |(point, _)| point.harmonic_fold)
            .titled("D_F of (48)")
            .number("D_c", EXACT, |(point, _)| point.escape)
            .file("reason", |(point, _)| point.reason.clone())
            .and(certified.map(|_| proved()))
    };
    let proof = move |index| certified.and_then(|all| all.get(index));
    let rows =
        move || found.points.iter().enumerate().map(move |(index, point)| (point, proof(index)));
    let document = move || {
        let certified =
            certified.map(|all| all.iter().map(BorderProof::document).collect::<Vec<_>>());
        Document::default()
            .with("parameter", found.second)
            .with("points", &found.points)
            .with_any("certified", certified)
    };
    let csv = move || columns().csv(rows());
    let text = move || {
        let given_up = found.points.iter().filter_map(|point| {
            let reason = point.reason.as_ref()?;
            Some(format!("\n{} = {}: {reason}", found.second, significant(point.value, 10)))
        });
        let given_up: String = given_up.collect();
        format!("{}\n\n{}{given_up}\n", about.heading(&[]), columns().table(rows()))
    };
    let lines = move || certified.map(|all| border_lines(all, found.second)).unwrap_or_default();
    about.answer(found.cost, seconds, document, csv, text).below(lines)
}

/// A cycle of a machine at a value; a value without an answer has one row, with the reason.
struct MachineBranchRow {
    value: f64,
    cycle: Option<Cycle>,
    reason: Option<String>,
}

/// The branch of a machine: a row for each cycle at each value; below them in text, each change in a sentence.
pub fn of_machine<'a>(
    about: &'a About,
    varied: Knob,
    found: &'a MachineBranch,
    seconds: f64,
) -> Answer<'a> {
    let (name, unit) = (varied.spec().name, varied.spec().unit);
    let columns = move |name| {
        Columns::default()
            .number(name, Quantity::of(unit, PLACES), |row: &MachineBranchRow| row.value)
            .and(machine_cycles(|row: &MachineBranchRow| row.cycle))
            .file("reason", |row| row.reason.clone())
    };
    let rows = move || {
        found.points.iter().flat_map(|point| {
            let row = |cycle, reason| MachineBranchRow { value: point.value, cycle, reason };
            match &point.cycles {
                Ok(cycles) => cycles.iter().map(|cycle| row(Some(*cycle), None)).collect(),
                Err(why) => vec![row(None, Some(why.to_string()))],
            }
        })
    };
    let document = move || {
        Document::default()
            .with("parameter", name)
            .with("unit", unit)
            .with("points", columns("value").objects(rows()))
            .with("special", &found.special)
    };
    let text = move || {
        let changes = Columns::default()
            .text("", |it: &&Special| with_unit(it.value, 13, unit))
            .text("", |it| it.q_max.map_or_else(String::new, |x| with_unit(x, PLACES, "m")))
            .text("", |it| format!("{}{}", words(it.kind), jumps(it)))
            .table(&found.special)
            .aligned_left();
        let changes: String = changes.split_inclusive('\n').skip(1).collect();
        let table = columns(name).table(rows());
        let table =
            if table.is_empty() { String::new() } else { format!("{}\n", table.aligned_left()) };
        format!("{}\n\n{table}{changes}", about.heading(&[]))
    };
    let cost = Cost { steps: found.cost.steps, ..Cost::default() };
    about.answer(cost, seconds, document, move || columns(name).csv(rows()), text)
}

/// What happens at a change, in a few words.
fn words(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Escape | SpecialKind::ZeroCrossing => kind.name(None),
        SpecialKind::Hopf => "Hopf: rest changes its stability",
        SpecialKind::Grazing => "grazing: a slip cycle touches the belt's line",
        SpecialKind::Annihilation => "annihilation: the stick-slip cycle meets the border of rest",
        SpecialKind::Overtaking => "the stick-slip cycle comes to overtake the belt",
        SpecialKind::Unsticking => "the cycle overtakes the belt without sticking",
        SpecialKind::Fold => "fold: two cycles meet",
    }
}

/// The stable states that end at a change, as the number increases and as it decreases.
fn jumps(special: &Special) -> String {
    let sentence = |jump: Option<Jump>, way: &str| {
        jump.map_or_else(String::new, |Jump { from, to, x_max }| {
            let length = |x| with_unit(x, 5, "m");
            let from =
                if from == 0.0 { "rest".to_owned() } else { format!("x = {}", length(from)) };
            let to = match to {
                Fate::Rest => "rest".to_owned(),
                Fate::Cycle(_) => format!("x = {}", length(x_max)),
                Fate::Escapes => "beyond all bounds".to_owned(),
                Fate::Neutral | Fate::Moving | Fate::Unknown(_) => {
                    "where the friction law ends".to_owned()
                }
            };
            format!("; {way}, from {from} to {to}")
        })
    };
    let jumps = special.jumps.unwrap_or_default();
    sentence(jumps.up, "growing") + &sentence(jumps.down, "falling")
}

/// The changes of a machine along one number, a row for each, at each value of the other.
pub fn border_of_machine<'a>(
    about: &'a About,
    (along, over): (Knob, Knob),
    found: &'a [(f64, Vec<Special>)],
    seconds: f64,
) -> Answer<'a> {
    let number = |knob: Knob| (knob.spec().name, Quantity::of(knob.spec().unit, 13));
    let ((over_name, value), (along_name, at)) = (number(over), number(along));
    let columns = move || {
        Columns::default()
            .number(over_name, value, |(value, _): &(f64, &Special)| *value)
            .number(along_name, at, |(_, special)| special.value)
            .file("kind", |(_, special)| special.kind)
            .number("q_max", Quantity::of("m", PLACES), |(_, special)| special.q_max)
            .text("what happens", |(_, special)| words(special.kind).to_owned())
    };
    let rows = move || {
        found.iter().flat_map(|(value, all)| all.iter().map(move |special| (*value, special)))
    };
    let document = move || {
        let point = |(value, special): &(f64, Vec<Special>)| {
            Document::default().with("value", value).with("special", special)
        };
        Document::default()
            .with("parameter", over_name)
            .with("along", along_name)
            .with("points", found.iter().map(point).collect::<Vec<_>>())
    };
    about.answer(
        Cost::default(),
        seconds,
        document,
        move || columns().csv(rows()),
        move || {
            let (heading, table) = (about.heading(&[]), columns().table(rows()));
            if table.is_empty() {
                return format!("{heading}\n\nnothing changes along {along_name}\n\n");
            }
            format!("{heading}\n\n{}\n", table.aligned_left())
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::SpecialKind;
    use crate::closed_form::piecewise_linear::LinearCycle;
    use crate::model::{Parameters, Side};
    use crate::portrait::closing::pair::Closing;
    use crate::report::Format;

    #[test]
    fn a_branch_ends_where_two_cycles_meet_or_where_one_grazes_the_rest() {
        let linear = Closing::from(&LinearCycle::new(-0.3, 0.1).unwrap())
            .describe(&Parameters { d: -0.3, d2: 0.0, d3: 0.0, r: 0.1 }, Side::Upper);
        let end = |log_multiplier| {
            let cycle = Cycle { log_multiplier, ..linear };
            let special = vec![Special::new(SpecialKind::Fold, -1.5, Some(cycle))];
            let cost = crate::flow::Cost::default();
            let vague = vec![-1.4, -1.2];
            let found = Branch { parameter: Knob::D, pieces: Vec::new(), special, vague, cost };
            let about = About::oscillator(&Parameters { d: -1.5, d2: 0.0, d3: 10.0, r: 1.0 });
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
        let about = About::oscillator(&Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 1.0 });
        let expected = r#""parameter":"D","points":[],"special":[{"kind":"escape","value":0.1,"q_max":null}],"vague":[-1.5],"cost":{"evaluations":0,"steps":0,"rejected":0,"seconds":null}}"#;
        let told = super::branch(&about, &branch, None, 1e-6, f64::NAN).told(Format::Json);
        assert!(told.ends_with(&format!(",{expected}\n")), "{told}");
    }
}
