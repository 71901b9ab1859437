//! An answer, made in the form that is asked for, and what it is about: the oscillator of the paper without units, or a
//! machine in SI units.

use clap::ValueEnum;
use serde::Serialize;
use serde_json::Value;

use super::{Columns, Document, Quantity, RowsOf, Table, json};
use crate::flow::Cost;
use crate::model::{Body, Group, Interval, Knob, ParameterBox, Source};
use crate::words::printable::signs;
use crate::words::provenance::Provenance;
use crate::words::{duration, joined, shortest, with_unit, wrapped};

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

/// An answer in every form, or in the only one that is asked for.
#[derive(Default)]
pub struct Answer {
    /// The only form that is made: the others of a long answer would cost more than its computation.
    only: Option<Format>,
    /// What it is about, in two parts of a line.
    pub(super) head: [String; 2],
    /// Its tables and lines, for reading.
    pub(super) parts: Vec<Part>,
    /// What it cost, for reading.
    cost: Option<String>,
    /// Whether its steps are all that was counted.
    by_steps: bool,
    csv: String,
    document: Document,
    /// What its document consists of, if that is a list.
    list: Option<Vec<Document>>,
}

/// What stands in an answer for reading.
pub(super) enum Part {
    /// A heading of a page, which text leaves out.
    Heading(&'static str),
    /// The sentence that is signed, and whether all that it rests on holds.
    Statement {
        text: String,
        holds: bool,
    },
    Line(String),
    Table(Table),
}

impl Answer {
    /// An answer about a thing with a name, and what there is to say of it.
    pub(super) fn new(name: &str, subject: String) -> Self {
        Answer { head: [name.to_owned(), subject], ..Answer::default() }
    }

    /// Whether a form is made.
    fn makes(&self, format: Format) -> bool {
        self.only.is_none_or(|only| only == format)
    }

    /// With a field of its document.
    pub(super) fn with(self, name: &str, value: impl Serialize) -> Self {
        self.with_any(name, Some(value))
    }

    /// With a field of its document, or without it if there is no value.
    pub(super) fn with_any(self, name: &str, value: Option<impl Serialize>) -> Self {
        let value = value.filter(|_| self.makes(Format::Json));
        Answer { document: self.document.with_any(name, value), ..self }
    }

    /// With these rows as a field of its document.
    pub(super) fn with_rows<R>(
        self,
        name: &str,
        columns: &Columns<R>,
        rows: impl RowsOf<R>,
    ) -> Self {
        let objects = self.makes(Format::Json).then(|| columns.objects(rows));
        self.with_any(name, objects)
    }

    /// With another field of each object in a list of its document.
    pub(super) fn extended<V: Serialize>(
        mut self,
        list: &str,
        name: &str,
        values: impl IntoIterator<Item = V>,
    ) -> Self {
        let objects = self.document.list(list).into_iter().flatten();
        objects.zip(values).for_each(|(object, value)| object[name] = json::value(&value));
        self
    }

    /// With the fields of a record in its document.
    pub(super) fn and(self, record: &impl Serialize) -> Self {
        Answer { document: self.document.and(record), ..self }
    }

    /// An answer that is a list in every form; the last cells of its table are wrapped to a width, if one is given.
    pub fn list_of<R>(columns: &Columns<R>, rows: &[R], width: Option<usize>) -> Self {
        Answer::default()
            .list(columns.objects(rows))
            .csv(columns, rows)
            .table(columns.table(rows).unbroken(width))
    }

    /// With a document that is a list.
    pub(super) fn list(self, objects: Vec<Document>) -> Self {
        Answer { list: Some(objects), ..self }
    }

    /// With these rows in files.
    pub(super) fn csv<R>(self, columns: &Columns<R>, rows: impl RowsOf<R>) -> Self {
        let csv = if self.makes(Format::Csv) {
            columns.csv(rows)
        } else {
            String::new()
        };
        Answer { csv, ..self }
    }

    /// With these rows for reading.
    pub(super) fn table_of<R>(self, columns: &Columns<R>, rows: impl RowsOf<R>) -> Self {
        if self.makes(Format::Table) {
            self.table(columns.table(rows))
        } else {
            self
        }
    }

    /// With a table for reading; nothing if it has no rows.
    pub(super) fn table(mut self, table: Table) -> Self {
        self.parts.push(Part::Table(table));
        self
    }

    /// With these rows in files and for reading.
    pub(super) fn rows<R>(self, columns: &Columns<R>, rows: impl RowsOf<R> + Clone) -> Self {
        self.csv(columns, rows.clone()).table_of(columns, rows)
    }

