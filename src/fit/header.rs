//! The header lines above the numbers: names of columns and their units.

use super::{Signal, UnitMeaning, quantity};

/// Units of time and their values in seconds.
pub const TIME_UNITS: [(&str, f64); 7] = [
    ("s", 1.0),
    ("ms", 1e-3),
    ("us", 1e-6),
    ("ns", 1e-9),
    ("min", 60.0),
    ("h", 3600.0),
    ("sec", 1.0),
];

/// Parts of the names of time columns, in lower case.
const TIMES: [&str; 5] = ["time", "zeit", "temps", "tiempo", "seconds"];

/// Parts of the names of displacement columns, in lower case, in order of preference; single letters are whole
/// names.
const DISPLACEMENTS: [&str; 11] = [
    "displ",
    "weg",
    "auslenk",
    "deflec",
    "peak",
    "position",
    "amplitude",
    "extrem",
    "distance",
    "x",
    "q",
];

/// Parts of the names of columns that hold other signals, in lower case.
const SIGNALS: [(Signal, [&str; 3]); 2] = [
    (Signal::Velocity, ["velocity", "geschw", "vitesse"]),
    (Signal::Acceleration, ["accel", "beschl", "acc\u{e9}l"]),
];

/// Names and units of the columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header {
    columns: Vec<ColumnHeader>,
}

/// A column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct ColumnHeader {
    name: String,
    unit: Option<String>,
}

/// The value of a unit of time in seconds; `None` if it is unknown.
pub fn seconds_in(unit: &str) -> Option<f64> {
    let plain = unit.to_lowercase().replace(['\u{b5}', '\u{3bc}'], "u");
    TIME_UNITS.iter().find(|(name, _)| *name == plain).map(|(_, seconds)| *seconds)
}

impl ColumnHeader {
    /// `name [unit]`, `name (unit)`, `name / unit`, `name, unit` or `name_unit` for times.
    fn read(cell: &str) -> Self {
        let bracketed = [('[', ']'), ('(', ')')].iter().find_map(|(open, close)| {
            let (name, rest) = cell.split_once(*open)?;
            Some((name, rest.split(*close).next().unwrap_or_default()))
        });
        // The longest unit that is known: after the first sign of `v/mm/s`.
        let is_known = |unit: &str| seconds_in(unit).is_some() || quantity(unit).is_some();
        let known = || {
            let signs = ["/", " in ", ", "];
            let splits = signs.iter().flat_map(|sign| cell.match_indices(sign));
            let splits = splits.map(|(at, sign)| (&cell[..at], &cell[at + sign.len()..]));
            splits.filter(|(_, unit)| is_known(unit.trim())).min_by_key(|(name, _)| name.len())
        };
        let last = |sign: &str| {
            cell.rsplit_once(sign).filter(|(_, unit)| sign != "_" || seconds_in(unit).is_some())
        };
        let unknown = || ["/", " in ", ", ", "_"].into_iter().find_map(last);
        let (name, unit) = bracketed.or_else(known).or_else(unknown).unwrap_or((cell, ""));
        let unit = Some(unit.trim()).filter(|unit| !unit.is_empty() && *unit != "-");
        ColumnHeader { name: name.trim().to_owned(), unit: unit.map(str::to_owned) }
    }
}

impl Header {
    /// The header in these lines: the last line with a known name, or else the last line; and the units from
    /// the line after it, if there is one.
    pub fn of(lines: &[Vec<&str>]) -> Self {
        let read = |line: &Vec<&str>| Header {
            columns: line.iter().map(|cell| ColumnHeader::read(cell)).collect(),
        };
        let known =
            |header: &Header| header.time().is_some() || header.displacement(None).is_some();
        let headers: Vec<Header> = lines.iter().map(read).collect();
        let Some(place) = headers.iter().rposition(known).or(headers.len().checked_sub(1)) else {
            return Header::default();
        };
        let mut header = headers[place].clone();
        if let Some(units) = lines.get(place + 1)
            && units.len() >= header.columns.len()
        {
            for (column, unit) in header.columns.iter_mut().zip(units) {
                let bare = unit.trim_matches(['[', ']', '(', ')']);
                if column.unit.is_none() && !bare.is_empty() {
                    column.unit = Some(bare.to_owned());
                }
            }
        }
        header
    }

    /// Whether the file has no header.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// The names of the columns.
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.name.as_str()).collect()
    }

    /// The column with this name.
    pub fn named(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name.eq_ignore_ascii_case(name.trim()))
    }

    /// The unit of a column.
    pub fn unit(&self, column: usize) -> Option<String> {
        self.columns.get(column)?.unit.clone()
    }

    fn find(&self, fits: impl Fn(&str) -> bool, but: Option<usize>) -> Option<usize> {
        let mut columns = self.columns.iter().enumerate();
        columns
            .find(|(place, column)| Some(*place) != but && fits(&column.name))
            .map(|(place, _)| place)
    }

    /// The column of times. A column `T` holds temperatures.
    pub fn time(&self) -> Option<usize> {
        let called = |name: &str| TIMES.iter().any(|time| name.to_lowercase().contains(time));
        self.find(called, None).or_else(|| self.find(|name| name == "t", None))
    }

    /// The signal that the name of a column suggests.
    pub fn suggested(&self, column: usize) -> Option<Signal> {
        let name = self.columns.get(column)?.name.to_lowercase();
        let has = |parts: &[&str]| parts.iter().any(|part| name.contains(part));
        SIGNALS.iter().find(|(_, parts)| has(parts)).map(|(signal, _)| *signal)
    }

    /// The first column with a unit of a signal, or else with a name that suggests it.
    pub fn measuring(&self, signal: Signal, time: Option<usize>) -> Option<usize> {
        let columns = || (0..self.columns.len()).filter(|column| Some(*column) != time);
        let has_unit = |column: &usize| {
            let unit = self.unit(*column).and_then(|unit| quantity(&unit));
            matches!(unit, Some(UnitMeaning::Signal(known, ..)) if known == signal)
        };
        let by_name = || columns().find(|column| self.suggested(*column) == Some(signal));
        columns().find(has_unit).or_else(by_name)
    }

    /// The column of displacements; `time` is the column of times, which is skipped.
    pub fn displacement(&self, time: Option<usize>) -> Option<usize> {
        let is = |known: &str, name: &str| {
            let name = name.to_lowercase();
            if known.len() > 1 { name.contains(known) } else { name == known }
        };
        DISPLACEMENTS.iter().find_map(|known| self.find(|name| is(known, name), time))
    }
}
