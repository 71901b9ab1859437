//! The file of a scan: it grows by one line per row, and can be resumed however it ended.
//!
//! Each line is handed to the system in one piece as soon as it is ready: to the file or, before its turn, to
//! the [`Journal`]. So a killed process loses only the rows that it was computing, and at most leaves an
//! incomplete line. [`ScanFile::resume`] trusts nothing: it compares the heading and the beginning of every
//! line with what this scan would write, the rows with their checksum in the provenance, computes the first and
//! the last row again, and cuts an incomplete line and a row that has no checksum yet.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use super::effects::at_home;
use super::journal::Journal;
pub use super::lines::LineRefusal;
use super::lines::{FileLine, FileLines};
use super::new_file::{self, Readers};
use super::provenance_file::{self, RunningChecksum};
use crate::flow::{Limits, Reason};
use crate::report::Format;
use crate::scan::grid::{Scan, ScanRow};
use crate::session::Notice;
use crate::words::provenance::{Checksum, Provenance};

/// A file to which rows are added.
#[derive(Debug)]
pub struct ScanFile {
    file: File,
    form: Format,
    /// Neither the journal nor the checksum exists beside a device or a pipe.
    journal: Option<Journal>,
    checksum: Option<RunningChecksum>,
    /// Rows from the journal of an earlier process whose turn has not come.
    ahead: BTreeMap<usize, String>,
    /// Rows that this process has added to the journal and whose turn has not come.
    noted: BTreeSet<usize>,
    points: Range<usize>,
    /// Number of rows of an earlier process that have no checksum and were not computed again.
    pub unchecked: usize,
}

impl ScanFile {
    /// A file with nothing but the heading, if there is to be one.
    pub fn create(
        path: &Path,
        scan: &Scan,
        form: Format,
        headed: bool,
        points: Range<usize>,
        provenance: Provenance,
    ) -> Result<Self, LineRefusal> {
        let heading = if headed { form.heading(scan) } else { String::new() };
        let (file, journal, checksum) = if new_file::is_regular(path) {
            if path.exists() {
                // Another scan that is writing to it keeps it.
                drop(opened(path)?);
            }
            // Before the old rows go: where there is no room for this, there is none for rows.
            let checksum = RunningChecksum::begin(path, provenance, Checksum::NONE)?;
            new_file::write(path, heading.as_bytes(), Readers::Usual, true)?;
            let mut file = opened(path)?;
            file.seek(SeekFrom::End(0))?;
            (file, Some(Journal::new(path)), Some(checksum))
        } else {
            let mut file = new_file::device(path)?;
            file.write_all(heading.as_bytes())?;
            (file, None, None)
        };
        let (ahead, noted) = (BTreeMap::new(), BTreeSet::new());
        Ok(ScanFile { file, form, journal, checksum, ahead, noted, points, unchecked: 0 })
    }

    /// The file with those rows of these points that it already holds, and their number; a new file if there is
    /// none. Fails with the [`LineRefusal`]; the file is then unchanged.
    pub fn resume(
        path: &Path,
        scan: &Scan,
        form: Format,
        headed: bool,
        points: Range<usize>,
        provenance: Provenance,
        limits: &Limits,
    ) -> Result<(Self, usize), LineRefusal> {
        let mut file = opened(path)?;
        let heading = if headed { form.heading(scan) } else { String::new() };
        let known = provenance_file::read(path).ok().and_then(|earlier| earlier.checksum);
        let kept = kept((&mut file, form), scan, &heading, &points, known, limits)?;
        let KeptRows { bytes, checksum } = kept.unwrap_or(KeptRows::NONE);
        let rows = checksum.rows;
        let unchecked = if known == Some(checksum) { 0 } else { rows.saturating_sub(2) };
        let left = points.start + rows..points.end;
        let (journal, ahead) = Journal::resume(path, scan, form, &left);
        file.set_len(bytes)?;
        file.seek(SeekFrom::End(0))?;
        if kept.is_none() {
            file.write_all(heading.as_bytes())?;
        }
        let checksum = Some(RunningChecksum::begin(path, provenance, checksum)?);
        let (journal, noted) = (Some(journal), BTreeSet::new());
        let mut this =
            ScanFile { file, form, journal, checksum, ahead, noted, points: left, unchecked };
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
        let Some(journal) = &mut self.journal else { return Ok(()) };
        self.noted.insert(index);
        journal.note(scan, self.form, (index, &self.form.line(scan, index, row)))
    }