    /// With rows of cells below these names, in files and for reading, and as a list of its document if that has a name.
    pub fn points(self, list: Option<&str>, names: &[&'static str], rows: &[Vec<Value>]) -> Self {
        const NUMBER: Quantity = Quantity::pure(10);
        let columns = names.iter().enumerate().fold(Columns::default(), |all, (at, name)| {
            all.file(name, move |row: &Vec<Value>| row[at].clone()).text(name, move |row| {
                let cell = &row[at];
                let number = cell.as_f64().filter(|_| cell.is_f64());
                number.map_or(cell.clone(), |number| NUMBER.text(number).into())
            })
        });
        let answer = list.into_iter().fold(self, |all, list| all.with_rows(list, &columns, rows));
        answer.rows(&columns, rows)
    }

    /// With a heading of a page.
    pub(super) fn heading(mut self, heading: &'static str) -> Self {
        self.parts.push(Part::Heading(heading));
        self
    }

    /// With the sentence that is signed, and whether all that it rests on holds.
    pub(super) fn statement(mut self, text: String, holds: bool) -> Self {
        self.parts.push(Part::Statement { text, holds });
        self
    }

    /// With lines for reading.
    pub(super) fn lines<S: Into<String>>(mut self, lines: impl IntoIterator<Item = S>) -> Self {
        self.parts.extend(lines.into_iter().map(|line| Part::Line(signs(&line.into()))));
        self
    }

    /// With its cost: of a machine, the steps.
    pub fn cost(self, cost: Cost, seconds: f64) -> Self {
        let (line, counted) = if self.by_steps {
            (format!("{} steps", cost.steps), Document::of("steps", cost.steps))
        } else {
            (format!("{} evaluations", cost.evaluations), Document::default().and(&cost))
        };
        self.costing(&line, counted, seconds)
    }

    /// With a line about its cost, and the same as fields.
    pub(super) fn costing(self, line: &str, counted: Document, seconds: f64) -> Self {
        let cost = Some(format!("{line}, {}", duration(seconds)));
        Answer { cost, ..self.with("cost", counted.with("seconds", seconds)) }
    }

    /// The same with its lines, and those of its tables, wrapped to a width.
    pub(super) fn within(mut self, width: usize) -> Self {
        let wrap = |text: &str| wrapped(text, width).join("\n");
        self.cost = self.cost.map(|cost| wrap(&cost));
        self.parts = self
            .parts
            .into_iter()
            .map(|part| match part {
                Part::Table(table) => Part::Table(table.unbroken(Some(width))),
                Part::Line(text) => Part::Line(wrap(&text)),
                part => part,
            })
            .collect();
        self
    }

    /// With where it comes from, as a field of its document; a list has no place for it.
    pub fn from(self, provenance: &Provenance) -> Self {
        self.with("provenance", provenance)
    }

    /// Its document, or the list that it consists of.
    pub fn document(self) -> Value {
        match self.list {
            Some(list) => json::value(&list),
            None => json::value(&self.document),
        }
    }

    /// The answer in a form.
    pub fn told(self, format: Format) -> String {
        match (format, self.list) {
            (Format::Table, _) => text(self.head, self.parts, self.cost),
            (Format::Json, Some(list)) => json::text(&list),
            (Format::Json, None) => json::text(&self.document),
            (Format::Csv, _) => self.csv,
        }
    }
}

/// An answer for reading: around tables are empty lines.
fn text(head: [String; 2], parts: Vec<Part>, cost: Option<String>) -> String {
    let line = |text: String| if text.is_empty() { text } else { text + "\n" };
    let head = head.into_iter().filter(|part| !part.is_empty());
    let mut out = line(joined(head, ": "));
    let mut after_table = false;
    for part in parts.into_iter().chain(cost.map(Part::Line)) {
        let is_table = matches!(part, Part::Table(_));
        let text = match part {
            Part::Heading(_) => continue,
            Part::Statement { text, .. } | Part::Line(text) => line(text),
            Part::Table(table) => table.to_string(),
        };
        if text.is_empty() {
            continue;
        }
        let apart = !out.is_empty() && (is_table || after_table);
        out += if apart { "\n" } else { "" };
        out += &text;
        after_table = is_table;
    }
    out
}

/// Significant digits of a physical quantity in text.
pub(super) const PLACES: usize = 5;

/// What an answer is about.
pub struct About {
    /// The only form in which it is answered.
    only: Option<Format>,
    /// Name and title of a machine; `None` for the oscillator of the paper.
    machine: Option<(String, String)>,
    /// Every number, where it lies, and whether text shows it.
    numbers: Vec<(Knob, Interval, bool)>,
}

impl About {
    /// The oscillator of the paper at all parameters in a box.
    pub fn boxed(known: &ParameterBox) -> Self {
        let numbers = Knob::PARAMETERS.into_iter().zip(known.numbers());
        let numbers = numbers.map(|(knob, known)| (knob, known, true)).collect();
        About { only: None, machine: None, numbers }
    }

