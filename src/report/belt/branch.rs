//! The cycles of a machine as one of its numbers varies, and where they change.

use serde::Serialize;

use super::document::{CycleNumbers, MachineCost, MachineCycleDocument, kind};
use super::table::{CYCLE, cells};
use super::{Head, PLACES};
use crate::flow::Fate;
use crate::machine::branch::MachineBranch;
use crate::machine::jumps::Jump;
use crate::machine::special::{MachineSpecial, MachineSpecialKind};
use crate::oscillator::Knob;
use crate::report::csv::CsvSheet;
use crate::report::json::{Seconds, text};
use crate::report::table::Table;
use crate::words::number::duration;
use crate::words::quantity::with_unit;

pub struct BranchAnswer<'a> {
    /// The machine.
    pub head: &'a Head<'a>,
    /// The number that varies.
    pub varied: Knob,
    pub branch: MachineBranch,
    pub seconds: f64,
}

/// The changes along one number at values of another.
pub struct Borders<'a> {
    /// The machine.
    pub head: &'a Head<'a>,
    /// The number along which the changes are located, and the other number.
    pub varied: (Knob, Knob),
    /// The changes at each value of the other number.
    pub rows: Vec<(f64, Vec<MachineSpecial>)>,
    pub seconds: f64,
}

#[derive(Serialize)]
struct BeltBranchDocument<'a> {
    machine: &'a str,
    model: &'static str,
    quantity: &'static str,
    unit: &'static str,
    points: Vec<BranchedPoint>,
    special: &'a [MachineSpecial],
    cost: MachineCost,
}

/// A cycle at a value. A value without an answer has one row, with the reason.
#[derive(Serialize)]
struct BranchedPoint {
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    #[serde(flatten)]
    cycle: Option<MachineCycleDocument>,
}

fn points(branched: &BranchAnswer) -> Vec<BranchedPoint> {
    let mut points = Vec::new();
    for point in &branched.branch.points {
        let row = |reason, cycle| BranchedPoint { value: point.value, reason, cycle };
        match &point.found {
            Ok(found) => {
                points.extend(
                    found.cycles.iter().map(|it| row(None, Some(MachineCycleDocument::new(it)))),
                );
            }
            Err(trouble) => points.push(row(Some(trouble.to_string()), None)),
        }
    }
    points
}

/// The branch as a document.
pub fn json(branched: &BranchAnswer) -> String {
    let found = branched.branch.points.iter().filter_map(|point| point.found.as_ref().ok());
    text(&BeltBranchDocument {
        machine: branched.head.name,
        model: "whole",
        quantity: branched.varied.spec().name,
        unit: branched.varied.spec().unit,
        points: points(branched),
        special: &branched.branch.special,
        cost: MachineCost {
            steps: found.map(|found| found.steps).sum(),
            seconds: branched.seconds,
        },
    })
}

/// What happens at a change, in a few words.
fn words(kind: MachineSpecialKind) -> &'static str {
    match kind {
        MachineSpecialKind::Hopf => "Hopf: rest changes its stability",
        MachineSpecialKind::Grazing => "grazing: a slip cycle touches the belt's line",
        MachineSpecialKind::Annihilation => {
            "annihilation: the stick-slip cycle meets the border of rest"
        }
        MachineSpecialKind::Overtaking => "the stick-slip cycle comes to overtake the belt",
        MachineSpecialKind::Unsticking => "the cycle overtakes the belt without sticking",
        MachineSpecialKind::Fold => "fold: two cycles meet",
    }
}

/// The stable states that end at a change, as the number increases and as it decreases.
fn jumps(special: &MachineSpecial) -> String {
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
    sentence(special.jumps.up, "growing") + &sentence(special.jumps.down, "falling")
}

