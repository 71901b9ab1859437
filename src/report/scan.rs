//! Rows of a scan as text, one line each, for the command line, for files and for the explorer.
//!
//! A line begins with all inputs of its row, so that lines can be checked, sorted, and combined with those of
//! other scans, whichever file they come from.

use super::Format;
use super::columns::lines;
use crate::scan::grid::{Scan, ScanRow};
use crate::scan::measure::Value;
use crate::words::measured::{exact, rounded};

/// Width of a column of the table: eight digits, sign, point and exponent.
const WIDTH: usize = 14;

/// The rows of a scan: as JSON, an object on each line.
impl Format {
    /// The form for a file: JSON if its extension is `json` or `jsonl`, else CSV.
    pub fn of_file(path: &std::path::Path) -> Self {
        let ending = path.extension();
        let json = ending.is_some_and(|ending| ending == "json" || ending == "jsonl");
        if json { Format::Json } else { Format::Csv }
    }

    /// The line before the rows; empty if the form has none.
    pub fn heading(self, scan: &Scan) -> String {
        let inputs = scan.inputs(0).into_iter().map(|(name, _)| name);
        let measured = scan.measured().into_iter().chain(["reason"]).map(str::to_owned);
        match self {
            Format::Csv => inputs.chain(measured).collect::<Vec<_>>().join(",") + "\n",
            Format::Json => String::new(),
            Format::Table => {
                let varied: Vec<_> =
                    scan.over().iter().map(|sweep| sweep.symbol.spec().name).collect();
                let names = varied.into_iter().chain(scan.measured());
                names.map(column).collect::<String>().trim_end().to_owned() + "\n"
            }
        }
    }

    /// The beginning of the row of point `index`, which does not depend on what is measured there.
    pub fn beginning(self, scan: &Scan, index: usize) -> String {
        let inputs = scan.inputs(index).into_iter();
        match self {
            Format::Csv => inputs.map(|(_, value)| exact(value) + ",").collect(),
            Format::Json => {
                let fields = inputs.map(|(name, value)| field(&name, value) + ",");
                std::iter::once("{".to_owned()).chain(fields).collect()
            }
            Format::Table => {
                let varies =
                    |name: &str| scan.over().iter().any(|sweep| sweep.symbol.spec().name == name);
                inputs
                    .filter(|(name, _)| varies(name))
                    .map(|(_, value)| column(&rounded(value)))
                    .collect()
            }
        }
    }

    /// The row of point `index`.
    pub fn line(self, scan: &Scan, index: usize, row: &ScanRow) -> String {
        let mut line = self.beginning(scan, index);
        let values = row.values.iter().copied();
        match self {
            Format::Csv => {
                let cells = values.map(exact).chain([row.reason.clone().unwrap_or_default()]);
                line += &lines([cells.collect()]);
            }
            Format::Json => {
                for (name, value) in scan.measured().into_iter().zip(values) {
                    line += &(field(name, value) + ",");
                }
                let reason = serde_json::Value::from(row.reason.clone());
                line += &format!("\"reason\":{reason}}}\n");
            }
            Format::Table => {
                line.extend(values.map(|value| column(&rounded(value))));
                if let Some(reason) = &row.reason {
                    line += &format!("  {reason}");
                }
                line.truncate(line.trim_end().len());
                line.push('\n');
            }
        }
        line
    }
}

fn field(name: &str, value: Value) -> String {
    match value {
        Value::Nothing => format!("\"{name}\":null"),
        Value::Word(word) => format!("\"{name}\":\"{word}\""),
        Value::Number(_) | Value::Count(_) => format!("\"{name}\":{}", exact(value)),
    }
}

fn column(text: &str) -> String {
    format!("{text:>WIDTH$}  ")
}
