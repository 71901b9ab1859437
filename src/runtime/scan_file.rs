//! The file of a scan: it grows by one line per row, and can be resumed however it ended.
//!
//! Each line is handed to the system in one piece as soon as it is ready: to the file or, before its turn, to
//! the [`Journal`]. So a killed process loses only the rows that it was computing, and at most leaves an
//! incomplete line. [`ScanFile::resume`] trusts nothing: it compares the heading and the beginning of every
//! line with what this scan would write, computes the first and the last row again, and cuts an incomplete
//! line.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use super::effects::at_home;
use super::journal::Journal;
pub use super::lines::LineRefusal;
use super::lines::{FileLine, Lines};
use super::provenance_file;
use crate::flow::{Limits, Reason};
use crate::report::scan::RowForm;
use crate::session::Notice;
use crate::study::scan::{Scan, ScanRow};

/// A file to which rows are added.
#[derive(Debug)]
pub struct ScanFile {
    file: File,
    form: RowForm,
    journal: Journal,
    /// Rows from the journal of an earlier process whose turn has not come.
    ahead: BTreeMap<usize, String>,
    /// Rows that this process has added to the journal and whose turn has not come.
    noted: BTreeSet<usize>,
    points: Range<usize>,
}

impl ScanFile {
    /// An empty file, with the heading if there is to be one.
    pub fn create(
        path: &Path,
        scan: &Scan,
        form: RowForm,
        headed: bool,
        points: Range<usize>,
    ) -> Result<Self, LineRefusal> {
        let mut this = ScanFile {
            file: opened(path)?,
            form,
            journal: Journal::new(path),
            ahead: BTreeMap::new(),
            noted: BTreeSet::new(),
            points,
        };
        if this.file.metadata()?.is_file() {
            this.file.set_len(0)?;
        }
        this.begin(scan, headed)?;
        Ok(this)
    }

    /// The file with those rows of these points that it already holds, and their number; a new file if there is
    /// none. Fails with the [`LineRefusal`]; the file is then unchanged.
    pub fn resume(
        path: &Path,
        scan: &Scan,
        form: RowForm,
        headed: bool,
        points: Range<usize>,
        limits: &Limits,
    ) -> Result<(Self, usize), LineRefusal> {
        let mut file = opened(path)?;
        let kept = kept((&mut file, form), scan, headed, &points, limits)?;
        let rows = kept.map_or(0, |kept| kept.rows);
        let left = points.start + rows..points.end;
        let (journal, ahead) = Journal::resume(path, scan, form, &left);
        let mut this =
            ScanFile { file, form, journal, ahead, noted: BTreeSet::new(), points: left };
        this.file.set_len(kept.map_or(0, |kept| kept.bytes))?;
        this.file.seek(SeekFrom::End(0))?;
        if kept.is_none() {
            this.begin(scan, headed)?;
        }
        let done = this.catch_up()?;
        Ok((this, rows + done))
    }

    /// Whether an earlier process has computed this row and its turn has not come.
    pub fn has(&self, index: usize) -> bool {
        self.ahead.contains_key(&index)
    }

    /// Number of rows for which [`ScanFile::has`] is true.
    pub fn ahead(&self) -> usize {
        self.ahead.len()
    }

    /// Saves a row before its turn. Fails if the journal cannot be written.
    pub fn keep(&mut self, scan: &Scan, index: usize, row: &ScanRow) -> io::Result<()> {
        self.noted.insert(index);
        self.journal.note(scan, self.form, (index, &self.form.line(scan, index, row)))
    }

    /// Adds the next row that no earlier process has computed, and the rows after it that one has. Fails if the
    /// file cannot be written.
    pub fn add(&mut self, scan: &Scan, index: usize, row: &ScanRow) -> io::Result<()> {
        self.file.write_all(self.form.line(scan, index, row).as_bytes())?;
        self.points.start = index + 1;
        self.noted.remove(&index);
        self.catch_up().map(drop)
    }

