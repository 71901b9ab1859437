//! Reads the files of instruments: two columns of numbers among headers, comments, units and gaps.
//!
//! Separator, decimal sign, columns and units are determined from the text itself. Times are converted to seconds;
//! displacements remain in the unit of the file, and missing samples are left out.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{
    Cell, Header, NumberedLine, Signal, SignalUnit, TIME_UNITS, cells, clock_seconds, lines,
    measure, read, seconds_in, separator,
};

/// A column of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// By its number, counted from 1.
    Number(usize),
    /// By the name in the header.
    Name(String),
}

/// How to read a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// The column of times; `None` to find it by its name or position.
    pub time: Option<Column>,
    /// The column of displacements; `None` to find it by its name or position.
    pub displacement: Option<Column>,
    /// Whether rows are successive turning points, with or without times.
    pub peaks: bool,
    /// What was measured; `None` to tell it by the unit.
    pub signal: Option<Signal>,
    /// Unit of the signal, if the file does not name it.
    pub unit: Option<String>,
}

/// The content of a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Times in s; `None` for a list of peaks without times.
    pub t: Option<Vec<f64>>,
    /// The signal, in the unit of length and s; displacements in the unit of the file.
    pub x: Vec<f64>,
    /// What was measured.
    #[serde(default, skip_serializing_if = "Signal::is_displacement")]
    pub signal: Signal,
    /// Unit of length, if the file names one.
    pub unit: Option<String>,
    /// Number of rows without a usable number.
    pub missing: usize,
    /// Number of rows that repeat another one.
    pub repeated: usize,
}

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadRecord {
    /// Line, counted from 1; 0 for the file as a whole.
    pub line: usize,
    /// Column, counted from 1; 0 for the line as a whole.
    pub column: usize,
    /// What is wrong, and what is allowed.
    pub problem: String,
}

impl fmt::Display for BadRecord {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => {}
            (line, 0) => write!(out, "line {line}: ")?,
            (line, column) => write!(out, "line {line}, column {column}: ")?,
        }
        out.write_str(&self.problem)
    }
}

impl std::error::Error for BadRecord {}

/// The text of a file: UTF-8, UTF-16 with a byte order mark, or else Latin-1.
#[must_use]
pub fn decoded(bytes: &[u8]) -> String {
    let wide = |pair: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|two| pair([two[0], two[1]]));
        char::decode_utf16(units).map(|char| char.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
            Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
        },
    }
}

fn whole(problem: impl Into<String>) -> BadRecord {
    BadRecord { line: 0, column: 0, problem: problem.into() }
}

