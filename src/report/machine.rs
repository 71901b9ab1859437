//! Answers about a machine in the words of those about the oscillator of the paper: `q` and `v` are displacement and
//! velocity, in SI units.

use serde_json::{Map, Value};

use super::belt::{Head, PLACES, described, number_columns};
use super::columns::{Columns, Quantity};
use super::cycle_numbers::cycle_fields;
use super::json::Document;
use crate::model::{Knob, Subject};
use crate::portrait::Cycle;
use crate::words::number::duration;

/// A displacement in text.
pub(super) const LENGTH: Quantity = Quantity::of("m", PLACES);

/// A velocity in text.
pub(super) const SPEED: Quantity = Quantity::of("m/s", PLACES);

/// A time in text.
pub(super) const TIME: Quantity = Quantity::of("s", PLACES);

/// An impulse in text.
pub(super) const IMPULSE: Quantity = Quantity::of("N s", PLACES);

/// An answer about a machine: a document, and rows.
pub struct MachineReport<'a, R> {
    pub head: &'a Head<'a>,
    pub subject: &'a Subject,
    /// What the document says beside the machine and the cost.
    pub document: Document,
    pub columns: Columns<'a, R>,
    pub rows: Vec<R>,
    /// Numbers of the machine that vary.
    pub varied: Vec<Knob>,
    /// Lines below the table.
    pub notes: Vec<String>,
    pub steps: u64,
    pub seconds: f64,
}

impl<'a, R: 'a> MachineReport<'a, R> {
    pub fn json(self) -> String {
        let number = |(knob, value): (Knob, f64)| (knob.to_string(), value.into());
        let parameters: Map<String, Value> = self.subject.numbers().map(number).collect();
        Document::default()
            .with("machine", self.head.name)
            .with("parameters", parameters)
            .and(&self.document)
            .cost(&Document::default().with("steps", self.steps), self.seconds)
            .text()
    }

    pub fn csv(self) -> String {
        self.columns.csv(self.rows)
    }

    pub fn table(self) -> String {
        let table = self.columns.table(self.rows);
        let varied: Vec<&str> = self.varied.iter().map(|knob| knob.spec().name).collect();
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

/// The columns of cycles: that of every oscillator, and those that machines add.
pub(super) fn machine_cycles<'a, R: 'a>(
    cycle: impl Fn(&R) -> Option<Cycle> + Copy + 'a,
) -> Columns<'a, R> {
    let kind = move |row: &R| cycle(row).as_ref().map_or_else(|| "-".to_owned(), described);
    let columns = Columns::default()
        .file("kind", move |row| cycle(row).map(|it| it.kind()))
        .file("overtakes", move |row| cycle(row).map(|it| it.overtakes))
        .and(Some(cycle_fields(cycle)))
        .file("stick_duration", move |row| cycle(row).map(|it| it.stick_duration()))
        .text("cycle", kind);
    number_columns(columns, cycle)
}
