//! Reads the files of instruments: two columns of numbers among headers, comments, units and gaps.
//!
//! Separator, decimal sign, columns and units are determined from the text itself. Times are converted to seconds;
//! displacements remain in the unit of the file, and missing samples are left out.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::cells::{
    ColumnHeader, Header, cells, clock_seconds, lines, read, seconds_in, separator,
};
use super::{Signal, SignalUnit, measure};

/// How to read a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RecordFormat {
    /// The column of times, by its number, counted from 1, or its name; `None` to find it by its name or position.
    pub time: Option<String>,
    /// That of displacements.
    pub displacement: Option<String>,
    /// Whether rows are successive turning points, with or without times.
    pub peaks: bool,
    /// What was measured; `None` to tell it by the unit.
    pub signal: Option<Signal>,
    /// Unit of the signal, if the file does not name it.
    pub unit: Option<String>,
}

/// What was measured: a signal at ascending times, or successive turning points.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Times in s; empty for turning points without times.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub t: Vec<f64>,
    /// The signal, in the unit of length and s, or the displacements of the turning points; displacements in the unit of
    /// the file.
    pub x: Vec<f64>,
    /// What the signal is.
    #[serde(default, skip_serializing_if = "Signal::is_displacement")]
    pub signal: Signal,
    /// Of turning points that are fitted the ratio of the errors of the times to those of the displacements, in s per
    /// unit of length.
    #[serde(skip)]
    pub peaks: Option<f64>,
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

fn bad(line: usize, column: usize, problem: impl Into<String>) -> BadRecord {
    BadRecord { line, column, problem: problem.into() }
}

/// Reads a file.
///
/// # Errors
/// [`BadRecord`] with the line and column of what cannot be parsed.
pub fn parse(bytes: &[u8], reading: &RecordFormat) -> Result<Record, BadRecord> {
    let text = decoded(bytes);
    let table = RecordTable::of(&text)?;
    let (time, displacement) =
        table.columns(reading).map_err(|problem| bad(table.rows[0].0, 0, problem))?;
    let in_header = |column: usize, problem: String| bad(table.last_of_header, column + 1, problem);
    let first_time = time.and_then(|time| table.rows[0].1.get(time));
    let stamps = first_time.is_some_and(|cell| clock_seconds(cell).is_some());
    let column = |place: usize| table.header.columns.get(place);
    let unit_of = |place: usize| column(place)?.unit.as_deref();
    let unit = time.filter(|_| !stamps).and_then(|time| Some((time, unit_of(time)?)));
    let seconds = unit.map_or(Ok(1.0), |(time, unit)| {
        seconds_in(unit).ok_or_else(|| {
            in_header(time, format!("times in {unit:?}; allowed are such as s, ms, us, min, h"))
        })
    })?;
    let written = unit_of(displacement);
    let suggested = column(displacement).and_then(ColumnHeader::suggested);
    let SignalUnit { signal, length, scale } =
        measure(written, reading.unit.as_deref(), reading.signal, suggested)
            .map_err(|problem| in_header(displacement, problem))?;
    if reading.peaks && !signal.is_displacement() {
        let problem =
            format!("peaks are turning points, those of a displacement, not of a {signal}");
        return Err(in_header(displacement, problem));
    }
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for row in 0..table.rows.len() {
        let t = time.map_or(Ok(0.0), |time| table.number(row, time))?;
        rows.push((seconds * t, scale * table.number(row, displacement)?));
    }
    let all = rows.len();
    rows.retain(|(t, x)| !t.is_nan() && !x.is_nan());
    let mut record =
        Record { unit: length, signal, missing: all - rows.len(), ..Record::default() };
    if time.is_some() {
        rows.sort_by(|one, other| one.0.total_cmp(&other.0));
        let before = rows.len();
        rows.dedup();
        record.repeated = before - rows.len();
        let begin = rows.first().filter(|_| stamps).map_or(0.0, |row| row.0);
        record.t = rows.iter().map(|row| row.0 - begin).collect();
    }
    record.x = rows.iter().map(|row| row.1).collect();
    Ok(record)
}

/// The cells of a file.
struct RecordTable<'a> {
    header: Header,
    /// The number of the last line before the numbers, or of the first one.
    last_of_header: usize,
    /// The rows of numbers, with the numbers of their lines.
    rows: Vec<(usize, Vec<&'a str>)>,
    /// Whether a comma may be a decimal sign: not where it separates cells.
    comma_is_decimal: bool,
}

impl<'a> RecordTable<'a> {
    fn of(text: &'a str) -> Result<Self, BadRecord> {
        let lines = lines(text);
        let Some(&(first_line, _)) = lines.first() else {
            let problem =
                "the file holds no rows; expected a column of times and one of displacements";
            return Err(bad(0, 0, problem));
        };
        let separator = separator(&lines);
        let comma_is_decimal = separator != Some(',');
        let rows = lines.iter().map(|(line, text)| (*line, cells(text, separator)));
        let mut rows: Vec<(usize, Vec<&str>)> = rows.collect();
        let numeric = |(_, row): &(usize, Vec<&str>)| {
            let cells = row.iter().map(|cell| read(cell, comma_is_decimal));
            let cells: Vec<Option<f64>> = cells.collect();
            cells.iter().flatten().any(|value| value.is_finite())
                && cells.iter().filter(|cell| cell.is_none()).count() * 2 < cells.len()
        };
        let first = rows.iter().position(numeric);
        let first = first.ok_or_else(|| bad(first_line, 1, "no row of numbers follows"))?;
        rows.truncate(rows.iter().rposition(numeric).unwrap_or(first) + 1);
        let last_of_header = rows[first.saturating_sub(1)].0;
        let numbers = rows.split_off(first);
        let header: Vec<Vec<&str>> = rows.into_iter().map(|(_, cells)| cells).collect();
        let header = Header::of(&header);
        // Blanks cannot separate names that consist of several words.
        let is_apart = separator.is_some() || header.columns.len() <= numbers[0].1.len();
        let header = if is_apart { header } else { Header::default() };
        Ok(RecordTable { header, last_of_header, rows: numbers, comma_is_decimal })
    }