/// The branch as a table.
pub fn table(branched: &BranchAnswer) -> String {
    let (name, unit) = (branched.varied.spec().name, branched.varied.spec().unit);
    let mut rows = Table::new(&[&[name, "cycle"], CYCLE].concat());
    for point in &branched.branch.points {
        let value = with_unit(point.value, PLACES, unit);
        match &point.found {
            Ok(found) => {
                for cycle in &found.cycles {
                    rows.row([vec![value.clone()], cells(cycle)].concat());
                }
            }
            Err(trouble) => rows.row(vec![value, trouble.to_string()]),
        }
    }
    let mut changes = Table::new(&[name, "x", "what happens"]);
    for special in &branched.branch.special {
        let x = special.x_max.map_or_else(String::new, |x| with_unit(x, PLACES, "m"));
        let what = format!("{}{}", words(special.kind), jumps(special));
        changes.row(vec![with_unit(special.value, 13, unit), x, what]);
    }
    let head = branched.head;
    format!(
        "{}: {}\n{}\n\n{}\n{}\n{}\n",
        head.name,
        head.title,
        head.numbers_without(name),
        rows.aligned_left(),
        changes.aligned_left(),
        duration(branched.seconds)
    )
}

/// A cycle at a value.
#[derive(Default, Serialize)]
struct BeltBranchRow {
    value: f64,
    kind: &'static str,
    stable: bool,
    overtakes: bool,
    #[serde(flatten)]
    numbers: CycleNumbers,
}

/// One row for each cycle, then one for each change, in SI units.
pub fn csv(branched: &BranchAnswer) -> String {
    let called = [("value", branched.varied.spec().name), ("kind", "what")];
    let mut sheet = CsvSheet::like(&BeltBranchRow::default(), &called);
    for point in &branched.branch.points {
        for cycle in point.found.iter().flat_map(|found| &found.cycles) {
            sheet.row(&BeltBranchRow {
                value: point.value,
                kind: kind(cycle),
                stable: cycle.stable,
                overtakes: cycle.overtakes,
                numbers: cycle.into(),
            });
        }
    }
    branched.branch.special.iter().for_each(|special| sheet.row(special));
    sheet.into_text()
}

#[derive(Serialize)]
struct BordersDocument<'a> {
    machine: &'a str,
    model: &'static str,
    quantity: &'static str,
    unit: &'static str,
    against: &'static str,
    against_unit: &'static str,
    rows: Vec<ChangesDocument<'a>>,
    cost: Seconds,
}

#[derive(Serialize)]
struct ChangesDocument<'a> {
    value: f64,
    special: &'a [MachineSpecial],
}

/// The changes as a document.
pub fn borders_json(borders: &Borders) -> String {
    let rows =
        borders.rows.iter().map(|(value, special)| ChangesDocument { value: *value, special });
    text(&BordersDocument {
        machine: borders.head.name,
        model: "whole",
        quantity: borders.varied.0.spec().name,
        unit: borders.varied.0.spec().unit,
        against: borders.varied.1.spec().name,
        against_unit: borders.varied.1.spec().unit,
        rows: rows.collect(),
        cost: Seconds { seconds: borders.seconds },
    })
}

/// The changes as a table.
pub fn borders_table(borders: &Borders) -> String {
    let (along, against) = borders.varied;
    let mut table = Table::new(&[against.spec().name, along.spec().name, "what happens"]);
    for (value, special) in &borders.rows {
        for special in special {
            table.row(vec![
                with_unit(*value, PLACES, against.spec().unit),
                with_unit(special.value, 13, along.spec().unit),
                words(special.kind).to_owned(),
            ]);
        }
    }
    let head = borders.head;
    let seconds = duration(borders.seconds);
    format!("{}: {}\n\n{}\n{seconds}\n", head.name, head.title, table.aligned_left())
}

/// A change along one number at a value of the other.
#[derive(Serialize)]
struct BordersRow {
    against: f64,
    value: f64,
    kind: MachineSpecialKind,
    x_max: Option<f64>,
}

/// One row for each change, in SI units.
pub fn borders_csv(borders: &Borders) -> String {
    let (along, against) = borders.varied;
    let called = [("against", against.spec().name), ("value", along.spec().name), ("kind", "what")];
    let row = |against, value, kind, x_max| BordersRow { against, value, kind, x_max };
    let mut sheet = CsvSheet::like(&row(0.0, 0.0, MachineSpecialKind::Fold, None), &called);
    for (against, special) in &borders.rows {
        for special in special {
            sheet.row(&row(*against, special.value, special.kind, special.x_max));
        }
    }
    sheet.into_text()
}
