//! Rows of a scan as text, one line each, for the command line, for files and for the explorer.
//!
//! A line begins with all inputs of its row, so that lines can be checked, sorted, and combined with those of
//! other scans, whichever file they come from.

use std::ops::Range;
use std::path::Path;

use super::{Format, lines};
use crate::scan::{Scan, ScanRow, Value, is_regime};
use crate::words::{ends_in, measurement};

/// Width of a column of the table: eight digits, sign, point and exponent.
const WIDTH: usize = 14;

/// Digits of a number in the table.
const DIGITS: usize = 8;

/// The rows of a scan that stand in one file: as JSON, an object on each line.
#[derive(Clone)]
pub struct ScanPart {
    /// The whole scan.
    pub scan: Scan,
    /// The form of its rows.
    pub form: Format,
    /// The points of these rows.
    pub points: Range<usize>,
    /// Whether they are preceded by a line of column names.
    pub headed: bool,
    /// The points between the brackets of one JSON document; `None` if each line is a document.
    pub brackets: Option<Range<usize>>,
}

impl Format {
    /// The ending of a file of rows, which is also the name of this form.
    pub fn ending(self) -> &'static str {
        if self == Format::Json { "json" } else { "csv" }
    }

    /// The form for a file of rows: JSON if its extension is `json` or `jsonl`, else CSV.
    pub fn of_file(path: &Path) -> Self {
        Format::of_ending(path).unwrap_or(Format::Csv)
    }

    /// The form for which the ending of a file stands, if it does for one; arrays are made of CSV.
    pub fn of_ending(path: &Path) -> Option<Self> {
        let has = |endings: &[&str]| endings.iter().any(|ending| ends_in(path, ending));
        let form = has(&["json", "jsonl"]).then_some(Format::Json);
        form.or_else(|| has(&["csv", "npz", "parquet"]).then_some(Format::Csv))
    }
}

impl ScanPart {
    /// The same in a file, which is one JSON document if it ends in `json`.
    #[must_use]
    pub fn in_file(self, path: &Path) -> Self {
        let is_one = ends_in(path, "json") && self.form == Format::Json;
        ScanPart { brackets: is_one.then(|| self.points.clone()), ..self }
    }

    /// The line before the rows; empty if there is none.
    pub fn heading(&self) -> String {
        let inputs = self.inputs(0).into_iter().map(|(name, _)| name);
        let measured = self.scan.measured().into_iter().filter(|name| self.shows(name));
        let names = inputs.chain(measured.map(str::to_owned));
        match self.form {
            _ if !self.headed => String::new(),
            Format::Csv => names.map(|name| name + ",").collect::<String>() + "reason\n",
            Format::Json => String::new(),
            Format::Table => {
                names.map(|name| column(&name)).collect::<String>().trim_end().to_owned() + "\n"
            }
        }
    }

    /// The beginning of the row of point `index`, which does not depend on what is measured there.
    pub fn beginning(&self, index: usize) -> String {
        let inputs = self.inputs(index).into_iter();
        let cells = inputs.map(|(name, value)| self.cell(&name, value));
        std::iter::once(self.opening(index).to_owned()).chain(cells).collect()
    }

    /// The row of point `index`.
    pub fn line(&self, index: usize, row: &ScanRow) -> String {
        let mut line = self.beginning(index);
        let values = self.scan.measured().into_iter().zip(&row.values);
        line.extend(
            values
                .filter(|(name, _)| self.shows(name))
                .map(|(name, value)| self.cell(name, *value)),
        );
        let reason = row.reason.clone();
        match self.form {
            // After another cell, as an empty one alone would be quoted.
            Format::Csv => {
                line + &lines([vec![String::new(), reason.unwrap_or_default()]]).split_off(1)
            }
            Format::Json => {
                format!("{line}\"reason\":{}}}{}", serde_json::Value::from(reason), self.end(index))
            }
            Format::Table => {
                let reason = reason.map(|why| format!("  {why}")).unwrap_or_default();
                (line + &reason).trim_end().to_owned() + "\n"
            }
        }
    }

    /// What stands before the first value of a row.
    fn opening(&self, index: usize) -> &'static str {
        match &self.brackets {
            _ if self.form != Format::Json => "",
            None => "{",
            Some(all) if index == all.start => "[{",
            Some(_) => ",{",
        }
    }

    /// What stands behind an object.
    fn end(&self, index: usize) -> &'static str {
        let is_last = |all: &Range<usize>| index + 1 == all.end;
        if self.brackets.as_ref().is_some_and(is_last) {
            "]\n"
        } else {
            "\n"
        }
    }

    /// The line of a part of the same scan as it stands in this one.
    pub fn line_of(&self, index: usize, line: &[u8]) -> Vec<u8> {
        if self.form != Format::Json {
            return line.to_vec();
        }
        let behind = |of: Option<usize>| of.map_or(0, |at| at + 1);
        let from = behind(line.iter().position(|byte| *byte == b'{'));
        let to = behind(line.iter().rposition(|byte| *byte == b'}')).max(from);
        let [open, close] = [self.opening(index), self.end(index)].map(str::as_bytes);
        [open, &line[from..to], close].concat()
    }

    /// Whether a measured column is shown: how to read a margin is for programs.
    fn shows(&self, name: &str) -> bool {
        self.form != Format::Table || !is_regime(name)
    }

    /// The inputs at a point, of which the table shows those that vary.
    fn inputs(&self, index: usize) -> Vec<(String, Value)> {
        let mut inputs = self.scan.inputs(index);
        if self.form == Format::Table {
            let varied = self.scan.varied();
            inputs.retain(|(name, _)| varied.iter().any(|symbol| symbol.spec().name == name));
        }
        inputs
    }

    /// A value with its separator.
    fn cell(&self, name: &str, value: Value) -> String {
        match (self.form, value) {
            (Format::Table, _) => column(&measurement(value, Some(DIGITS))),
            (Format::Csv, _) => measurement(value, None) + ",",
            (Format::Json, Value::Nothing) => format!("\"{name}\":null,"),
            (Format::Json, Value::Word(word)) => format!("\"{name}\":\"{word}\","),
            (Format::Json, _) => format!("\"{name}\":{},", measurement(value, None)),
        }
    }
}

fn column(text: &str) -> String {
    format!("{text:>WIDTH$}  ")
}