/// Reads a file.
///
/// # Errors
/// [`BadRecord`] with the line and column of what cannot be parsed.
pub fn parse(bytes: &[u8], reading: &Reading) -> Result<Record, BadRecord> {
    let text = decoded(bytes);
    let lines = lines(&text);
    if lines.is_empty() {
        return Err(whole(
            "the file holds no rows; expected a column of times and one of displacements",
        ));
    }
    let separator = separator(&lines);
    // Where it separates cells, a comma is no part of a number.
    let decimal = separator != Some(',');
    let cells: Vec<Vec<&str>> = lines.iter().map(|line| cells(line.text, separator)).collect();
    let numeric = |row: &Vec<&str>| {
        let kinds: Vec<Cell> = row.iter().map(|cell| read(cell, decimal)).collect();
        kinds.iter().any(|cell| matches!(cell, Cell::Number(_)))
            && kinds.iter().filter(|cell| **cell == Cell::Text).count() * 2 < kinds.len()
    };
    let Some(first) = cells.iter().position(numeric) else {
        let NumberedLine { number, .. } = lines[0];
        return Err(BadRecord {
            line: number,
            column: 1,
            problem: "no row of numbers follows".into(),
        });
    };
    let last = cells.iter().rposition(numeric).unwrap_or(first);
    let width = cells[first].len();
    // Blanks cannot separate names that consist of several words.
    let header = Some(Header::of(&cells[..first]));
    let header = header.filter(|it| separator.is_some() || it.names().len() <= width);
    let header = header.unwrap_or_default();
    let (time, displacement) = columns(reading, &header, &cells[first..=last], width, decimal)
        .map_err(|problem| BadRecord { line: lines[first].number, column: 0, problem })?;
    let bad = |column: usize, problem: String| {
        let line = lines[first.saturating_sub(1)].number;
        BadRecord { line, column: column + 1, problem }
    };
    let first_time = time.and_then(|time| cells[first].get(time));
    let stamps = first_time.is_some_and(|cell| clock_seconds(cell).is_some());
    let unit_of_time = time.filter(|_| !stamps);
    let seconds = match unit_of_time.and_then(|time| header.unit(time).map(|unit| (time, unit))) {
        None => 1.0,
        Some((time, unit)) => seconds_in(&unit).ok_or_else(|| {
            let allowed = TIME_UNITS.map(|(name, _)| name).join(", ");
            bad(time, format!("times in {unit:?}; allowed are {allowed}"))
        })?,
    };
    let written = header.unit(displacement);
    let suggested = header.suggested(displacement);
    let SignalUnit { signal, length, scale } =
        measure(written.as_deref(), reading.unit.as_deref(), reading.signal, suggested)
            .map_err(|problem| bad(displacement, problem))?;
    if reading.peaks && !signal.is_displacement() {
        let problem =
            format!("peaks are turning points, those of a displacement, not of a {signal}");
        return Err(bad(displacement, problem));
    }
    let mut record = Record { unit: length, signal, ..Record::default() };
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for index in first..=last {
        let cell = |column: usize| -> Result<Cell, BadRecord> {
            let (line, column_number) = (lines[index].number, column + 1);
            let Some(text) = cells[index].get(column) else {
                if index == last {
                    return Ok(Cell::Missing);
                }
                let problem = format!("{} of at least {column_number} cells", cells[index].len());
                return Err(BadRecord { line, column: column_number, problem });
            };
            match read(text, decimal) {
                Cell::Text => {
                    let problem =
                        format!("{text:?} is not a number; a missing one is empty, - or NaN");
                    Err(BadRecord { line, column: column_number, problem })
                }
                cell => Ok(cell),
            }
        };
        match (time.map_or(Ok(Cell::Number(0.0)), &cell)?, cell(displacement)?) {
            (Cell::Number(t), Cell::Number(x)) => rows.push((seconds * t, scale * x)),
            _ => record.missing += 1,
        }
    }
    if time.is_some() {
        rows.sort_by(|one, other| one.0.total_cmp(&other.0));
        let before = rows.len();
        rows.dedup();
        record.repeated = before - rows.len();
        let begin = rows.first().filter(|_| stamps).map_or(0.0, |row| row.0);
        record.t = Some(rows.iter().map(|row| row.0 - begin).collect());
    }
    record.x = rows.iter().map(|row| row.1).collect();
    Ok(record)
}

