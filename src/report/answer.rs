//! An answer, made in the form that is asked for, and what it is about: the oscillator of the paper without units, or a
//! machine in SI units.

use clap::ValueEnum;

use super::columns::Quantity;
use super::json::Document;
use crate::flow::Cost;
use crate::model::{Body, Group, Interval, Knob, Parameters, Source, State};
use crate::words::number::exact;
use crate::words::{duration, with_unit};

/// The form of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for reading.
    Table,
    /// One JSON document, of a scan an object on each line; all digits.
    #[value(alias = "jsonl")]
    Json,
    /// One row per result after a line of names, all digits.
    Csv,
}

/// Makes one form of an answer.
type Form<'a> = Box<dyn FnOnce() -> String + 'a>;

/// An answer in every form, of which only the one that is asked for is made.
pub struct Answer<'a> {
    json: Form<'a>,
    csv: Form<'a>,
    table: Form<'a>,
}

impl<'a> Answer<'a> {
    /// An answer from what makes its document, its rows and its text.
    pub fn new(
        json: impl FnOnce() -> String + 'a,
        csv: impl FnOnce() -> String + 'a,
        table: impl FnOnce() -> String + 'a,
    ) -> Self {
        Answer { json: Box::new(json), csv: Box::new(csv), table: Box::new(table) }
    }

    /// The same with more below its text.
    pub(super) fn below(self, more: impl FnOnce() -> String + 'a) -> Self {
        let table = self.table;
        Answer { table: Box::new(move || table() + &more()), ..self }
    }

    /// The answer in a form.
    pub fn told(self, format: Format) -> String {
        match format {
            Format::Table => (self.table)(),
            Format::Json => (self.json)(),
            Format::Csv => (self.csv)(),
        }
    }
}

/// Significant digits of a physical quantity in text.
pub(super) const PLACES: usize = 5;

/// What an answer is about.
pub struct About {
    /// Name and title of a machine; `None` for the oscillator of the paper.
    pub(super) machine: Option<(String, String)>,
    /// Name and value of each number, as text shows them.
    pub(super) numbers: Vec<(String, String)>,
    /// The same as fields of a document.
    fields: Document,
}

impl About {
    /// The oscillator of the paper.
    pub fn oscillator(parameters: &Parameters) -> Self {
        let initial = State { q: 0.0, v: 0.0 };
        let number = |knob: Knob| (knob.to_string(), exact(knob.get(parameters, &initial), 24));
        About {
            machine: None,
            numbers: Knob::PARAMETERS.map(number).to_vec(),
            fields: Document::default().with("parameters", parameters),
        }
    }

    /// A machine, by the name under which it is opened, and its title.
    pub fn machine(name: &str, title: &str, subject: &Source) -> Self {
        // The numbers of the friction law are left out, and those for a mass at rest unless they are given.
        let is_own = |knob: Knob| match (knob, &subject.body) {
            (Knob::StaticCoefficient, Body::Belt(belt)) => belt.static_coefficient.is_some(),
            (Knob::StaticGuide, Body::Belt(belt)) => belt.static_guide.is_some(),
            (Knob::StaticGuide, Body::Mode(mode)) => mode.static_guide.is_some(),
            _ => knob.spec().group != Group::Law,
        };
        let number =
            |(knob, value): (Knob, f64)| (knob.to_string(), with_unit(value, 12, knob.spec().unit));
        let parameters = subject
            .numbers()
            .fold(Document::default(), |all, (knob, value)| all.with(knob.spec().name, value));
        About {
            machine: Some((name.to_owned(), title.to_owned())),
            numbers: subject.numbers().filter(|(knob, _)| is_own(*knob)).map(number).collect(),
            fields: Document::default().with("machine", name).with("parameters", parameters),
        }
    }

    /// The same without the numbers that vary in the answer.
    pub fn but(mut self, varied: &[Knob]) -> Self {
        self.numbers.retain(|(name, _)| varied.iter().all(|knob| knob.spec().name != name));
        self
    }

    /// What stands above an answer in text, with the intervals of the numbers that are not known exactly.
    pub(super) fn heading(&self, known: &[(Knob, Interval)]) -> String {
        let number = |(name, value): &(String, String)| {
            let known = known.iter().find(|(knob, _)| knob.spec().name == name);
            let known = known.filter(|(_, interval)| !interval.is_point());
            known.map_or_else(|| format!("{name} = {value}"), interval)
        };
        let numbers = self.numbers.iter().map(number).collect::<Vec<_>>().join(", ");
        match &self.machine {
            Some((name, title)) => format!("{name}: {title}\n{numbers}"),
            None => numbers,
        }
    }

    /// A quantity of a machine in its SI unit; of the oscillator of the paper a pure number with this many digits.
    pub(super) fn quantity(&self, unit: &'static str, digits: usize) -> Quantity {
        match &self.machine {
            Some(_) => Quantity::of(unit, PLACES),
            None => Quantity::pure(digits),
        }
    }

    /// The quantities of the two kinds of kicks: a displacement and an impulse.
    pub(super) fn kicks(&self, digits: usize) -> [Quantity; 2] {
        ["m", "N s"].map(|unit| self.quantity(unit, digits))
    }

    /// An answer about it and its cost, from what makes its fields, its rows, and its text.
    pub(super) fn answer<'a>(
        &'a self,
        cost: Cost,
        seconds: f64,
        document: impl FnOnce() -> Document + 'a,
        csv: impl FnOnce() -> String + 'a,
        table: impl FnOnce() -> String + 'a,
    ) -> Answer<'a> {
        let line = match &self.machine {
            Some(_) => format!("{} steps, {}\n", cost.steps, duration(seconds)),
            None => format!("{} evaluations, {}\n", cost.evaluations, duration(seconds)),
        };
        let json = move || self.json(&document(), &cost, seconds);
        Answer::new(json, csv, move || table() + &line)
    }

    /// A document about it, with its cost: of a machine, the steps.
    pub(super) fn json(&self, document: &Document, cost: &Cost, seconds: f64) -> String {
        let counted = match &self.machine {
            Some(_) => Document::default().with("steps", cost.steps),
            None => Document::default().and(cost),
        };
        self.fields.clone().and(document).cost(&counted, seconds).text()
    }
}

/// A number that is not known exactly: `R in 0.8 N .. 1.2 N`.
pub(super) fn interval((knob, interval): &(Knob, Interval)) -> String {
    let end = |value| with_unit(value, 12, knob.spec().unit);
    format!("{knob} in {} .. {}", end(interval.lower()), end(interval.upper()))
}
