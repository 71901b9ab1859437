//! The cycles of a machine as one of its numbers varies, and where they change.

use serde::Serialize;

use super::belt::{Head, PLACES};
use super::columns::{Columns, Quantity};
use super::machine::{MachineCycleRow, MachineReport};
use crate::flow::Fate;
use crate::machine::Subject;
use crate::machine::branch::MachineBranch;
use crate::machine::jumps::Jump;
use crate::machine::special::{MachineSpecial, MachineSpecialKind};
use crate::oscillator::Knob;
use crate::words::quantity::with_unit;

#[derive(Serialize)]
pub struct BranchDocument<'a> {
    parameter: &'static str,
    unit: &'static str,
    points: Vec<BranchRow>,
    special: &'a [MachineSpecial],
}

/// A cycle at a value, or a change there; a value without an answer has one row, with the reason.
#[derive(Clone, Default, Serialize)]
pub struct BranchRow {
    value: f64,
    #[serde(flatten)]
    cycle: Option<MachineCycleRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

/// A row for each cycle at each value; below them, each change in a sentence.
pub fn branch<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (varied, found): (Knob, &'a MachineBranch),
    seconds: f64,
) -> MachineReport<'a, BranchDocument<'a>, BranchRow> {
    let spec = varied.spec();
    let mut rows = Vec::new();
    for point in &found.points {
        let row = BranchRow { value: point.value, ..BranchRow::default() };
        match &point.found {
            Ok(found) => rows.extend(
                found
                    .cycles
                    .iter()
                    .map(|cycle| BranchRow { cycle: Some(cycle.into()), ..row.clone() }),
            ),
            Err(why) => rows.push(BranchRow { reason: Some(why.to_string()), ..row }),
        }
    }
    let changes = Columns::default()
        .text("", |it: &&MachineSpecial| with_unit(it.value, 13, spec.unit))
        .text("", |it| Quantity::of("m", PLACES).or("").text(it.x_max))
        .text("", |it| format!("{}{}", words(it.kind), jumps(it)))
        .table(&found.special);
    let reached = found.points.iter().filter_map(|point| point.found.as_ref().ok());
    MachineReport {
        head,
        subject,
        document: BranchDocument {
            parameter: spec.name,
            unit: spec.unit,
            points: rows.clone(),
            special: &found.special,
        },
        like: BranchRow {
            cycle: Some(MachineCycleRow::default()),
            reason: Some(String::new()),
            ..BranchRow::default()
        },
        rows,
        called: vec![("value", varied)],
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

/// The changes along one number at a value of another.
#[derive(Clone, Serialize)]
pub struct ChangesDocument {
    value: f64,
    special: Vec<MachineSpecial>,
}

#[derive(Serialize)]
pub struct BorderDocument {
    parameter: &'static str,
    along: &'static str,
    points: Vec<ChangesDocument>,
}

/// A change along one number at a value of another.
#[derive(Serialize)]
pub struct BorderRow {
    value: f64,
    at: f64,
    kind: Option<MachineSpecialKind>,
    q_max: Option<f64>,
}

/// A row for each change along one number, at each value of the other.
pub fn border<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (along, over): (Knob, Knob),
    found: Vec<(f64, Vec<MachineSpecial>)>,
    seconds: f64,
) -> MachineReport<'a, BorderDocument, BorderRow> {
    let row = |value: f64, special: &MachineSpecial| {
        let MachineSpecial { kind, value: at, x_max, .. } = *special;
        BorderRow { value, at, kind: Some(kind), q_max: x_max }
    };
    let all = found.iter().flat_map(|(value, all)| all.iter().map(|one| row(*value, one)));
    let rows = all.collect();
    let points = found.into_iter().map(|(value, special)| ChangesDocument { value, special });
    MachineReport {
        head,
        subject,
        document: BorderDocument {
            parameter: over.spec().name,
            along: along.spec().name,
            points: points.collect(),
        },
        like: BorderRow { value: 0.0, at: 0.0, kind: None, q_max: None },
        rows,
        called: vec![("value", over), ("at", along)],
        notes: Vec::new(),
        steps: 0,
        seconds,
    }
}
