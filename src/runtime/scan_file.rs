//! The file of a scan: it grows by one line per row, and can be resumed however it ended.
//!
//! Each line is handed to the system in one piece as soon as it is ready: to the file or, before its turn, to
//! the [`Journal`]. So a killed process loses only the rows that it was computing, and at most leaves an
//! incomplete line. [`ScanFile::resume`] trusts nothing: it compares the heading and the beginning of every
//! line with what this scan would write, the rows with their checksum in the provenance, computes the first and
//! the last row again, and cuts an incomplete line and a row that has no checksum yet.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::effects::at_home;
use super::failure::{Failure, Result};
use super::journal::Journal;
use super::new_file;
use super::provenance_file::{self, RunningChecksum};
use super::{FileRow, Readers, RowReader, packed, standard, system};
use crate::flow::Limits;
use crate::report::Format;
use crate::report::scan::ScanPart;
use crate::scan::{Scan, ScanRow};
use crate::words::provenance::{Checksum, Provenance};

/// A file to which rows are added.
pub struct ScanFile {
    /// The rows that are left.
    part: ScanPart,
    /// `None` for standard output.
    file: Option<File>,
    journal: Journal,
    /// `None` for a device or a pipe, and for standard output.
    checksum: Option<RunningChecksum>,
    /// Number of rows of an earlier process that have no checksum and were not computed again.
    pub unchecked: usize,
}

impl ScanFile {
    /// Standard output, on which the heading has been printed.
    pub fn standard(part: ScanPart) -> Self {
        let journal = Journal::new(None, &part);
        ScanFile { part, file: None, journal, checksum: None, unchecked: 0 }
    }

    /// A file with nothing but the heading, if there is to be one. Fails if it cannot be written, or another scan
    /// writes to it.
    pub fn create(path: &Path, part: ScanPart, provenance: Provenance) -> Result<Self> {
        let heading = part.heading();
        let unwritten = Failure::unwritten(path);
        if !new_file::is_regular(path) {
            let mut file = system::device(path).map_err(unwritten)?;
            file.write_all(heading.as_bytes()).map_err(unwritten)?;
            return Ok(ScanFile { file: Some(file), ..ScanFile::standard(part) });
        }
        if path.exists() {
            // Another scan that is writing to it keeps it.
            drop(opened(path)?);
        }
        // Before the old rows go: where there is no room for this, there is none for rows.
        let checksum = Some(RunningChecksum::begin(path, provenance, Checksum::NONE)?);
        new_file::write(path, heading.as_bytes(), Readers::Usual, None)?;
        let mut file = opened(path)?;
        file.seek(SeekFrom::End(0)).map_err(unwritten)?;
        let journal = Journal::new(Some(path), &part);
        Ok(ScanFile { part, file: Some(file), journal, checksum, unchecked: 0 })
    }

    /// The file with those rows of the part that it already holds; a new file if there is none. Fails if it holds
    /// something else, to which `how` adds what helps, or cannot be written; the file is then unchanged.
    pub fn resume(
        path: &Path,
        part: ScanPart,
        provenance: Provenance,
        how: &str,
        limits: &Limits,
    ) -> Result<Self> {
        let unwritten = Failure::unwritten(path);
        let mut file = opened(path)?;
        let known = provenance_file::read(path).ok().and_then(|earlier| earlier.checksum);
        let reading = file.try_clone().map_err(unwritten)?;
        let rows = RowReader::new(&part, path, reading, known);
        let rows = rows.and_then(|rows| kept(rows, known, limits));
        let (bytes, checksum) = rows.map_err(|why| format!("{why}{how}"))?;
        let unchecked = if known == Some(checksum) {
            0
        } else {
            checksum.rows.saturating_sub(2)
        };
        file.set_len(bytes).map_err(unwritten)?;
        file.seek(SeekFrom::End(0)).map_err(unwritten)?;
        if bytes == 0 {
            file.write_all(part.heading().as_bytes()).map_err(unwritten)?;
        }
        let points = part.points.start + checksum.rows..part.points.end;
        let part = ScanPart { points, ..part };
        let journal = Journal::resume(path, &part);
        let checksum = Some(RunningChecksum::begin(path, provenance, checksum)?);
        let mut this = ScanFile { part, file: Some(file), journal, checksum, unchecked };
        this.catch_up().map_err(unwritten)?;
        Ok(this)
    }

    /// Number of rows that are left to be written.
    pub fn left(&self) -> usize {
        self.part.points.len()
    }

    /// Number of those that have been computed before their turn.
    pub fn ahead(&self) -> usize {
        self.journal.rows.len()
    }

    /// The points whose rows are left to be computed.
    pub fn open(&self) -> impl Iterator<Item = usize> + use<> {
        let ahead: BTreeSet<usize> = self.journal.rows.keys().copied().collect();
        self.part.points.clone().filter(move |index| !ahead.contains(index))
    }

