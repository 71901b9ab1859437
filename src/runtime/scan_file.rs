//! The file of a scan: it grows by one line a row, and can be gone on with after any end.
//!
//! Each line is handed to the system in one piece as soon as it is known, so that a process that is
//! killed loses what it was computing and at most leaves a line without its end. [`ScanFile::resume`]
//! trusts nothing: it compares the heading and the beginning of every line with what this scan would
//! write, computes the first and the last row again, and cuts a line that has no end.

use std::fmt;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use crate::flow::{Limits, Reason};
use crate::report::scan::Form;
use crate::session::Notice;
use crate::study::scan::{Row, Scan};

/// A file that takes rows.
#[derive(Debug)]
pub struct ScanFile {
    file: File,
    form: Form,
}

/// Why a file cannot take rows.
#[derive(Debug)]
pub enum Refusal {
    /// It cannot be opened, read or written.
    Io(io::Error),
    /// Another process writes to it.
    Busy,
    /// It holds something else.
    Foreign {
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        why: &'static str,
    },
    /// The check was interrupted.
    Interrupted,
}

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        Refusal::Io(error)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Io(error) => write!(out, "{error}"),
            Refusal::Busy => write!(out, "another scan is writing to it"),
            Refusal::Foreign { line, why } => {
                write!(out, "not a part of this scan: line {line} {why}")
            }
            Refusal::Interrupted => write!(out, "interrupted"),
        }
    }
}

impl ScanFile {
    /// An empty file with nothing but the heading, if it is to have one.
    ///
    /// # Errors
    /// The [`Refusal`].
    pub fn create(path: &Path, scan: &Scan, form: Form, headed: bool) -> Result<Self, Refusal> {
        let mut this = ScanFile { file: opened(path)?, form };
        if this.file.metadata()?.is_file() {
            this.file.set_len(0)?;
        }
        this.begin(scan, headed)?;
        Ok(this)
    }

    /// The file with the rows of these points that it holds already, and how many those are; a new file
    /// if there is none.
    ///
    /// # Errors
    /// The [`Refusal`]; then the file is as it was.
    pub fn resume(
        path: &Path,
        scan: &Scan,
        form: Form,
        headed: bool,
        points: Range<usize>,
        limits: &Limits,
    ) -> Result<(Self, usize), Refusal> {
        let file = opened(path)?;
        let mut this = ScanFile { file, form };
        let Some(kept) = this.kept(scan, headed, points, limits)? else {
            this.file.set_len(0)?;
            this.file.rewind()?;
            this.begin(scan, headed)?;
            return Ok((this, 0));
        };
        this.file.set_len(kept.bytes)?;
        this.file.seek(SeekFrom::End(0))?;
        Ok((this, kept.rows))
    }

    /// Adds a row.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn add(&mut self, scan: &Scan, index: usize, row: &Row) -> io::Result<()> {
        self.file.write_all(self.form.line(scan, index, row).as_bytes())
    }

    fn begin(&mut self, scan: &Scan, headed: bool) -> io::Result<()> {
        let heading = if headed { self.form.heading(scan) } else { String::new() };
        self.file.write_all(heading.as_bytes())
    }

    /// What of the file belongs to this scan; nothing where not even the heading is whole.
    fn kept(
        &mut self,
        scan: &Scan,
        headed: bool,
        points: Range<usize>,
        limits: &Limits,
    ) -> Result<Option<Kept>, Refusal> {
        let mut lines = Lines::new(&self.file);
        let heading = if headed { self.form.heading(scan) } else { String::new() };
        if !lines.heading(&heading)? {
            return Ok(None);
        }
        let mut kept = Kept { rows: 0, bytes: lines.bytes };
        let mut last = None;
        loop {
            let index = points.start + kept.rows;
            let line = match lines.next(usize::MAX)? {
                Line::Whole(line) => line,
                Line::Cut(begun) => {
                    let expected = self.form.beginning(scan, index.min(points.end - 1));
                    let common = begun.len().min(expected.len());
                    if begun[..common] != expected.as_bytes()[..common] {
                        return Err(lines.foreign("is of another point"));
                    }
                    break;
                }
            };
            if index >= points.end {
                return Err(lines.foreign("is one more than it has points"));
            }
            if !line.starts_with(self.form.beginning(scan, index).as_bytes()) {
                return Err(lines.foreign("is of another point"));
            }
            kept = Kept { rows: kept.rows + 1, bytes: lines.bytes };
            if kept.rows == 1 {
                compare(scan, self.form, (index, &line), lines.number, limits)?;
            } else {
                last = Some((index, line));
            }
        }
        if let Some((index, line)) = last {
            let number = kept.rows + usize::from(!heading.is_empty());
            compare(scan, self.form, (index, &line), number, limits)?;
        }
        Ok(Some(kept))
    }
}

