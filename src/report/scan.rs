//! Rows of a scan as text, one line each, for the command line, for files and for the explorer.
//!
//! A line begins with all inputs of its row, so that lines can be checked, sorted, and combined with those of
//! other scans, whichever file they come from.

use clap::ValueEnum;

use super::csv;
use crate::scan::grid::{Scan, ScanRow};
use crate::scan::measure::Value;
use crate::words::measured::{exact, rounded};

/// The form of the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RowForm {
    /// Aligned columns, to read.
    Table,
    /// One object per line, all digits.
    #[value(alias = "jsonl")]
    Json,
    /// One row per line after a line of names, all digits.
    Csv,
}

/// Width of a column of the table: eight digits, sign, point and exponent.
const WIDTH: usize = 14;

impl RowForm {
    /// The form for a file: JSON if its extension is `json` or `jsonl`, else CSV.
    pub fn of_file(path: &std::path::Path) -> Self {
        let ending = path.extension();
        let json = ending.is_some_and(|ending| ending == "json" || ending == "jsonl");
        if json { RowForm::Json } else { RowForm::Csv }
    }

    /// The line before the rows; empty if the form has none.
    pub fn heading(self, scan: &Scan) -> String {
        let inputs = scan.inputs(0).into_iter().map(|(name, _)| name);
        let measured = scan.measured().into_iter().chain(["reason"]).map(str::to_owned);
        match self {
            RowForm::Csv => inputs.chain(measured).collect::<Vec<_>>().join(",") + "\n",
            RowForm::Json => String::new(),
            RowForm::Table => {
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
            RowForm::Csv => inputs.map(|(_, value)| exact(value) + ",").collect(),
            RowForm::Json => {
                let fields = inputs.map(|(name, value)| field(&name, value) + ",");
                std::iter::once("{".to_owned()).chain(fields).collect()
            }
            RowForm::Table => {
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
            RowForm::Csv => {
                let cells = values.map(exact).chain([row.reason.clone().unwrap_or_default()]);
                line += &csv::lines([cells.collect()]);
            }
            RowForm::Json => {
                for (name, value) in scan.measured().into_iter().zip(values) {
                    line += &(field(name, value) + ",");
                }
                let reason = serde_json::Value::from(row.reason.clone());
                line += &format!("\"reason\":{reason}}}\n");
            }
            RowForm::Table => {
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