    /// Adds a row: to the file if its turn has come, with those after it that are known, else to the journal. Fails if
    /// the file or the journal cannot be written.
    pub fn add(&mut self, index: usize, row: &ScanRow) -> io::Result<()> {
        let line = self.part.line(index, row);
        if index > self.part.points.start {
            return self.journal.note(index, line);
        }
        self.write(&line)?;
        self.catch_up()
    }

    /// Adds the rows of the journal whose turn has come, and removes the journal if it is of no further use.
    fn catch_up(&mut self) -> io::Result<()> {
        while let Some(row) = self.journal.take(self.part.points.start) {
            self.write(&row)?;
        }
        if self.part.points.is_empty() {
            self.journal.end();
        }
        Ok(())
    }

    fn write(&mut self, row: &str) -> io::Result<()> {
        match &mut self.file {
            Some(file) => file.write_all(row.as_bytes())?,
            None => standard::print(row)?,
        }
        self.part.points.start += 1;
        self.checksum.as_mut().map_or(Ok(()), |checksum| checksum.count(row.as_bytes()))
    }
}

/// The file of the rows of which a file of arrays is made when all are known.
pub fn rows_of(path: &Path) -> PathBuf {
    new_file::beside(path, ".csv")
}

/// Makes a file of arrays of all rows, which then go. Fails if one cannot be read or written, or, without `force`, if the
/// file has other content.
pub fn pack(path: &Path, provenance: &Provenance, force: bool) -> Result<()> {
    let rows = rows_of(path);
    let text = fs::read_to_string(&rows).map_err(|error| Failure::file(&rows, error))?;
    let content = packed::packed_rows(path, &text)?;
    let keep = (!force).then_some("--force replaces it");
    new_file::write(path, &content, Readers::Usual, keep)?;
    provenance_file::write(path, provenance)?;
    drop(fs::remove_file(provenance_file::beside(&rows)));
    fs::remove_file(&rows).map_err(Failure::unwritten(&rows))
}

/// The valid beginning of a file, up to the last row of the `known` checksum: its length in bytes, and the checksum of
/// its rows, of which the first and the last are computed again. A file that is shorter than that is taken as it is.
fn kept(mut rows: RowReader, known: Option<Checksum>, limits: &Limits) -> Result<(u64, Checksum)> {
    let mut kept = (rows.bytes, Checksum::NONE);
    let mut last: Option<FileRow> = None;
    while let Some(row) = rows.row()? {
        rows.in_turn(&row)?;
        if last.is_none() {
            rows.check(&row, limits)?;
        }
        if known.is_none_or(|known| rows.checksum.rows <= known.rows) {
            kept = (rows.bytes, rows.checksum);
            last = Some(row);
        }
    }
    last.filter(|_| kept.1.rows > 1).map_or(Ok(()), |row| rows.check(&row, limits))?;
    Ok(kept)
}

/// Opens a file for one scan at a time, without changing its content.
fn opened(path: &Path) -> Result<File> {
    if !new_file::is_regular(path) {
        return Err(Failure::file(path, "not a file"));
    }
    let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
    let file = file.map_err(Failure::unwritten(path))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(Failure::file(path, "another scan is writing to it")),
        // Where files cannot be locked, the user must make sure that no other process writes.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// Writes known rows to a file, in the form given by its extension; says so in one line, or fails with one.
///
/// If the file holds the beginning of the same scan, it is continued; a file with any other content is left
/// alone. A new file is complete or not there at all.
pub fn save(path: &Path, scan: &Scan, rows: &[ScanRow]) -> Result<String, String> {
    let path = &at_home(path);
    if packed::is_of_arrays(path) {
        return Err("rows are saved as .csv, .json or .jsonl".to_owned());
    }
    let is_new = !path.exists();
    let (form, points) = (Format::of_file(path), 0..scan.points());
    let part = ScanPart { scan: scan.clone(), form, points, headed: true, brackets: None };
    let part = part.in_file(path);
    let provenance = provenance_file::read(path).unwrap_or_else(|_| provenance_file::of_process());
    let written =
        ScanFile::resume(path, part, provenance, "", &Limits::PATIENT).and_then(|mut file| {
            for index in file.open().take_while(|index| *index < rows.len()) {
                file.add(index, &rows[index]).map_err(Failure::unwritten(path))?;
            }
            Ok(scan.points() - file.left())
        });
    if written.is_err() && is_new {
        drop(fs::remove_file(path));
        drop(fs::remove_file(provenance_file::beside(path)));
    }
    written
        .map(|count| format!("{} has {count} rows", path.display()))
        .map_err(|why| why.to_string())
}