    /// The oscillator of the paper, or a machine by the name under which it is opened, and its title.
    pub fn new(name: &str, title: &str, source: &Source) -> Self {
        // The numbers of the friction law are left out, and those for a mass at rest unless they are given.
        let is_own = |knob: Knob| match (knob, &source.body) {
            (Knob::StaticCoefficient, Body::Belt(belt)) => belt.static_coefficient.is_some(),
            (Knob::StaticGuide, Body::Belt(belt)) => belt.static_guide.is_some(),
            (Knob::StaticGuide, Body::Mode(mode)) => mode.static_guide.is_some(),
            _ => knob.spec().group != Group::Law,
        };
        let number = |(knob, value): (Knob, f64)| (knob, Interval::point(value), is_own(knob));
        let is_machine = !matches!(source.body, Body::Paper(_));
        let machine = is_machine.then(|| (name.to_owned(), title.to_owned()));
        About { only: None, machine, numbers: source.numbers().map(number).collect() }
    }

    /// Whether it is a machine.
    pub fn is_machine(&self) -> bool {
        self.machine.is_some()
    }

    /// The same with numbers that are not known exactly.
    pub fn within(mut self, known: &[(Knob, Interval)]) -> Self {
        for (knob, own, _) in &mut self.numbers {
            let interval = known.iter().find(|(known, _)| known == knob);
            *own = interval.map_or(*own, |(_, interval)| *interval);
        }
        self
    }

    /// The same without the numbers that vary in the answer.
    pub fn but(mut self, varied: &[Knob]) -> Self {
        for (knob, _, is_shown) in &mut self.numbers {
            *is_shown &= !varied.contains(knob);
        }
        self
    }

    /// The same, to be answered in one form only.
    pub fn told_as(self, format: Format) -> Self {
        About { only: Some(format), ..self }
    }

    /// Its numbers on a line.
    pub(super) fn heading(&self) -> String {
        let number = |(knob, known, _): &(Knob, Interval, bool)| match &self.machine {
            _ if !known.is_point() => interval(&(*knob, *known)),
            Some(_) => format!("{knob} = {}", with_unit(known.lower(), 12, knob.spec().unit)),
            None => format!("{knob} = {}", shortest(known.lower())),
        };
        let shown = self.numbers.iter().filter(|(.., is_shown)| *is_shown);
        joined(shown.map(number), ", ")
    }

    /// Its numbers as fields of a document.
    pub(super) fn parameters<T: Serialize>(&self, value: impl Fn(Interval) -> T) -> Document {
        let numbers = self.numbers.iter();
        numbers.fold(Document::default(), |all, (knob, known, _)| {
            all.with(knob.spec().name, value(*known))
        })
    }

    /// An answer about it.
    pub(super) fn answer(&self) -> Answer {
        self.answer_to("")
    }

    /// An answer about it, and more about the question.
    pub(super) fn answer_to(&self, question: &str) -> Answer {
        let numbers = self.heading() + question;
        let parameters = self.parameters(Interval::lower);
        let answer = match &self.machine {
            Some((name, title)) => {
                let answer = Answer { by_steps: true, ..Answer::new(name, title.clone()) };
                Answer { only: self.only, ..answer }.lines([numbers]).with("machine", name)
            }
            None => Answer { only: self.only, ..Answer::new("", numbers) },
        };
        answer.with("parameters", parameters)
    }

    /// A quantity of a machine in its SI unit; of the oscillator of the paper a pure number with this many digits.
    pub(super) fn quantity(&self, unit: &'static str, digits: usize) -> Quantity {
        match &self.machine {
            Some(_) => Quantity::of(unit, PLACES),
            None => Quantity::pure(digits),
        }
    }
}

/// A number that is not known exactly: `R in 0.8 N .. 1.2 N`.
pub(super) fn interval((knob, interval): &(Knob, Interval)) -> String {
    let end = |value| with_unit(value, 12, knob.spec().unit);
    format!("{knob} in {} .. {}", end(interval.lower()), end(interval.upper()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_says_last_where_it_comes_from_and_a_list_stays_as_it_is() {
        let own = Provenance::of(&["cycles".to_owned()]);
        let told = |answer: Answer| answer.from(&own).told(Format::Json);
        let document = told(Answer::default().with("a", [1.0]).cost(Cost::default(), 0.0));
        let read: serde_json::Value = serde_json::from_str(&document).unwrap();
        assert_eq!(read["provenance"]["command"], "hopfscope cycles", "{document}");
        let names: Vec<&String> = read.as_object().unwrap().keys().collect();
        assert_eq!(names, ["a", "cost", "provenance"]);
        assert_eq!(told(Answer::default().list(vec![])), "[]\n");
    }
}
