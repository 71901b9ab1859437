//! Rows that are computed before their turn: also in a file beside that of a scan, `rows.csv.ahead` beside `rows.csv`.
//!
//! The file of a scan holds its rows in their order, so a slow row holds up those behind it. Rows that are
//! ready early are noted here at once, so that a killed process loses only the rows that it was computing. The
//! first line names the columns; each further line has the number of a point, a tab, the checksum of its row, a
//! tab, and the row. A line that holds anything else is ignored. Nothing is lost by that, because all rows can be
//! computed again.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::bounded;
use super::new_file::beside;
use crate::report::Format;
use crate::report::scan::ScanPart;
use crate::words::provenance::Checksum;

/// Appended to the name of the file of rows.
const ENDING: &str = ".ahead";

/// Size in bytes above which a journal is removed once all of its rows have had their turn.
const MOST: u64 = 1 << 20;

/// The rows of a scan whose turn has not come.
pub struct Journal {
    pub rows: BTreeMap<usize, String>,
    /// `None` beside a device or a pipe, where the rows are in memory only.
    path: Option<PathBuf>,
    /// `None` until there is a row to note.
    file: Option<File>,
    heading: String,
    bytes: u64,
}

impl Journal {
    /// The empty journal of a part; one that an earlier scan left beside this file is removed.
    pub fn new(path: Option<&Path>, part: &ScanPart) -> Self {
        let path = path.map(|path| beside(path, ENDING));
        // The form, and the columns as comma-separated values.
        let columns = ScanPart { form: Format::Csv, headed: true, ..part.clone() };
        let heading = format!("{:?},{}", part.form, columns.heading());
        let journal = Journal { rows: BTreeMap::new(), path, file: None, heading, bytes: 0 };
        journal.remove();
        journal
    }

    /// The journal beside this file, with those of its rows that belong to the part.
    pub fn resume(path: &Path, part: &ScanPart) -> Self {
        let found = bounded::bytes(&beside(path, ENDING)).unwrap_or_default();
        let mut journal = Self::new(Some(path), part);
        let Some(lines) = found.strip_prefix(journal.heading.as_bytes()) else { return journal };
        let lines = lines.split_inclusive(|byte| *byte == b'\n');
        for (index, row) in lines.filter_map(|line| row(part, line)) {
            // What cannot be noted again is still known to this process.
            drop(journal.note(index, row));
        }
        journal
    }

    /// Adds a row. Fails if it cannot be written.
    pub fn note(&mut self, index: usize, row: String) -> io::Result<()> {
        let checksum = String::from(Checksum::NONE.and(row.as_bytes()));
        let line = format!("{index}\t{checksum}\t{row}");
        self.rows.insert(index, row);
        let Some(path) = &self.path else { return Ok(()) };
        let file = match &mut self.file {
            Some(file) => file,
            none => {
                let file = none.insert(File::create(path)?);
                file.write_all(self.heading.as_bytes())?;
                file
            }
        };
        self.bytes += line.len() as u64;
        file.write_all(line.as_bytes())
    }

    /// Takes out the row of a point whose turn has come.
    pub fn take(&mut self, index: usize) -> Option<String> {
        let row = self.rows.remove(&index)?;
        if self.rows.is_empty() && self.bytes > MOST {
            self.end();
        }
        Some(row)
    }

    /// Removes the file.
    pub fn end(&mut self) {
        if self.file.take().is_some() {
            self.remove();
        }
        self.bytes = 0;
    }

    fn remove(&self) {
        if let Some(path) = &self.path {
            // A journal that cannot be removed is a nuisance but no error: its rows are known to be unnecessary.
            drop(fs::remove_file(path));
        }
    }
}

/// The point and the row in a line of the journal, if that is a row of the part as it was noted.
fn row(part: &ScanPart, line: &[u8]) -> Option<(usize, String)> {
    let (index, line) = str::from_utf8(line).ok()?.split_once('\t')?;
    let (checksum, row) = line.split_once('\t')?;
    let index = index.parse().ok().filter(|index| part.points.contains(index))?;
    let is_own = row.ends_with('\n')
        && row.starts_with(&part.beginning(index))
        && String::from(Checksum::NONE.and(row.as_bytes())) == checksum;
    is_own.then(|| (index, row.to_owned()))
}
