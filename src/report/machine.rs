//! Answers about a machine in the words of those about the oscillator of the paper: `q` and `v` are displacement and
//! velocity, in SI units.
//!
//! An answer is a document and rows. The table has those fields of a row that [`COLUMNS`] knows, with their units.

use serde::Serialize;
use serde_json::{Map, Value};

use super::belt::{Head, PLACES};
use super::csv;
use super::json::{self, Document};
use super::table::Table;
use crate::machine::Subject;
use crate::oscillator::Knob;
use crate::portrait::Cycle;
use crate::words::number::duration;
use crate::words::quantity::with_unit;

/// An answer about a machine.
pub struct MachineReport<'a, D, R> {
    pub head: &'a Head<'a>,
    pub subject: &'a Subject,
    /// What the document says beside the machine and the cost.
    pub document: D,
    /// A row with all its fields, which names the columns.
    pub like: R,
    pub rows: Vec<R>,
    /// Fields that are called by a number of the machine.
    pub called: Vec<(&'static str, Knob)>,
    /// Lines below the table.
    pub notes: Vec<String>,
    pub steps: u64,
    pub seconds: f64,
}

/// Fields of rows that a table shows, their titles and units.
const COLUMNS: [(&str, &str, &str); 22] = [
    ("what", "", ""),
    ("kind", "kind", ""),
    ("stable", "stable", ""),
    ("overtakes", "overtakes", ""),
    ("q_min", "q from", "m"),
    ("q_max", "to", "m"),
    ("v_min", "v from", "m/s"),
    ("v_max", "to", "m/s"),
    ("period", "period", "s"),
    ("stick_duration", "on the belt", "s"),
    ("multiplier", "multiplier", ""),
    ("tau", "t", "s"),
    ("q", "q", "m"),
    ("v", "v", "m/s"),
    ("captured", "captured", ""),
    ("cycle", "cycle", ""),
    ("escaped", "escaped", ""),
    ("undecided", "undecided", ""),
    ("displacement", "displacement", "m"),
    ("impulse", "impulse", "N s"),
    ("from_rest_displacement", "from rest", "m"),
    ("from_rest_impulse", "impulse from rest", "N s"),
];

impl<D: Serialize, R: Serialize> MachineReport<'_, D, R> {
    pub fn json(&self) -> String {
        let numbers = self.subject.numbers();
        let parameters = numbers.fold(Document::default(), |parameters, (knob, value)| {
            parameters.with(&knob.to_string(), value)
        });
        Document::default()
            .with("machine", self.head.name)
            .with("parameters", parameters)
            .and(&self.document)
            .cost(&Document::default().with("steps", self.steps), self.seconds)
            .text()
    }

    pub fn csv(&self) -> String {
        let names: Vec<String> = fields(&self.like).into_iter().map(|(name, _)| name).collect();
        let shown = |name: &String| {
            let called = self.called.iter().find(|(field, _)| field == name);
            called.map_or(name.clone(), |(_, knob)| knob.spec().name.to_owned())
        };
        let heading = names.iter().map(shown).collect();
        let line = |row: &R| {
            let fields = fields(row);
            names.iter().map(|name| fields.get(name).map(csv::cell).unwrap_or_default()).collect()
        };
        csv::lines(std::iter::once(heading).chain(self.rows.iter().map(line)))
    }

    pub fn table(&self) -> String {
        let column = |(name, _): (String, Value)| {
            let knob = self.called.iter().find(|(field, _)| *field == name);
            let knob = knob.map(|(_, knob)| (knob.spec().name, knob.spec().unit));
            let known = COLUMNS.iter().find(|(field, ..)| *field == name);
            let (title, unit) = knob.or(known.map(|(_, title, unit)| (*title, *unit)))?;
            Some((name, title, unit))
        };
        let columns: Vec<_> = fields(&self.like).into_iter().filter_map(column).collect();
        let line = |row: &R| {
            let fields = fields(row);
            columns.iter().map(|(name, _, unit)| cell(fields.get(name), unit)).collect()
        };
        let titles = columns.iter().map(|(_, title, _)| *title).collect();
        let table = Table { titles, rows: self.rows.iter().map(line).collect() };
        let varied: Vec<&str> = self.called.iter().map(|(_, knob)| knob.spec().name).collect();
        let Head { name, title, .. } = self.head;
        let mut out = format!("{name}: {title}\n{}\n\n", self.head.numbers_without(&varied));
        if !table.is_empty() {
            out += &format!("{}\n", table.aligned_left());
        }
        for note in &self.notes {
            out += &format!("{note}\n");
        }
        out + &format!("{} steps, {}\n", self.steps, duration(self.seconds))
    }
}

/// The fields of a row that have a column: those that are neither records nor lists, and the smallest kicks from rest.
fn fields(row: &impl Serialize) -> Map<String, Value> {
    const FROM_REST: &str = "from_rest";
    let Value::Object(row) = json::value(row) else { return Map::new() };
    let single = |(name, value): (String, Value)| match value {
        Value::Object(kicks) if name == FROM_REST => {
            let kicks = kicks.into_iter();
            kicks.map(|(kick, size)| (format!("{name}_{kick}"), size)).collect()
        }
        Value::Object(_) | Value::Array(_) => vec![],
        value => vec![(name, value)],
    };
    row.into_iter().flat_map(single).collect()
}

fn cell(value: Option<&Value>, unit: &str) -> String {
    match value {
        Some(Value::Number(number)) if number.is_f64() => {
            with_unit(number.as_f64().unwrap_or(f64::NAN), PLACES, unit)
        }
        Some(Value::Number(number)) => number.to_string(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Bool(holds)) => if *holds { "yes" } else { "no" }.to_owned(),
        _ => "-".to_owned(),
    }
}

/// A cycle of a machine.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct MachineCycleRow {
    kind: &'static str,
    overtakes: bool,
    #[serde(flatten)]
    cycle: Cycle,
    stick_duration: f64,
}

impl From<&Cycle> for MachineCycleRow {
    fn from(cycle: &Cycle) -> Self {
        MachineCycleRow {
            kind: cycle.kind(),
            overtakes: cycle.overtakes,
            cycle: *cycle,
            stick_duration: cycle.stick_duration(),
        }
    }
}
