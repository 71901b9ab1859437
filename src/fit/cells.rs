//! The cells of a file: lines, separators, and the values of cells: numbers, dates and times of day as instruments write
//! them; and the header above the numbers, with names of columns and their units.

use super::{Signal, quantity};
use crate::model::{TIME, in_si};
use crate::numerics::amount;

/// What instruments write for a missing number, in lower case.
const MISSING: [&str; 14] = [
    "", "-", "--", "---", "nan", "na", "n/a", "#n/a", "null", "none", "inf", "-inf", "ovl",
    "overload",
];

/// The lines of a text, except empty ones and comments, with their numbers, counted from 1, and without leading and
/// trailing blanks.
pub fn lines(text: &str) -> Vec<(usize, &str)> {
    let parts = text.split('\n').flat_map(|part| {
        // A carriage return alone also ends a line; before a newline it is part of the line ending.
        part.strip_suffix('\r').unwrap_or(part).split('\r')
    });
    let is_row = |(_, text): &(usize, &str)| {
        let blank = text.trim().is_empty() || text.chars().all(|char| ";,\t ".contains(char));
        !(blank || text.starts_with(['#', '%']))
    };
    (1..).zip(parts.map(|text| text.trim_matches([' ', '\0']))).filter(is_row).collect()
}

/// The sign that separates the cells in the last rows, which are data in every file; `None` for blanks.
pub fn separator(lines: &[(usize, &str)]) -> Option<char> {
    /// Number of rows that decide.
    const ROWS: usize = 20;
    let last = &lines[lines.len().saturating_sub(ROWS)..];
    let most = |sign: &dyn Fn(&str) -> bool| {
        2 * last.iter().filter(|(_, text)| sign(text)).count() > last.len()
    };
    let blank = |text: &str| {
        let cells: Vec<&str> = text.split_whitespace().collect();
        cells.len() > 1 && cells.iter().all(|cell| read(cell, true).is_some_and(f64::is_finite))
    };
    let is_comma = || most(&|text| text.contains(',')) && !most(&blank);
    let sign = [';', '\t'].into_iter().find(|&sign| most(&|text| text.contains(sign)));
    sign.or_else(|| is_comma().then_some(','))
}

/// The cells of a line.
pub fn cells(text: &str, separator: Option<char>) -> Vec<&str> {
    let cells = separator.map_or_else(|| words(text), |sign| split(text, sign));
    cells.into_iter().map(|cell| cell.trim().trim_matches('"').trim()).collect()
}

/// The parts between separators outside quotation marks. Quotation marks that do not pair have no special meaning.
fn split(text: &str, sign: char) -> Vec<&str> {
    let mut inside = false;
    let cells = text.split(|char| {
        inside ^= char == '"';
        char == sign && !inside
    });
    let cells = cells.collect();
    if inside { text.split(sign).collect() } else { cells }
}

/// The words between blanks; a unit in brackets belongs to the name before it.
fn words(text: &str) -> Vec<&str> {
    let is_unit = |word: &str| word.starts_with(['[', '(']);
    let mut found: Vec<&str> = Vec::new();
    let mut begin = 0;
    for word in text.split_whitespace() {
        let at = word.as_ptr() as usize - text.as_ptr() as usize;
        match found.last_mut() {
            Some(last) if is_unit(word) && !is_unit(last) => *last = &text[begin..at + word.len()],
            _ => {
                begin = at;
                found.push(word);
            }
        }
    }
    found
}

/// The number in a cell, of a clock time in seconds; NaN where instruments write that it is missing, `None` for anything
/// else.
pub fn read(cell: &str, comma_is_decimal: bool) -> Option<f64> {
    if MISSING.contains(&cell.to_ascii_lowercase().as_str()) {
        return Some(f64::NAN);
    }
    if let Some(seconds) = clock_seconds(cell) {
        return Some(seconds);
    }
    // A comma at the end of a cell separates it from the next.
    let plain = if comma_is_decimal && cell.contains(',') && !cell.ends_with(',') {
        // If there are both, the later sign is the decimal sign and the other one groups digits.
        if cell.rfind(',') > cell.rfind('.') {
            cell.replace('.', "").replace(',', ".")
        } else {
            cell.replace(',', "")
        }
    } else {
        cell.to_owned()
    };
    // Words such as "infinity" are not numbers that an instrument measured.
    let is_number = plain.starts_with(|char: char| char.is_ascii_digit() || "+-.".contains(char));
    let value = plain.parse::<f64>().ok().filter(|_| is_number)?;
    Some(if value.is_finite() { value } else { f64::NAN })
}

/// Dates count modulo this many days, so that seconds stay small enough for a resolution of about 15 ns.
const REPEAT: i64 = 1000;

/// Seconds of `12:34:56.789`, `34:56,789` or `2026-03-02T12:34:56.789Z`; `None` for anything else.
pub fn clock_seconds(cell: &str) -> Option<f64> {
    let (days, clock) = match cell.split_once(['T', ' ']) {
        Some((date, clock)) => (days(date)?, clock.trim()),
        None => (0, cell),
    };
    let clock = clock.strip_suffix('Z').unwrap_or(clock).replace(',', ".");
    let parts: Vec<f64> = clock.split(':').map(plain).collect::<Option<_>>()?;
    // A leap second is the 61st of its minute.
    let within = match parts[..] {
        [hours, minutes, seconds] if minutes < 60.0 && seconds < 61.0 => {
            (hours * 60.0 + minutes) * 60.0 + seconds
        }
        [minutes, seconds] if seconds < 61.0 => minutes * 60.0 + seconds,
        _ => return None,
    };
    let before = amount(days.rem_euclid(REPEAT).unsigned_abs());
    Some(before * 86400.0 + within)
}