/// Computes the row that stands in line `number` again: the same program on the same scan writes the same line.
pub(super) fn compare(
    scan: &Scan,
    form: Form,
    (index, line): (usize, &[u8]),
    number: usize,
    limits: &Limits,
) -> Result<(), Refusal> {
    let row = scan.row(index, limits).map_err(|_: Reason| Refusal::Interrupted)?;
    if form.line(scan, index, &row).as_bytes() == line {
        Ok(())
    } else {
        Err(Refusal::Foreign { line: number, why: "is different when computed again" })
    }
}

/// Opens a file for one scan at a time, without changing what is in it.
fn opened(path: &Path) -> Result<File, Refusal> {
    let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(Refusal::Busy),
        // Where files cannot be locked, that nobody else writes is up to the user.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Writes rows that are known to a file, in the form that its name ends with, and says how that ended.
///
/// A file that holds the beginning of the same scan is gone on with, one of anything else left alone.
#[must_use]
pub fn save(path: &Path, scan: &Scan, rows: &[Row]) -> Notice {
    let form = Form::of_file(path);
    let points = 0..scan.points();
    let opened = ScanFile::resume(path, scan, form, true, points, &Limits::PATIENT);
    let name = path.display();
    let written = opened.and_then(|(mut file, done)| {
        for (index, row) in rows.iter().enumerate().skip(done) {
            file.add(scan, index, row)?;
        }
        Ok(rows.len().max(done))
    });
    match written {
        Ok(count) => Notice { error: false, text: format!("{name} has {count} rows") },
        Err(why) => Notice { error: true, text: format!("{name}: {why}") },
    }
}

/// How much of a file is good.
#[derive(Clone, Copy, Debug)]
struct Kept {
    rows: usize,
    bytes: u64,
}

/// The lines of a file, counted.
pub(super) struct Lines<R> {
    reader: BufReader<R>,
    /// The line read last, from 1.
    number: usize,
    /// Bytes up to the end of the last whole line.
    bytes: u64,
}

/// A line of a file.
pub(super) enum Line {
    /// With its end.
    Whole(Vec<u8>),
    /// Without: the last one, perhaps empty.
    Cut(Vec<u8>),
}

impl<R: Read> Lines<R> {
    pub(super) fn new(file: R) -> Self {
        Lines { reader: BufReader::new(file), number: 0, bytes: 0 }
    }

    /// The number of the line read last, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// Reads this heading, if it is not empty; false where the file ends within it.
    pub(super) fn heading(&mut self, heading: &str) -> Result<bool, Refusal> {
        if heading.is_empty() {
            return Ok(true);
        }
        match self.next(heading.len())? {
            Line::Whole(line) if line == heading.as_bytes() => Ok(true),
            Line::Cut(begun) if heading.as_bytes().starts_with(&begun) => Ok(false),
            _ => Err(self.foreign("names other columns")),
        }
    }

    /// The next line; a line longer than `most` is cut there.
    pub(super) fn next(&mut self, most: usize) -> io::Result<Line> {
        let mut line = Vec::new();
        let most = u64::try_from(most).unwrap_or(u64::MAX);
        (&mut self.reader).take(most).read_until(b'\n', &mut line)?;
        self.number += 1;
        if line.last() == Some(&b'\n') {
            self.bytes += line.len() as u64;
            Ok(Line::Whole(line))
        } else {
            Ok(Line::Cut(line))
        }
    }

    pub(super) fn foreign(&self, why: &'static str) -> Refusal {
        Refusal::Foreign { line: self.number, why }
    }
}
