//! Rows that are computed before their turn: a file beside that of a scan, `rows.csv.ahead` beside `rows.csv`.
//!
//! The file of a scan holds its rows in their order, so a slow row holds up those behind it. Rows that are
//! ready early are noted here at once, so that a killed process loses only the rows that it was computing. The
//! first line names the columns; each further line has the number of a point, a tab, the checksum of its row, a
//! tab, and the row. A line that holds anything else is ignored. Nothing is lost by that, because all rows can be
//! computed again.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::lines::{FileLine, FileLines};
use super::new_file::beside;
use crate::report::Format;
use crate::scan::grid::Scan;
use crate::words::provenance::Checksum;

/// Appended to the name of the file of rows.
const ENDING: &str = ".ahead";

/// Size in bytes above which a journal is removed once all of its rows have had their turn.
const MOST: u64 = 1 << 20;

/// The journal of a scan.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    /// `None` until there is a row to note.
    file: Option<File>,
    bytes: u64,
}

impl Journal {
    /// The empty journal beside this file; one that an earlier scan left is removed.
    pub fn new(path: &Path) -> Self {
        let journal = Journal { path: beside(path, ENDING), file: None, bytes: 0 };
        journal.remove();
        journal
    }

    /// The journal beside this file, and those of its rows that belong to these points.
    pub fn resume(
        path: &Path,
        scan: &Scan,
        form: Format,
        points: &Range<usize>,
    ) -> (Self, BTreeMap<usize, String>) {
        let open = OpenOptions::new().read(true).append(true).open(beside(path, ENDING));
        let Ok(file) = open else { return (Self::new(path), BTreeMap::new()) };
        let (found, bytes) = rows(&file, scan, form, points);
        if found.is_empty() || file.set_len(bytes).is_err() {
            return (Self::new(path), BTreeMap::new());
        }
        (Journal { path: beside(path, ENDING), file: Some(file), bytes }, found)
    }

    /// Adds a row. Fails if it cannot be written.
    pub fn note(
        &mut self,
        scan: &Scan,
        form: Format,
        (index, row): (usize, &str),
    ) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            none => {
                let file = OpenOptions::new().append(true).create(true).open(&self.path)?;
                file.set_len(0)?;
                let file = none.insert(file);
                file.write_all(heading(scan, form).as_bytes())?;
                file
            }
        };
        let checksum = Checksum::NONE.and(row.as_bytes());
        let line = format!("{index}\t{checksum}\t{row}");
        self.bytes += line.len() as u64;
        file.write_all(line.as_bytes())
    }

    /// Notes that all rows of the journal have had their turn.
    pub fn is_served(&mut self) {
        if self.bytes > MOST {
            self.end();
        }
    }

    pub fn end(&mut self) {
        if self.file.take().is_some() {
            self.remove();
        }
        self.bytes = 0;
    }

    fn remove(&self) {
        // A journal that cannot be removed is a nuisance but no error: its rows are known to be unnecessary.
        drop(fs::remove_file(&self.path));
    }
}

/// The rows of these points in a journal, and its length in bytes without an incomplete last line.
fn rows(
    file: &File,
    scan: &Scan,
    form: Format,
    points: &Range<usize>,
) -> (BTreeMap<usize, String>, u64) {
    let mut found = BTreeMap::new();
    let mut lines = FileLines::new(file);
    let Ok(true) = lines.heading(&heading(scan, form)) else { return (found, 0) };
    while let Ok(FileLine::Whole(line)) = lines.next(usize::MAX) {
        found.extend(String::from_utf8(line).ok().and_then(|line| {
            let (index, line) = line.split_once('\t')?;
            let (checksum, row) = line.split_once('\t')?;
            let index = index.parse().ok().filter(|index| points.contains(index))?;
            let is_own = row.starts_with(&form.beginning(scan, index))
                && Checksum::NONE.and(row.as_bytes()).to_string() == checksum;
            is_own.then(|| (index, row.to_owned()))
        }));
    }
    (found, lines.bytes())
}

/// The first line: the form, and the columns as comma-separated values.
fn heading(scan: &Scan, form: Format) -> String {
    format!("{form:?},{}", Format::Csv.heading(scan))
}
