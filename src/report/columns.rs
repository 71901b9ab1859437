//! The columns of an answer, each told once: its name in files, its title in text, its quantity, and its value in a
//! row. The aligned table, the comma-separated values and the objects of a document follow.

use std::borrow::Borrow;

use csv::Writer;
use serde::Serialize;
use serde_json::Value;

use super::{Document, Table, json};
use crate::numerics::{Interval, cells, log10, pow};
use crate::words::{joined, rounded_down, significant, with_unit};

/// What columns are called in text, where that is not their name in files, a line each.
const TITLES: &str = include_str!("../../assets/titles.txt");

/// The title in text of a column with this name in files.
fn title(name: &str) -> &str {
    let mut titles = TITLES.lines().filter_map(cells);
    titles.find(|[known, _]| *known == name).map_or(name, |[_, title]| title)
}

/// What the numbers of a column measure, and how text shows them; files have all their digits, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    unit: &'static str,
    digits: usize,
    absent: &'static str,
}

impl Quantity {
    /// A pure number.
    pub const fn pure(digits: usize) -> Self {
        Quantity::of("", digits)
    }

    /// A number in an SI unit, which text shows with a prefix.
    pub const fn of(unit: &'static str, digits: usize) -> Self {
        Quantity { unit, digits, absent: "-" }
    }

    /// The word of text for a number that does not exist, in place of `-`.
    pub const fn or(self, absent: &'static str) -> Self {
        Quantity { absent, ..self }
    }

    /// The number with the digits that text shows, and not above it.
    pub fn down(self, value: f64) -> f64 {
        rounded_down(value, self.digits)
    }

    /// The number as text shows it.
    pub fn text(self, value: impl Into<Option<f64>>) -> String {
        let shown = |value| with_unit(value, self.digits, self.unit);
        value.into().map_or_else(|| self.absent.to_owned(), shown)
    }
}

/// Rows `R` or references to them.
pub trait RowsOf<R>: IntoIterator<Item: Borrow<R>> {}

impl<R, I: IntoIterator<Item: Borrow<R>>> RowsOf<R> for I {}

/// Columns of rows `R`, in their order. What differs from column to column is boxed at once: each of them is compiled,
/// and there are some two hundred.
pub struct Columns<'a, R> {
    files: Vec<FileColumn>,
    fields: Vec<Field<'a, R>>,
    texts: Vec<TextColumn<'a, R>>,
}

/// Adds a field, or several, to the object of a row.
type Field<'a, R> = Box<dyn Fn(Document, &R) -> Document + 'a>;

/// A column of comma-separated values, which are those of the object of a row.
struct FileColumn {
    name: String,
    /// The names that lead to its value in the object.
    place: Vec<String>,
}

struct TextColumn<'a, R> {
    title: String,
    cell: Box<dyn Fn(&R) -> String + 'a>,
}

impl<R> Default for Columns<'_, R> {
    fn default() -> Self {
        Columns { files: Vec::new(), fields: Vec::new(), texts: Vec::new() }
    }
}

