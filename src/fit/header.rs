//! The header lines above the numbers: names of columns and their units.

use super::{Signal, quantity, value_of, with_latin_micro};

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
    value_of(&with_latin_micro(&unit.to_lowercase()), &TIME_UNITS)
}

impl ColumnHeader {
    /// Whether one of these parts is in the name.
    fn name_has(&self, parts: &[&str]) -> bool {
        let name = self.name.to_lowercase();
        parts.iter().any(|part| name.contains(part))
    }

    /// The signal that the name suggests.
    fn suggested(&self) -> Option<Signal> {
        SIGNALS.iter().find(|(_, parts)| self.name_has(parts)).map(|(signal, _)| *signal)
    }

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
    pub fn unit(&self, column: usize) -> Option<&str> {
        self.columns.get(column)?.unit.as_deref()
    }

    /// The first column that fits; `time` is the column of times, which is skipped.
    fn find(&self, time: Option<usize>, fits: impl Fn(&ColumnHeader) -> bool) -> Option<usize> {
        (0..self.columns.len()).find(|place| Some(*place) != time && fits(&self.columns[*place]))
    }

    /// The column of times. A column `T` holds temperatures.
    pub fn time(&self) -> Option<usize> {
        let is_called = |it: &ColumnHeader| it.name_has(&TIMES);
        self.find(None, is_called).or_else(|| self.find(None, |it| it.name == "t"))
    }

    /// The signal that the name of a column suggests.
    pub fn suggested(&self, column: usize) -> Option<Signal> {
        self.columns.get(column)?.suggested()
    }

    /// The first column with a unit of a signal, or else with a name that suggests it.
    pub fn measuring(&self, signal: Signal, time: Option<usize>) -> Option<usize> {
        let meaning = |it: &ColumnHeader| quantity(it.unit.as_deref()?)?.ok();
        let has_unit = |it: &ColumnHeader| meaning(it).is_some_and(|unit| unit.signal == signal);
        let by_name = || self.find(time, |it| it.suggested() == Some(signal));
        self.find(time, has_unit).or_else(by_name)
    }

    /// The column of displacements; `time` is the column of times, which is skipped.
    pub fn displacement(&self, time: Option<usize>) -> Option<usize> {
        DISPLACEMENTS.iter().find_map(|known| {
            let is_whole = known.len() == 1;
            self.find(time, |it| {
                if is_whole { it.name.to_lowercase() == *known } else { it.name_has(&[known]) }
            })
        })
    }
}
