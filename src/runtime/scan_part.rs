//! The rows of a scan read back from a file, and the files of several parts merged row by row: these are read side by
//! side in the order of their points, so that only one row per open part is held.
//!
//! Nothing in a file is trusted: every row is recognized by its beginning, which names everything that it depends on,
//! and compared with the checksum of the rows up to it where one is known.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::failure::{Failure, Result};
use crate::flow::{Limits, Reason};
use crate::report::scan::ScanPart;
use crate::words::provenance::{Checksum, Provenance};

/// A row as it stands in a file.
pub struct FileRow {
    /// The number of its line, from 1.
    number: usize,
    /// Its point.
    pub index: usize,
    pub line: Vec<u8>,
}

/// Longest line that is read, in bytes: a row has no more than some thousand.
const LONGEST: u64 = 1 << 20;

/// Why a row does not stand where the next one is to stand.
const OTHER: &str = "is of another point";

/// The rows in a file, read one at a time.
pub struct RowReader<'a> {
    part: &'a ScanPart,
    path: &'a Path,
    file: BufReader<File>,
    /// The checksum that is known of some of its rows.
    known: Option<Checksum>,
    /// Number of lines that were read.
    number: usize,
    /// The first point of which the next row may be.
    next: usize,
    /// The checksum of the rows that were read.
    pub checksum: Checksum,
    /// Length in bytes up to the end of the last whole line.
    pub bytes: u64,
}

impl<'a> RowReader<'a> {
    /// Reads the heading, if there is to be one; a file that ends within it has no rows. Fails if it begins with
    /// anything else, or cannot be read.
    pub fn new(
        part: &'a ScanPart,
        path: &'a Path,
        file: File,
        known: Option<Checksum>,
    ) -> Result<Self> {
        let (file, next, checksum) = (BufReader::new(file), part.points.start, Checksum::NONE);
        let mut this = RowReader { part, path, file, known, number: 0, next, checksum, bytes: 0 };
        let heading = part.heading();
        if !heading.is_empty() {
            let line = this.line(heading.len() as u64)?;
            if line != heading.as_bytes()
                && (this.bytes > 0 || !heading.as_bytes().starts_with(&line))
            {
                let own = heading.trim_end();
                return Err(this.foreign(1, &format!("names other columns than {own}")));
            }
        }
        Ok(this)
    }

    /// The next row, which may be of a later point than the one after the last row; `None` at the end of the file.
    /// Fails if it is not a row of the part, or the rows up to it have another checksum than those that were written.
    pub fn row(&mut self) -> Result<Option<FileRow>> {
        let line = self.line(LONGEST)?;
        let part = self.part;
        if line.last() != Some(&b'\n') {
            let expected = part.beginning(self.next.min(part.points.end - 1));
            let is_own = line.iter().zip(expected.bytes()).all(|(own, other)| *own == other);
            return if is_own {
                Ok(None)
            } else {
                Err(self.foreign(self.number, OTHER))
            };
        }
        let mut left = self.next..part.points.end;
        let why = if left.is_empty() {
            "is one more than it has points"
        } else {
            OTHER
        };
        let own = left.find(|index| line.starts_with(part.beginning(*index).as_bytes()));
        let index = own.ok_or_else(|| self.foreign(self.number, why))?;
        self.next = index + 1;
        self.checksum = self.checksum.and(&line);
        let rows = self.checksum.rows;
        if self.known.is_some_and(|known| known.rows == rows && known != self.checksum) {
            let why = format!("the checksum of its first {rows} rows is another in .provenance");
            return Err(Failure::file(self.path, format!("altered: {why}")));
        }
        Ok(Some(FileRow { number: self.number, index, line }))
    }

    /// Computes a row again and compares it: the same program writes the same line for the same scan.
    pub fn check(&self, row: &FileRow, limits: &Limits) -> Result<()> {
        let again = self.part.scan.row(row.index, limits);
        let again = again.map_err(|_: Reason| Failure::file(self.path, "interrupted"))?;
        if self.part.line(row.index, &again).as_bytes() == row.line {
            return Ok(());
        }
        Err(self.foreign(row.number, "is different when computed again"))
    }