    /// The number in a cell; NaN where it is missing, as in a last row that is cut off.
    fn number(&self, row: usize, column: usize) -> Result<f64, BadRecord> {
        let (line, cells) = &self.rows[row];
        let Some(text) = cells.get(column) else {
            if row + 1 == self.rows.len() {
                return Ok(f64::NAN);
            }
            let problem = format!("{} of at least {} cells", cells.len(), column + 1);
            return Err(bad(*line, column + 1, problem));
        };
        read(text, self.comma_is_decimal).ok_or_else(|| {
            let problem = format!("{text:?} is not a number; a missing one is empty, - or NaN");
            bad(*line, column + 1, problem)
        })
    }

    /// The columns of times and displacements that are read, counted from 0.
    fn columns(&self, reading: &RecordFormat) -> Result<(Option<usize>, usize), String> {
        let (header, width) = (&self.header, self.rows[0].1.len());
        let place = |column: &String| match column.parse() {
            Ok(number) if (1..=width).contains(&number) => Ok(number - 1),
            Ok(number) => Err(format!("there is no column {number}; there are {width}")),
            Err(_) => header.named(column).ok_or_else(|| {
                let names: Vec<&str> = header.columns.iter().map(|it| it.name.as_str()).collect();
                format!("there is no column {column:?}; there are {}", names.join(", "))
            }),
        };
        let mut time = reading.time.as_ref().map(place).transpose()?;
        let mut displacement = reading.displacement.as_ref().map(place).transpose()?;
        time = time.or_else(|| header.time().filter(|&column| Some(column) != displacement));
        let other = reading.signal.filter(|signal| !signal.is_displacement());
        displacement = displacement
            .or_else(|| other.and_then(|signal| header.measuring(signal, time)))
            .or_else(|| header.displacement(time));
        let is_open = time.is_none() && (!reading.peaks || header.columns.is_empty());
        if is_open && width > 1 && displacement != Some(0) {
            if reading.peaks && self.counts_rows() {
                displacement = displacement.or(Some(1));
            } else {
                time = Some(0);
            }
        }
        let free = (0..width).find(|&column| Some(column) != time);
        match (time, displacement.or(free)) {
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

    /// Whether the first column only numbers the rows, starting at 0 or 1.
    fn counts_rows(&self) -> bool {
        let number = |row: usize| self.number(row, 0).unwrap_or(f64::NAN);
        let values: Vec<f64> = (0..self.rows.len()).map(number).collect();
        matches!(values[0], 0.0 | 1.0) && values.windows(2).all(|two| two[1] - two[0] == 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Record, BadRecord> {
        parse(text.as_bytes(), &RecordFormat::default())
    }

    fn pairs(record: &Record) -> Vec<(f64, f64)> {
        record.t.iter().copied().zip(record.x.iter().copied()).collect()
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
        let record = parse(latin, &RecordFormat::default()).unwrap();
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
        let choose = |time: &str, displacement: &str| {
            let [time, displacement] = [time, displacement].map(|it| Some(it.to_owned()));
            let reading = RecordFormat { time, displacement, ..RecordFormat::default() };
            parse(text.as_bytes(), &reading)
        };
        let record = choose("1", "3").unwrap();
        assert_eq!(pairs(&record), [(0.0, 1.0), (1.0, 2.0)]);
        let record = choose("a", "b").unwrap();
        assert_eq!(pairs(&record), [(0.0, 5.0), (1.0, 6.0)]);
        let refused = choose("1", "4").unwrap_err().to_string();
        assert_eq!(refused, "line 2: there is no column 4; there are 3");
    }

    #[test]
    fn peaks_come_with_and_without_times() {
        let reading = RecordFormat { peaks: true, ..RecordFormat::default() };
        for (text, times) in [
            ("no,peak time [s],peak [mm]\n0,0.5,8\n1,0.75,-6\n", Some(vec![0.5, 0.75])),
            ("no,peak [mm]\n0,8\n1,-6\n", None),
            ("peak\n8\n-6\n", None),
            ("8\n-6\n", None),
            ("1 8\n2 -6\n", None),
            ("0.5 8\n0.75 -6\n", Some(vec![0.5, 0.75])),
        ] {
            let record = parse(text.as_bytes(), &reading).unwrap();
            assert_eq!(
                (record.t, record.x),
                (times.unwrap_or_default(), vec![8.0, -6.0]),
                "{text}"
            );
        }
    }

    #[test]
    fn a_separator_within_quotation_marks_belongs_to_its_cell() {
        let text = "\"time, ms\",\"displacement, mm\"\n\"0\",\"1.5\"\n\"10\",\"1.2\"\n";
        let record = read(text).unwrap();
        assert_eq!((record.t, record.x), (vec![0.0, 0.01], vec![1.5, 1.2]));
        assert_eq!(record.unit.as_deref(), Some("mm"));
    }

    #[test]
    fn what_is_no_number_is_named_by_line_and_column() {
        for (text, problem) in [
            ("t,x\n0,1\n1,abc\n2,3\n", "line 3, column 2: \"abc\" is not a number"),
            ("t,x\n0,1\n1\n2,3\n", "line 3, column 2: 1 of at least 2 cells"),
            (
                "t [frames],x\n0,1\n1,2\n",
                "line 1, column 1: times in \"frames\"; allowed are such as s",
            ),
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