/// The columns of times and displacements that are read, counted from 0.
fn columns(
    reading: &Reading,
    header: &Header,
    rows: &[Vec<&str>],
    width: usize,
    decimal: bool,
) -> Result<(Option<usize>, usize), String> {
    let place = |column: &Column| match column {
        Column::Number(number) if (1..=width).contains(number) => Ok(number - 1),
        Column::Number(number) => Err(format!("there is no column {number}; there are {width}")),
        Column::Name(name) => header.named(name).ok_or_else(|| {
            format!("there is no column {name:?}; there are {}", header.names().join(", "))
        }),
    };
    let mut time = reading.time.as_ref().map(place).transpose()?;
    let mut displacement = reading.displacement.as_ref().map(place).transpose()?;
    time = time.or_else(|| header.time().filter(|&column| Some(column) != displacement));
    let other = reading.signal.filter(|signal| !signal.is_displacement());
    displacement = displacement
        .or_else(|| other.and_then(|signal| header.measuring(signal, time)))
        .or_else(|| header.displacement(time));
    let free = |taken: Option<usize>| (0..width).find(|&column| Some(column) != taken);
    if time.is_none() && reading.time.is_none() && (!reading.peaks || header.is_empty()) {
        let first = if displacement == Some(0) { None } else { Some(0) };
        time = first
            .filter(|&column| width > 1 && !(reading.peaks && counts_rows(rows, column, decimal)));
        let counted = reading.peaks && width > 1 && time.is_none();
        if counted && displacement.is_none() {
            displacement = Some(1);
        }
    }
    let displacement = displacement.or_else(|| free(time));
    match (time, displacement) {
        (None, _) if !reading.peaks => {
            Err("one column only; expected times and displacements, or --peaks".into())
        }
        (Some(time), Some(displacement)) if time == displacement => {
            Err(format!("column {} cannot hold both times and displacements", time + 1))
        }
        (time, Some(displacement)) => Ok((time, displacement)),
        (_, None) => Err("one column only; expected times and displacements".into()),
    }
}