impl<'a, R: 'a> Columns<'a, R> {
    /// A column of files alone.
    pub fn file<V: Serialize>(self, name: &str, value: impl Fn(&R) -> V + 'a) -> Self {
        self.column(name.to_owned(), [name]).field(name, value)
    }

    /// A field of documents alone.
    pub fn field<V: Serialize>(mut self, name: &str, value: impl Fn(&R) -> V + 'a) -> Self {
        let name = name.to_owned();
        self.fields.push(Box::new(move |object, row| object.with(&name, value(row))));
        self
    }

    fn column<'n>(mut self, name: String, place: impl IntoIterator<Item = &'n str>) -> Self {
        let place = place.into_iter().map(str::to_owned).collect();
        debug_assert!(self.files.iter().all(|it| it.place != place), "two columns at {place:?}");
        self.files.push(FileColumn { name, place });
        self
    }

    /// A column of text alone: words, counts or marks, and `-` for what does not exist.
    pub fn text<V: Serialize>(self, title: &str, value: impl Fn(&R) -> V + 'a) -> Self {
        self.shown(title, Box::new(move |row| shown(&json::value(&value(row)))))
    }

    fn shown(mut self, title: &str, cell: Box<dyn Fn(&R) -> String + 'a>) -> Self {
        self.texts.push(TextColumn { title: title.to_owned(), cell });
        self
    }

    /// Numbers, which text shows by their quantity.
    pub fn number<V: Into<Option<f64>>>(
        self,
        name: &'static str,
        quantity: Quantity,
        value: impl Fn(&R) -> V + Copy + 'a,
    ) -> Self {
        self.file(name, move |row| value(row).into())
            .shown(title(name), Box::new(move |row| quantity.text(value(row))))
    }

    /// Words, counts or marks, in files and in text.
    pub fn word<V: Serialize>(self, name: &str, value: impl Fn(&R) -> V + Copy + 'a) -> Self {
        self.file(name, value).text(title(name), value)
    }

    /// Both ends of an interval that is proved, as `name_lower` and `name_upper`; in text its certain digits.
    pub fn bounds(self, name: &str, value: impl Fn(&R) -> Option<Interval> + Copy + 'a) -> Self {
        ENDS.into_iter()
            .fold(self, |all, end| all.column(format!("{name}_{end}"), [name, end]))
            .field(name, move |row| value(row).map(bounds))
            .text(&format!("{}, proved", title(name)), move |row| value(row).map(certain))
    }

    /// A column of files for each field of records like `example` that is neither a record nor a list.
    pub fn fields<T: Serialize>(
        mut self,
        example: &T,
        record: impl Fn(&R) -> Option<T> + 'a,
    ) -> Self {
        for name in Document::default().and(example).singles() {
            self = self.column(name.to_owned(), [name]);
        }
        self.fields
            .push(Box::new(move |object, row| record(row).iter().fold(object, Document::and)));
        self
    }

    /// The columns that describe a part of a row; in a document they are the field `name`, which is left out of a row
    /// without that part.
    pub fn part<P: 'a>(
        mut self,
        name: &'static str,
        mut columns: Columns<'a, P>,
        part: impl Fn(&R) -> Option<P> + Copy + 'a,
    ) -> Self {
        for TextColumn { title, cell } in std::mem::take(&mut columns.texts) {
            self = self.text(&title, move |row| part(row).map(|part| cell(&part)));
        }
        for column in std::mem::take(&mut columns.files) {
            let place = std::iter::once(name).chain(column.place.iter().map(String::as_str));
            self = self.column(column.name, place);
        }
        self.fields.push(Box::new(move |object, row| {
            object.with_any(name, part(row).map(|part| columns.object(&part)))
        }));
        self
    }

    /// The columns of `more` after these, if there are any.
    pub fn and(mut self, more: impl Into<Option<Self>>) -> Self {
        let more = more.into().unwrap_or_default();
        self.files.extend(more.files);
        self.fields.extend(more.fields);
        self.texts.extend(more.texts);
        self
    }

    /// The rows as text.
    pub fn table(&self, rows: impl RowsOf<R>) -> Table {
        let titles = self.texts.iter().map(|column| column.title.clone()).collect();
        let cells = |row: &R| self.texts.iter().map(|column| (column.cell)(row)).collect();
        Table::new(titles, rows.into_iter().map(|row| cells(row.borrow())).collect())
    }

    /// The rows below a line of names.
    pub fn csv(&self, rows: impl RowsOf<R>) -> String {
        csv(&self.files, &mut rows.into_iter().map(|row| self.object(row.borrow())))
    }

    /// A row as an object.
    pub fn object(&self, row: &R) -> Document {
        self.fields.iter().fold(Document::default(), |object, field| field(object, row))
    }

    /// An object for each row.
    pub fn objects(&self, rows: impl RowsOf<R>) -> Vec<Document> {
        rows.into_iter().map(|row| self.object(row.borrow())).collect()
    }
}

/// Objects below the names of columns.
fn csv(columns: &[FileColumn], objects: &mut dyn Iterator<Item = Document>) -> String {
    let names = columns.iter().map(|column| column.name.clone()).collect();
    let cells = |object: Document| {
        columns.iter().map(|column| cell(object.at(&column.place))).collect::<Vec<_>>()
    };
    lines(std::iter::once(names).chain(objects.map(cells)))
}

/// The names of the two ends of an interval.
const ENDS: [&str; 2] = ["lower", "upper"];

/// An interval in a document; an infinite end is null.
pub fn bounds(it: Interval) -> Document {
    Document::of(ENDS[0], it.lower()).with(ENDS[1], it.upper())
}

/// A value with all its digits: the shortest decimal that reads back as the same double, as `0.1`, `-3.0`, `1e-300`;
/// words of a list with blanks between them; an empty cell for one that does not exist.
fn cell(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => {
            number.as_f64().map_or_else(String::new, |value| format!("{value:?}"))
        }
        Value::Number(_) | Value::Bool(_) => value.to_string(),
        Value::String(text) => text.clone(),
        Value::Array(words) => joined(words.iter().map(cell), " "),
        Value::Null | Value::Object(_) => String::new(),
    }
}

/// A cell of text.
fn shown(value: &Value) -> String {
    if value.is_null() { "-".to_owned() } else { cell(value) }
}

/// Comma-separated values: a line for each row of cells; a cell that contains a separator or a quote is quoted.
pub(super) fn lines(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut out = Writer::from_writer(Vec::new());
    for cells in rows {
        // Cannot fail: a vector accepts every write, and all rows have the same length.
        let _ = out.write_record(&cells);
    }
    String::from_utf8(out.into_inner().unwrap_or_default()).unwrap_or_default()
}

/// Most digits of an enclosure.
const PLACES: usize = 12;

/// The digits on which both ends of an enclosure agree. If there are none: a power of ten as a bound of a number that
/// overflows or underflows, else `?`.
pub(super) fn certain(value: Interval) -> String {
    let ends = |digits| [value.lower(), value.upper()].map(|end| significant(end, digits));
    let agreed = (1..=PLACES).rev().map(ends).find(|[lower, upper]| lower == upper);
    agreed.map(|[digits, _]| digits).or_else(|| beyond(value)).unwrap_or_else(|| "?".to_owned())
}