    /// A line that is of something else than the part.
    fn foreign(&self, number: usize, why: &str) -> Failure {
        Failure::file(self.path, format!("not a part of this scan: line {number} {why}"))
    }

    /// Refuses the row that was read last if a point before its own has no row.
    pub fn in_turn(&self, row: &FileRow) -> Result<()> {
        if row.index < self.part.points.start + self.checksum.rows {
            return Ok(());
        }
        Err(self.foreign(row.number, OTHER))
    }

    /// The next line, with its end unless it was cut; one that is longer than `most` bytes is cut there. Fails if it is
    /// longer than any row.
    fn line(&mut self, most: u64) -> Result<Vec<u8>> {
        let mut line = Vec::new();
        let read = (&mut self.file).take(most.min(LONGEST)).read_until(b'\n', &mut line);
        read.map_err(|error| Failure::file(self.path, &error))?;
        self.number += 1;
        if line.len() as u64 == LONGEST {
            let (number, most) = (self.number, LONGEST >> 20);
            let why = format!("line {number} is longer than {most} MB");
            return Err(Failure::file(self.path, why));
        }
        if line.last() == Some(&b'\n') {
            self.bytes += line.len() as u64;
        }
        Ok(line)
    }
}

/// A file with some of the rows of a scan.
pub struct PartFile {
    pub path: PathBuf,
    pub part: ScanPart,
    /// What wrote it, with the checksum of its rows, if that is known.
    pub provenance: Provenance,
    /// The command line that computes it, without the program.
    pub arguments: Vec<String>,
}

/// Passes the lines of `whole`, the merged file, to `write` in their order, and returns the points that no part holds;
/// the file is complete if none is missing. There is at least one part.
///
/// With `recheck`, the first and the last row of each part are computed again within these limits and compared. Fails
/// if a part cannot be read, holds something other than its rows, or a row that another one holds too.
pub fn merge(
    parts: &[PartFile],
    whole: &ScanPart,
    recheck: Option<&Limits>,
    write: &mut dyn FnMut(&[u8]) -> Result<()>,
) -> Result<Vec<Range<usize>>> {
    let mut parts: Vec<&PartFile> = parts.iter().collect();
    parts.sort_by_key(|file| file.part.points.start);
    let mut waiting = parts.into_iter().peekable();
    // Open parts, each by the point of its next row that is not written yet.
    let mut reading: BTreeMap<usize, (RowReader, FileRow)> = BTreeMap::new();
    let check =
        |rows: &RowReader, row: &FileRow| recheck.map_or(Ok(()), |limits| rows.check(row, limits));
    let mut missing = Vec::new();
    let mut expected = 0;
    write(whole.heading().as_bytes())?;
    loop {
        let next = reading.keys().next().copied();
        let due = |file: &&PartFile| next.is_none_or(|index| file.part.points.start <= index);
        let (rows, row) = if let Some(file) = waiting.next_if(due) {
            let opened = File::open(&file.path);
            let opened = opened.map_err(|error| Failure::file(&file.path, &error))?;
            let mut rows =
                RowReader::new(&file.part, &file.path, opened, file.provenance.checksum)?;
            let Some(row) = rows.row()? else { continue };
            check(&rows, &row)?;
            (rows, row)
        } else {
            let Some((index, (mut rows, last))) = reading.pop_first() else { break };
            if expected < index {
                missing.push(expected..index);
            }
            expected = index + 1;
            write(&whole.line_of(index, &last.line))?;
            let Some(row) = rows.row()? else {
                check(&rows, &last)?;
                continue;
            };
            (rows, row)
        };
        let (index, path) = (row.index, rows.path);
        if let Some((other, _)) = reading.insert(index, (rows, row)) {
            let [one, other] = [other.path, path].map(Path::display);
            let row = index + 1;
            return Err(format!("{one} and {other} both hold row {row}").into());
        }
    }
    if expected < whole.scan.points() {
        missing.push(expected..whole.scan.points());
    }
    Ok(missing)
}