    /// Adds the next row that no earlier process has computed, and the rows after it that one has. Fails if the
    /// file cannot be written.
    pub fn add(&mut self, scan: &Scan, index: usize, row: &ScanRow) -> io::Result<()> {
        self.write(self.form.line(scan, index, row).as_bytes())?;
        self.points.start = index + 1;
        self.noted.remove(&index);
        self.catch_up().map(drop)
    }

    /// Adds rows from the journal whose turn has come, and returns their number; removes the journal if it is
    /// of no further use.
    fn catch_up(&mut self) -> io::Result<usize> {
        let mut count = 0;
        while let Some(row) = self.ahead.remove(&self.points.start) {
            self.write(row.as_bytes())?;
            self.points.start += 1;
            count += 1;
        }
        let Some(journal) = &mut self.journal else { return Ok(count) };
        if self.points.is_empty() {
            journal.end();
        } else if self.ahead.is_empty() && self.noted.is_empty() {
            journal.is_served();
        }
        Ok(count)
    }

    fn write(&mut self, row: &[u8]) -> io::Result<()> {
        self.file.write_all(row)?;
        self.checksum.as_mut().map_or(Ok(()), |checksum| checksum.count(row))
    }
}

/// The part of the file that belongs to this scan, up to the last row of the `known` checksum; `None` if not even
/// the heading is complete. A file that is shorter than that is taken as it is.
fn kept(
    (file, form): (&mut File, Format),
    scan: &Scan,
    heading: &str,
    points: &Range<usize>,
    known: Option<Checksum>,
    limits: &Limits,
) -> Result<Option<KeptRows>, LineRefusal> {
    let mut lines = FileLines::new(file);
    if !lines.heading(heading)? {
        return Ok(None);
    }
    let mut found = KeptRows { bytes: lines.bytes(), checksum: Checksum::NONE };
    let mut kept = (found, None);
    loop {
        let index = points.start + found.checksum.rows;
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
        found = KeptRows { bytes: lines.bytes(), checksum: found.checksum.and(&line) };
        let rows = found.checksum.rows;
        if rows == 1 {
            compare(scan, form, (index, &line), lines.number(), limits)?;
        }
        if known.is_some_and(|known| known.rows == rows && known != found.checksum) {
            return Err(LineRefusal::Altered { rows });
        }
        if known.is_none_or(|known| rows <= known.rows) {
            kept = (found, Some((index, line)));
        }
    }
    let (kept, last) = kept;
    if let Some((index, line)) = last.filter(|_| kept.checksum.rows > 1) {
        let number = kept.checksum.rows + usize::from(!heading.is_empty());
        compare(scan, form, (index, &line), number, limits)?;
    }
    Ok(Some(kept))
}

/// Computes the row in line `number` again and compares it: the same program writes the same line for the same
/// scan.
pub(super) fn compare(
    scan: &Scan,
    form: Format,
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
    if !new_file::is_regular(path) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "not a file").into());
    }
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
    let form = Format::of_file(path);
    let is_new = !path.exists();
    let points = 0..scan.points();
    let provenance = provenance_file::read(path).unwrap_or_else(|_| provenance_file::of_process());
    let limits = &Limits::PATIENT;
    let opened = ScanFile::resume(path, scan, form, true, points, provenance, limits);
    let name = path.display();
    let written = opened.and_then(|(mut file, done)| {
        for (index, row) in rows.iter().enumerate().skip(done) {
            if !file.has(index) {
                file.add(scan, index, row)?;
            }
        }
        Ok(rows.len().max(done))
    });
    match written {
        Ok(count) => Notice { error: false, text: format!("{name} has {count} rows") },
        Err(why) => {
            if is_new {
                drop(fs::remove_file(path));
                drop(fs::remove_file(provenance_file::beside(path)));
            }
            Notice { error: true, text: format!("{name}: {why}") }
        }
    }
}

/// The valid beginning of a file: its length, and the checksum of its rows.
#[derive(Clone, Copy, Debug)]
struct KeptRows {
    bytes: u64,
    checksum: Checksum,
}

impl KeptRows {
    const NONE: KeptRows = KeptRows { bytes: 0, checksum: Checksum::NONE };
}