/// `> 1e149` for an enclosure without an upper end that lies above 1e100, `< 1e-322` for one that reaches from 0
/// to less than 1e-100.
fn beyond(value: Interval) -> Option<String> {
    const HUGE: f64 = 1e100;
    let power = |of: f64| log10(of).floor();
    if value.lower() > HUGE && value.upper() == f64::INFINITY {
        return Some(format!("> 1e{}", power(value.lower()) - 1.0));
    }
    let tiny = value.lower() == 0.0 && value.upper() < 1.0 / HUGE;
    tiny.then(|| format!("< 1e{}", power(value.upper()) + 2.0))
}

/// The ends of an interval, rounded outward to six digits.
pub(super) fn ends(it: Interval) -> String {
    if !it.is_finite() {
        return certain(it);
    }
    let step = |value: f64| {
        let digits = pow(10.0, log10(value.abs()).floor() - 5.0);
        if digits.is_finite() { digits } else { 0.0 }
    };
    let end = |value: f64, sign: f64| {
        let near = significant(value, 6);
        let read: f64 = near.parse().unwrap_or(f64::NAN);
        let inside = sign * (value - read) > 0.0;
        if inside {
            significant(value + sign * step(value), 6)
        } else {
            near
        }
    };
    format!("{} .. {}", end(it.lower(), -1.0), end(it.upper(), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::State;

    #[test]
    fn each_line_of_titles_is_of_another_column_of_a_report() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/report");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let files = files.filter_map(|file| std::fs::read_to_string(file).ok());
        let reports: String = files.collect::<String>().split_whitespace().collect();
        let mut met = std::collections::BTreeSet::new();
        for line in TITLES.lines().filter(|line| !(line.is_empty() || line.starts_with('#'))) {
            let Some([name, _]) = cells(line) else { panic!("{line}") };
            assert!(met.insert(name), "{name}");
            let is = |form| reports.contains(&format!(".{form}(\"{name}\","));
            assert!(["number", "word", "bounds"].into_iter().any(is), "no column {name}");
        }
    }

    #[test]
    fn a_column_is_told_once_for_every_form() {
        let lost = Columns::default().bounds("loss", |loss: &Interval| Some(*loss));
        let columns = Columns::default()
            .number("area", Quantity::of("m", 3).or("any"), |(size, _): &(Option<f64>, bool)| *size)
            .word("kind", |_| "a,b")
            .fields(&State { q: 0.0, v: 0.0 }, |(size, _)| size.map(|q| State { q, v: 1.0 }))
            .part("lost", lost, |(_, is_lost)| {
                is_lost.then_some(Interval::new(0.0, f64::INFINITY))
            });
        let rows = || [(Some(0.012_345), true), (None, false)];
        let table = "area of the basin  kind  loss, proved\n          12.3 mm  a,b   ?\n         any       a,b   -\n";
        assert_eq!(columns.table(rows()).to_string(), table);
        let csv = "area,kind,q,v,loss_lower,loss_upper\n\
                   0.012345,\"a,b\",0.012345,1.0,0.0,\n,\"a,b\",,,,\n";
        assert_eq!(columns.csv(rows()), csv);
        let objects = concat!(
            r#"[{"area":0.012345,"kind":"a,b","q":0.012345,"v":1.0,"#,
            r#""lost":{"loss":{"lower":0.0,"upper":null}}},"#,
            r#"{"area":null,"kind":"a,b"}]"#,
            "\n"
        );
        assert_eq!(json::text(&columns.objects(rows())), objects);
    }

    #[test]
    fn numbers_have_all_their_digits() {
        let values = [Value::from(0.1 + 0.2), Value::from(-3.0), Value::from(5e-5)];
        assert_eq!(values.map(|value| cell(&value)), ["0.30000000000000004", "-3.0", "5e-5"]);
        assert_eq!([Value::from(2), Value::from(f64::NAN)].map(|value| cell(&value)), ["2", ""]);
    }

    #[test]
    fn cells_with_separators_are_quoted() {
        let cells = ["a,b", "say \"x\"", "plain"].map(str::to_owned);
        assert_eq!(lines([cells.to_vec()]), "\"a,b\",\"say \"\"x\"\"\",plain\n");
    }

    #[test]
    fn only_digits_on_which_both_ends_agree_are_shown() {
        assert_eq!(certain(Interval::new(0.123_449, 0.123_451)), "0.12345");
        assert_eq!(certain(Interval::new(0.123_44, 0.123_46)), "0.123");
        assert_eq!(certain(Interval::new(1.0, 3.0)), "?");
        assert_eq!(certain(Interval::new(1.0, f64::INFINITY)), "?");
        assert_eq!(certain(Interval::new(1.3e150, f64::INFINITY)), "> 1e149");
        assert_eq!(certain(Interval::new(0.0, 5e-324)), "< 1e-322");
        assert_eq!(certain(Interval::point(0.1)), "0.1");
    }
}
