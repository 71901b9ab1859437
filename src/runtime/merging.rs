//! Merges the parts of a scan, row by row.
//!
//! Parts are read side by side in the order of their points, so that only one row per open part is held.

use std::fs::File;
use std::ops::Range;
use std::path::PathBuf;

use super::failure::Failure;
use super::scan_part::{FileRow, RowReader, ScanPart};
use crate::flow::Limits;
use crate::words::provenance::Checksum;

/// A file with some of the rows of a scan.
#[derive(Clone, Debug)]
pub struct PartFile {
    pub path: PathBuf,
    pub part: ScanPart,
    /// The checksum of its rows, if it is known.
    pub checksum: Option<Checksum>,
}

/// Passes the lines of the merged file to `write` in their order, and returns the points that no part holds;
/// the file is complete if none is missing. There is at least one part.
///
/// With `recheck`, the first and the last row of each part are computed again within these limits and compared. Fails
/// if a part cannot be read, holds something other than its rows, or a row that another one holds too.
pub fn merge(
    parts: &[&PartFile],
    recheck: Option<&Limits>,
    write: &mut dyn FnMut(&[u8]) -> Result<(), Failure>,
) -> Result<Vec<Range<usize>>, Failure> {
    let whole = ScanPart { headed: true, ..parts[0].part.clone() };
    let mut parts = parts.to_vec();
    parts.sort_by_key(|file| file.part.points.start);
    let mut waiting = parts.into_iter().peekable();
    let mut reading: Vec<OpenPart> = Vec::new();
    let mut missing = Vec::new();
    let mut expected = 0;
    write(whole.heading().as_bytes())?;
    loop {
        let first = reading.iter().enumerate().min_by_key(|(_, open)| open.row.index);
        let next = first.map(|(place, open)| (place, open.row.index));
        let due = |file: &&PartFile| next.is_none_or(|(_, index)| file.part.points.start <= index);
        if let Some(file) = waiting.next_if(due) {
            reading.extend(OpenPart::new(file, recheck)?);
            continue;
        }
        let Some((place, index)) = next else { break };
        if let Some(other) = reading[place + 1..].iter().find(|open| open.row.index == index) {
            let [one, other] = [&reading[place], other].map(|open| open.file.path.display());
            let row = index + 1;
            return Err(Failure::Usage(format!("{one} and {other} both hold row {row}")));
        }
        if expected < index {
            missing.push(expected..index);
        }
        expected = index + 1;
        write(&reading[place].row.line)?;
        if !reading[place].advance(recheck)? {
            reading.remove(place);
        }
    }
    if expected < whole.scan.points() {
        missing.push(expected..whole.scan.points());
    }
    Ok(missing)
}

/// An open part, with its next row that is not written yet.
struct OpenPart<'a> {
    file: &'a PartFile,
    rows: RowReader<'a>,
    row: FileRow,
}

impl<'a> OpenPart<'a> {
    /// Opens a part at its first row; `None` if it has none.
    fn new(file: &'a PartFile, recheck: Option<&Limits>) -> Result<Option<Self>, Failure> {
        let opened = File::open(&file.path).map_err(|error| Failure::file(&file.path, &error))?;
        let mut rows = RowReader::new(&file.part, &file.path, opened, file.checksum)?;
        let Some(row) = rows.row()? else { return Ok(None) };
        recheck.map_or(Ok(()), |limits| rows.check(&row, limits))?;
        Ok(Some(OpenPart { file, rows, row }))
    }

    /// Reads the next row; `false` if there is none.
    fn advance(&mut self, recheck: Option<&Limits>) -> Result<bool, Failure> {
        let Some(row) = self.rows.row()? else {
            return recheck
                .map_or(Ok(false), |limits| self.rows.check(&self.row, limits).map(|()| false));
        };
        self.row = row;
        Ok(true)
    }
}
