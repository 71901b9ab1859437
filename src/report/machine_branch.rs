//! The cycles of a machine as one of its numbers varies, and where they change.

use super::belt::{Head, PLACES};
use super::columns::{Columns, Quantity};
use super::json::Document;
use super::machine::{LENGTH, MachineReport, machine_cycles};
use crate::branch::machine::MachineBranch;
use crate::branch::machine_special::Jump;
use crate::branch::machine_special::{MachineSpecial, MachineSpecialKind};
use crate::flow::Fate;
use crate::model::{Knob, Subject};
use crate::portrait::Cycle;
use crate::words::quantity::with_unit;

/// A cycle at a value; a value without an answer has one row, with the reason.
#[derive(Clone)]
pub struct MachineBranchRow {
    value: f64,
    cycle: Option<Cycle>,
    reason: Option<String>,
}

/// The columns of cycles at the values of a number that is called `name`.
fn columns<'a>(name: &'static str, unit: &'static str) -> Columns<'a, MachineBranchRow> {
    Columns::default()
        .number(name, Quantity::of(unit, PLACES), |row: &MachineBranchRow| row.value)
        .and(Some(machine_cycles(|row: &MachineBranchRow| row.cycle)))
        .file("reason", |row| row.reason.clone())
}

/// A row for each cycle at each value; below them, each change in a sentence.
pub fn branch<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (varied, found): (Knob, &'a MachineBranch),
    seconds: f64,
) -> MachineReport<'a, MachineBranchRow> {
    let (name, unit) = (varied.spec().name, varied.spec().unit);
    let mut rows = Vec::new();
    for point in &found.points {
        let row = |cycle, reason| MachineBranchRow { value: point.value, cycle, reason };
        match &point.found {
            Ok(found) => rows.extend(found.cycles.iter().map(|cycle| row(Some(*cycle), None))),
            Err(why) => rows.push(row(None, Some(why.to_string()))),
        }
    }
    let changes = Columns::default()
        .text("", |it: &&MachineSpecial| with_unit(it.value, 13, unit))
        .text("", |it| it.x_max.map_or_else(String::new, |x| LENGTH.text(x)))
        .text("", |it| format!("{}{}", words(it.kind), jumps(it)))
        .table(&found.special);
    let reached = found.points.iter().filter_map(|point| point.found.as_ref().ok());
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("parameter", name)
            .with("unit", unit)
            .with("points", columns("value", unit).objects(rows.clone()))
            .with("special", &found.special),
        columns: columns(name, unit),
        rows,
        varied: vec![varied],
        notes: changes.aligned_left().lines().skip(1).map(str::to_owned).collect(),
        steps: reached.map(|found| found.steps).sum(),
        seconds,
    }
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

/// A row for each change along one number, at each value of the other.
pub fn border<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (along, over): (Knob, Knob),
    found: Vec<(f64, Vec<MachineSpecial>)>,
    seconds: f64,
) -> MachineReport<'a, (f64, MachineSpecial)> {
    let points = found
        .iter()
        .map(|(value, special)| Document::default().with("value", value).with("special", special));
    let points: Vec<Document> = points.collect();
    let number = |knob: Knob| (knob.spec().name, Quantity::of(knob.spec().unit, 13));
    let ((over_name, value), (along_name, at)) = (number(over), number(along));
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("parameter", over_name)
            .with("along", along_name)
            .with("points", points),
        columns: Columns::default()
            .number(over_name, value, |(value, _): &(f64, MachineSpecial)| *value)
            .number(along_name, at, |(_, special)| special.value)
            .file("kind", |(_, special)| special.kind)
            .number("q_max", LENGTH, |(_, special)| special.x_max)
            .text("what happens", |(_, special)| words(special.kind).to_owned()),
        rows: found
            .into_iter()
            .flat_map(|(value, all)| all.into_iter().map(move |special| (value, special)))
            .collect(),
        varied: vec![along, over],
        notes: Vec::new(),
        steps: 0,
        seconds,
    }
}