    /// Adds rows from the journal whose turn has come, and returns their number; removes the journal if it is
    /// of no further use.
    fn catch_up(&mut self) -> io::Result<usize> {
        let mut count = 0;
        while let Some(row) = self.ahead.remove(&self.points.start) {
            self.file.write_all(row.as_bytes())?;
            self.points.start += 1;
            count += 1;
        }
        if self.points.is_empty() {
            self.journal.end();
        } else if self.ahead.is_empty() && self.noted.is_empty() {
            self.journal.is_served();
        }
        Ok(count)
    }

    fn begin(&mut self, scan: &Scan, headed: bool) -> io::Result<()> {
        let heading = if headed { self.form.heading(scan) } else { String::new() };
        self.file.write_all(heading.as_bytes())
    }
}

/// The part of the file that belongs to this scan; `None` if not even the heading is complete.
fn kept(
    (file, form): (&mut File, RowForm),
    scan: &Scan,
    headed: bool,
    points: &Range<usize>,
    limits: &Limits,
) -> Result<Option<KeptRows>, LineRefusal> {
    let mut lines = Lines::new(file);
    let heading = if headed { form.heading(scan) } else { String::new() };
    if !lines.heading(&heading)? {
        return Ok(None);
    }
    let mut kept = KeptRows { rows: 0, bytes: lines.bytes() };
    let mut last = None;
    loop {
        let index = points.start + kept.rows;
        let line = match lines.next(usize::MAX)? {
            FileLine::Whole(line) => line,
            FileLine::Cut(begun) => {
                let expected = form.beginning(scan, index.min(points.end - 1));
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
        if !line.starts_with(form.beginning(scan, index).as_bytes()) {
            return Err(lines.foreign("is of another point"));
        }
        kept = KeptRows { rows: kept.rows + 1, bytes: lines.bytes() };
        if kept.rows == 1 {
            compare(scan, form, (index, &line), lines.number(), limits)?;
        } else {
            last = Some((index, line));
        }
    }
    if let Some((index, line)) = last {
        let number = kept.rows + usize::from(!heading.is_empty());
        compare(scan, form, (index, &line), number, limits)?;
    }
    Ok(Some(kept))
}

/// Computes the row in line `number` again and compares it: the same program writes the same line for the same
/// scan.
pub(super) fn compare(
    scan: &Scan,
    form: RowForm,
    (index, line): (usize, &[u8]),
    number: usize,
    limits: &Limits,
) -> Result<(), LineRefusal> {
    let row = scan.row(index, limits).map_err(|_: Reason| LineRefusal::Interrupted)?;
    if form.line(scan, index, &row).as_bytes() == line {
        Ok(())
    } else {
        Err(LineRefusal::Foreign { line: number, why: "is different when computed again" })
    }
}

/// Opens a file for one scan at a time, without changing its content.
fn opened(path: &Path) -> Result<File, LineRefusal> {
    let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(LineRefusal::Busy),
        // Where files cannot be locked, the user must make sure that no other process writes.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Writes known rows to a file, in the form given by its extension, and reports the result.
///
/// If the file holds the beginning of the same scan, it is continued; a file with any other content is left
/// alone. A new file is complete or not there at all.
pub fn save(path: &Path, scan: &Scan, rows: &[ScanRow]) -> Notice {
    let path = &at_home(path);
    let form = RowForm::of_file(path);
    let is_new = !path.exists();
    let points = 0..scan.points();
    let opened = ScanFile::resume(path, scan, form, true, points, &Limits::PATIENT);
    let name = path.display();
    let written = opened.and_then(|(mut file, done)| {
        for (index, row) in rows.iter().enumerate().skip(done) {
            if !file.has(index) {
                file.add(scan, index, row)?;
            }
        }
        if done == 0 {
            provenance_file::write(path, &provenance_file::of_process())?;
        }
        Ok(rows.len().max(done))
    });
    match written {
        Ok(count) => Notice { error: false, text: format!("{name} has {count} rows") },
        Err(why) => {
            if is_new {
                drop(std::fs::remove_file(path));
            }
            Notice { error: true, text: format!("{name}: {why}") }
        }
    }
}

/// The valid beginning of a file.
#[derive(Clone, Copy, Debug)]
struct KeptRows {
    rows: usize,
    bytes: u64,
}