/// A number written with digits and at most one point.
fn plain(text: &str) -> Option<f64> {
    let digits = text.chars().all(|char| char.is_ascii_digit() || char == '.');
    text.parse().ok().filter(|_| digits)
}

/// Number of the day `2026-03-02`, `2.3.2026` or `3/2/2026` in the calendar; in the last form the month comes first
/// unless it cannot be a month.
fn days(date: &str) -> Option<i64> {
    let part = |text: &str| text.parse::<i64>().ok();
    let three = |sign: char| {
        let parts: Vec<i64> = date.split(sign).map(part).collect::<Option<_>>()?;
        <[i64; 3]>::try_from(parts).ok()
    };
    let [year, month, day] = three('-')
        .or_else(|| three('.').map(|[day, month, year]| [year, month, day]))
        .or_else(|| {
            three('/').map(|[one, two, three]| match one {
                32.. => [one, two, three],
                // No month: the day comes first.
                13.. => [three, two, one],
                _ => [three, one, two],
            })
        })?;
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // If years begin in March, the leap day is their last day.
    let (year, month) = if month > 2 {
        (year, month - 3)
    } else {
        (year - 1, month + 9)
    };
    let leap = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    Some(365 * year + leap + (153 * month + 2) / 5 + day)
}

/// Parts of the names of time columns, in lower case.
const TIMES: &str = "time zeit temps tiempo seconds";

/// Parts of the names of displacement columns, in lower case, in order of preference, with blanks between them; single
/// letters are whole names.
const DISPLACEMENTS: &str = "displ weg auslenk deflec peak position amplitude extrem distance x q";

/// Parts of the names of columns that hold other signals, in lower case.
const SIGNALS: [(Signal, &str); 2] = [
    (Signal::Velocity, "velocity geschw vitesse"),
    (Signal::Acceleration, "accel beschl acc\u{e9}l"),
];

/// Names and units of the columns.
#[derive(Clone, Debug, Default)]
pub struct Header {
    /// One for each column; none if the file has no header.
    pub columns: Vec<ColumnHeader>,
}

/// What stands above a column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ColumnHeader {
    /// Its name.
    pub name: String,
    /// Its unit, if one is written.
    pub unit: Option<String>,
}

/// The value of a unit of time in seconds; `None` if it is unknown.
pub fn seconds_in(unit: &str) -> Option<f64> {
    in_si(&unit.to_lowercase(), TIME)
}

impl ColumnHeader {
    /// Whether one of these parts is in the name.
    fn name_has(&self, parts: &str) -> bool {
        let name = self.name.to_lowercase();
        parts.split(' ').any(|part| name.contains(part))
    }

    /// The signal that the name suggests.
    pub fn suggested(&self) -> Option<Signal> {
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

    /// The column with this name.
    pub fn named(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name.eq_ignore_ascii_case(name.trim()))
    }

    /// The first column that fits; `time` is the column of times, which is skipped.
    fn find(&self, time: Option<usize>, fits: impl Fn(&ColumnHeader) -> bool) -> Option<usize> {
        (0..self.columns.len()).find(|place| Some(*place) != time && fits(&self.columns[*place]))
    }

    /// The column of times. A column `T` holds temperatures.
    pub fn time(&self) -> Option<usize> {
        let is_called = |it: &ColumnHeader| it.name_has(TIMES);
        self.find(None, is_called).or_else(|| self.find(None, |it| it.name == "t"))
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
        DISPLACEMENTS.split(' ').find_map(|known| {
            let is_whole = known.len() == 1;
            self.find(time, |it| {
                if is_whole {
                    it.name.to_lowercase() == known
                } else {
                    it.name_has(known)
                }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_of_quotation_alone_is_nothing_special() {
        assert_eq!(split("a \"b,c", ','), ["a \"b", "c"]);
    }

    #[test]
    fn a_unit_in_brackets_belongs_to_the_name_before_it() {
        assert_eq!(words("t [s]  x [mm]"), ["t [s]", "x [mm]"]);
        assert_eq!(words("[s] (mm)"), ["[s]", "(mm)"]);
    }

    #[test]
    fn clocks_go_on_over_midnight_and_the_ends_of_months() {
        let step =
            |one: &str, other: &str| clock_seconds(other).unwrap() - clock_seconds(one).unwrap();
        assert_eq!(step("2026-02-28 23:59:59.5", "2026-03-01T00:00:00.5Z"), 1.0);
        assert_eq!(step("28.2.2024 23:59:59,5", "29.02.2024 00:00:00"), 0.5);
        assert_eq!(step("12/31/2025 23:59:59", "1/1/2026 00:00:01"), 2.0);
        assert_eq!(clock_seconds("01:02:03.25"), Some(3723.25));
        assert_eq!(clock_seconds("02:03"), Some(123.0));
        assert_eq!(step("31/12/2025 23:59:59", "31/12/2025 23:59:60"), 1.0);
        for text in [
            "12",
            "a:b",
            "12:",
            "rig 4: 3",
            "1:2:3:4",
            "-1:00",
            "12:61",
            "1:60:00",
            "2026-13-01 1:00",
        ] {
            assert_eq!(clock_seconds(text), None, "{text}");
        }
    }
}
