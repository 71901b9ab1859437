//! A map of a scan over two parameters: its cells, its scale, and what it means that a cell has no number.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::units;
use crate::numerics::{cells, distinct, ln, named, pow};
use crate::scan::{Sweep, Value};
use crate::session::ScanOnShow;

/// Which values of a measure are the dangerous ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DangerousValues {
    Small,
    Large,
}

/// The lines of `assets/columns.txt`: a column, its unit, its SI unit of a machine, which of its values are dangerous, and
/// what it means that there is none.
static COLUMNS: LazyLock<Vec<[&str; 5]>> =
    LazyLock::new(|| include_str!("../../assets/columns.txt").lines().filter_map(cells).collect());

/// What [`COLUMNS`] says of a column.
fn described(column: &'static str) -> [&'static str; 5] {
    let row = COLUMNS.iter().find(|[known, ..]| *known == column);
    row.copied().unwrap_or([column, "-", "-", "-", "none"])
}

/// The same of the column that is plotted.
fn plotted(scanned: &ScanOnShow) -> [&'static str; 5] {
    described(measured(scanned))
}

/// What it means that a column has no number.
pub fn absence(column: &'static str) -> &'static str {
    let [.., nothing] = described(column);
    nothing
}

/// Ratio of the largest to the smallest value from which on shades are parts of a logarithm.
const SPREAD: f64 = 10.0;

/// The name of what is plotted.
pub fn measured(scanned: &ScanOnShow) -> &'static str {
    scanned.scan.measured().get(scanned.column).copied().unwrap_or_default()
}

/// What is plotted, with the unit of a length, a velocity or a time.
pub fn with_unit(scanned: &ScanOnShow) -> String {
    let [column, own, si, ..] = plotted(scanned);
    let unit = if scanned.scan.problem(0).is_some() { own } else { si };
    units::with_unit(column, Some(unit).filter(|unit| *unit != "-").unwrap_or_default())
}

/// What it means that there is no number at a point; `None` where there is one.
pub fn nothing(scanned: &ScanOnShow, index: usize) -> Option<&'static str> {
    let row = scanned.rows.get(index)?;
    if scanned.height(index).is_some() {
        return None;
    }
    let [.., nothing] = plotted(scanned);
    Some(if row.reason.is_some() { "gave up" } else { nothing })
}

/// The scale of a map: how dangerous a value is.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Danger {
    pub low: f64,
    pub high: f64,
    /// Whether equal steps are equal ratios.
    pub logarithmic: bool,
    /// `None` where the measure says nothing of danger.
    pub dangerous: Option<DangerousValues>,
}

impl Danger {
    /// The scale of what is plotted; `None` without a number.
    pub fn of(scanned: &ScanOnShow) -> Option<Self> {
        let (low, high) = scanned.range()?;
        let [.., dangerous, _] = plotted(scanned);
        let logarithmic = low > 0.0 && high / low >= SPREAD;
        Some(Danger { low, high, logarithmic, dangerous: named(dangerous) })
    }

    /// How far a value is on the way from the lowest to the highest, from 0 to 1.
    pub fn part(&self, value: f64) -> f64 {
        let part = if self.logarithmic {
            ln(value / self.low) / ln(self.high / self.low)
        } else {
            (value - self.low) / (self.high - self.low)
        };
        if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The value this far on the way.
    pub fn at(&self, part: f64) -> f64 {
        if self.logarithmic {
            self.low * pow(self.high / self.low, part)
        } else {
            self.low + (self.high - self.low) * part
        }
    }

    /// How strong a place this far on the way is: the stronger the more dangerous.
    pub fn strength(&self, part: f64) -> f64 {
        if self.dangerous == Some(DangerousValues::Small) {
            1.0 - part
        } else {
            part
        }
    }

    /// What the lowest and the highest value are.
    pub fn ends(&self) -> [&'static str; 2] {
        match self.dangerous {
            Some(DangerousValues::Small) => ["dangerous", "safe"],
            Some(DangerousValues::Large) => ["safe", "dangerous"],
            None => ["", ""],
        }
    }
}

/// A map over two parameters: cells around the points of a grid.
#[derive(Clone, Debug, Serialize)]
pub struct ScanMap {
    /// What is measured, with its unit.
    pub name: String,
    /// The scale of the numbers; `None` where there are words.
    pub scale: Option<Danger>,
    /// The places of the columns of cells, on an axis that may be logarithmic.
    pub x: Vec<f64>,
    /// The places of the rows.
    pub y: Vec<f64>,
    /// What was measured in each column, from below; as much as is known.
    pub values: Vec<Vec<MapCell>>,
}

/// A number, or what it means that there is none.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
pub enum MapCell {
    Number(f64),
    Word(&'static str),
}

impl ScanMap {
    /// The map of a scan; of more than two parameters the others stay at their first values.
    pub fn of(scanned: &ScanOnShow) -> Option<Self> {
        let [across, upward, rest @ ..] = scanned.scan.over() else { return None };
        let stride: usize = rest.iter().map(|sweep| sweep.count).product();
        let places = |sweep: &Sweep| -> Vec<f64> {
            (0..sweep.count)
                .map(|index| ScanOnShow::coordinate(sweep, sweep.value(index)))
                .collect()
        };
        let cell = |index: usize| match (nothing(scanned, index), scanned.value(index)) {
            (Some(none), _) => MapCell::Word(none),
            (None, Some(Value::Word(word))) => MapCell::Word(word),
            (None, value) => {
                value.and_then(Value::number).map_or(MapCell::Word("none"), MapCell::Number)
            }
        };
        let cells: Vec<MapCell> = (0..scanned.rows.len()).step_by(stride).map(cell).collect();
        Some(ScanMap {
            name: with_unit(scanned),
            scale: Danger::of(scanned).filter(|_| !scanned.plots_words()),
            x: places(across),
            y: places(upward),
            values: cells.chunks(upward.count).map(<[_]>::to_vec).collect(),
        })
    }

    /// The words that stand for cells, each once.
    pub fn words(&self) -> Vec<&'static str> {
        distinct(self.values.iter().flatten().filter_map(|cell| match cell {
            MapCell::Word(word) => Some(*word),
            MapCell::Number(_) => None,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::measure::MEASURES;

    #[test]
    fn what_is_said_of_columns_is_said_of_those_that_are_measured() {
        let lines = include_str!("../../assets/columns.txt").lines();
        let told = lines.filter(|line| !(line.is_empty() || line.starts_with('#')));
        assert_eq!(told.count(), COLUMNS.len(), "every line of the file is read");
        for [column, .., dangerous, _] in COLUMNS.iter() {
            assert!(MEASURES.iter().any(|row| row.columns.contains(column)), "{column}");
            let known = *dangerous == "-" || named::<DangerousValues>(dangerous).is_some();
            assert!(known, "{column}: {dangerous}");
        }
    }
}