/// Whether a column only numbers the rows, starting at 0 or 1.
fn counts_rows(rows: &[Vec<&str>], column: usize, decimal: bool) -> bool {
    let value = |row: &Vec<&str>| match row.get(column).map(|cell| read(cell, decimal)) {
        Some(Cell::Number(value)) => Some(value),
        _ => None,
    };
    let values: Vec<f64> = rows.iter().filter_map(value).collect();
    matches!(values.first(), Some(0.0 | 1.0))
        && values.len() == rows.len()
        && values.windows(2).all(|two| two[1] - two[0] == 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Record, BadRecord> {
        parse(text.as_bytes(), &Reading::default())
    }

    fn pairs(record: &Record) -> Vec<(f64, f64)> {
        record.t.iter().flatten().copied().zip(record.x.iter().copied()).collect()
    }

    #[test]
    fn one_record_in_many_spellings() {
        let expected = vec![(0.0, 1.5), (0.001, -2.25), (0.002, 3.0)];
        for text in [
            "time [s],displacement [mm]\n0,1.5\n0.001,-2.25\n0.002,3\n",
            "Zeit [ms];Weg [mm]\r\n0,0;1,5\r\n1,0;-2,25\r\n2,0;3,0\r\n",
            "% a comment\nTime\tDisplacement\nms\tmm\n0\t1.5\n1\t-2.25\n2\t3\n% end\n",
            "0.000e0  1.5\n 1.0e-3 -2.25\n2e-3 3\n",
            "n,T [degC],t [us],x [um]\n1,20,0,1.5\n2,20,1000,-2.25\n3,20,2000,3\n",
            "0,0 1,5\n0,001 -2,25\n0,002 3,0\n",
            "t (s), T (degC), position (mm)\n0, 20.5, 1.5\n0.001, 20.6, -2.25\n0.002, 20, 3.0\n",
            "\"t (s)\",\"x (mm)\"\n\"0\",\"1.5\"\n\"0.001\",\"-2.25\"\n\"0.002\",\"3\"\n",
            "rig 4; floor 2\n\nt/s;x/mm\n0;1.5\n0.001;-2.25\n0.001;-2.25\n0.0015;NaN\n0.0016;\n0.002;3",
            "0;1.5\n0.001;-2.25\n0.002;3\n0.00",
            "t [s] x [mm]\n0 1.5\n0.001 -2.25\n0.002 3\n",
            "clock,x\n2026-03-02T23:59:59.0Z,1.5\n2026-03-02T23:59:59.001Z,-2.25\n2026-03-02 23:59:59.002,3\n",
            "Zeit;Weg\n10:11:59,000;1,5\n10:11:59,001;-2,25\n10:11:59,002;3\n",
        ] {
            let found = pairs(&read(text).unwrap());
            assert_eq!(found.len(), expected.len(), "{text}");
            // Seconds within 1000 days are rounded to about 15 ns.
            for (one, other) in found.iter().zip(&expected) {
                assert!((one.0 - other.0).abs() < 3e-8 && one.1 == other.1, "{text}: {found:?}");
            }
        }
        let latin = b"Zeit [\xb5s];Weg [\xb5m]\n0;1,5\n1000;-2,25\n2000;3\n";
        let record = parse(latin, &Reading::default()).unwrap();
        assert_eq!((pairs(&record), record.unit.as_deref()), (expected, Some("\u{b5}m")));
    }

    #[test]
    fn missing_and_repeated_rows_are_counted() {
        let record = read("t,x\n0,1\n1,-\n2,nan\n3,\n4,2\n4,2\n").unwrap();
        assert_eq!((record.missing, record.repeated, record.x), (3, 1, vec![1.0, 2.0]));
    }

    #[test]
    fn columns_can_be_named_or_numbered() {
        let text = "a,b,c\n0,5,1\n1,6,2\n";
        let choose = |time, displacement| {
            let reading = Reading {
                time: Some(time),
                displacement: Some(displacement),
                ..Reading::default()
            };
            parse(text.as_bytes(), &reading)
        };
        let record = choose(Column::Number(1), Column::Number(3)).unwrap();
        assert_eq!(pairs(&record), [(0.0, 1.0), (1.0, 2.0)]);
        let record = choose(Column::Name("a".into()), Column::Name("b".into())).unwrap();
        assert_eq!(pairs(&record), [(0.0, 5.0), (1.0, 6.0)]);
        let refused = choose(Column::Number(1), Column::Number(4)).unwrap_err().to_string();
        assert_eq!(refused, "line 2: there is no column 4; there are 3");
    }

    #[test]
    fn peaks_come_with_and_without_times() {
        let reading = Reading { peaks: true, ..Reading::default() };
        for (text, times) in [
            ("no,peak time [s],peak [mm]\n0,0.5,8\n1,0.75,-6\n", Some(vec![0.5, 0.75])),
            ("no,peak [mm]\n0,8\n1,-6\n", None),
            ("peak\n8\n-6\n", None),
            ("8\n-6\n", None),
            ("1 8\n2 -6\n", None),
            ("0.5 8\n0.75 -6\n", Some(vec![0.5, 0.75])),
        ] {
            let record = parse(text.as_bytes(), &reading).unwrap();
            assert_eq!((record.t, record.x), (times, vec![8.0, -6.0]), "{text}");
        }
    }

    #[test]
    fn a_separator_within_quotation_marks_belongs_to_its_cell() {
        let text = "\"time, ms\",\"displacement, mm\"\n\"0\",\"1.5\"\n\"10\",\"1.2\"\n";
        let record = read(text).unwrap();
        assert_eq!((record.t, record.x), (Some(vec![0.0, 0.01]), vec![1.5, 1.2]));
        assert_eq!(record.unit.as_deref(), Some("mm"));
    }

    #[test]
    fn what_is_no_number_is_named_by_line_and_column() {
        for (text, problem) in [
            ("t,x\n0,1\n1,abc\n2,3\n", "line 3, column 2: \"abc\" is not a number"),
            ("t,x\n0,1\n1\n2,3\n", "line 3, column 2: 1 of at least 2 cells"),
            ("t [frames],x\n0,1\n1,2\n", "line 1, column 1: times in \"frames\"; allowed are s, "),
            ("t [s],u [mV]\n0,1\n1,2\n", "line 1, column 2: \"mV\" is a unit of voltage"),
            ("t [s],force [N]\n0,1\n1,2\n", "line 1, column 2: \"N\" is a unit of force"),
            ("1\n2\n", "line 1: one column only"),
            ("", "the file holds no rows"),
            ("hello\nworld\n", "line 1, column 1: no row of numbers"),
        ] {
            let refused = read(text).unwrap_err().to_string();
            assert!(refused.starts_with(problem), "{text:?}: {refused}");
        }
    }
}
