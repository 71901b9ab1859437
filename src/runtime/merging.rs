//! Merges the parts of a scan, row by row.
//!
//! Parts are read side by side in the order of their points, so that only one row per open part is held. Every
//! row is recognized by its beginning, which names everything that it depends on: the position of a row proves
//! nothing.

use std::fmt;
use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::PathBuf;

use super::lines::{FileLine, FileLines, LineRefusal};
use super::scan_file::compare;
use crate::flow::Limits;
use crate::report::Format;
use crate::scan::grid::Scan;
use crate::words::provenance::Checksum;

/// A file with some of the rows of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScanPart {
    pub path: PathBuf,
    pub points: Range<usize>,
    /// Whether its rows are preceded by a line of column names.
    pub headed: bool,
    /// The checksum of its rows, if it is known.
    pub checksum: Option<Checksum>,
}

/// Why parts cannot be merged.
#[derive(Debug)]
pub enum Conflict {
    /// A part cannot be read, or holds something other than rows of this scan.
    Part(PathBuf, LineRefusal),
    /// Two parts hold the same row.
    Twice {
        /// The row, from 1.
        row: usize,
        paths: [PathBuf; 2],
    },
    /// The merged file cannot be written.
    Output(io::Error),
}

impl fmt::Display for Conflict {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Conflict::Part(path, refusal) => write!(out, "{}: {refusal}", path.display()),
            Conflict::Twice { row, paths: [one, other] } => {
                write!(out, "{} and {} both hold row {row}", one.display(), other.display())
            }
            Conflict::Output(error) => write!(out, "{error}"),
        }
    }
}

/// Passes the lines of the merged file to `write` in their order, and returns the points that no part holds;
/// the file is complete if none is missing.
///
/// With `recheck`, the first and the last row of each part are computed again within these limits and compared.
pub fn merge(
    scan: &Scan,
    form: Format,
    parts: &[ScanPart],
    recheck: Option<&Limits>,
    write: &mut dyn FnMut(&[u8]) -> io::Result<()>,
) -> Result<Vec<Range<usize>>, Conflict> {
    let mut parts: Vec<&ScanPart> = parts.iter().collect();
    parts.sort_by_key(|part| part.points.start);
    let mut waiting = parts.into_iter().peekable();
    let mut reading: Vec<Reader> = Vec::new();
    let mut missing = Vec::new();
    let mut expected = 0;
    write(form.heading(scan).as_bytes()).map_err(Conflict::Output)?;
    let task = MergeTask { scan, form, recheck };
    loop {
        let first = reading.iter().enumerate().min_by_key(|(_, reader)| reader.index);
        let next = first.map(|(place, reader)| (place, reader.index));
        let due = |part: &&ScanPart| next.is_none_or(|(_, index)| part.points.start <= index);
        if let Some(part) = waiting.next_if(due) {
            let refused = |refusal| Conflict::Part(part.path.clone(), refusal);
            reading.extend(Reader::open(&task, part).map_err(refused)?);
            continue;
        }
        let Some((place, index)) = next else { break };
        if let Some(other) = reading[place + 1..].iter().find(|reader| reader.index == index) {
            let paths = [reading[place].part.path.clone(), other.part.path.clone()];
            return Err(Conflict::Twice { row: index + 1, paths });
        }
        if expected < index {
            missing.push(expected..index);
        }
        expected = index + 1;
        let reader = &mut reading[place];
        write(&reader.line).map_err(Conflict::Output)?;
        let more = reader.advance(&task);
        if !more.map_err(|refusal| Conflict::Part(reader.part.path.clone(), refusal))? {
            reading.remove(place);
        }
    }
    if expected < scan.points() {
        missing.push(expected..scan.points());
    }
    Ok(missing)
}

/// The scan that is merged, and whether rows are computed again.
struct MergeTask<'a> {
    scan: &'a Scan,
    form: Format,
    recheck: Option<&'a Limits<'a>>,
}

/// An open part, with its next row that is not written yet.
struct Reader<'a> {
    part: &'a ScanPart,
    lines: FileLines<File>,
    /// The checksum of the rows read so far.
    checksum: Checksum,
    /// The point of this row.
    index: usize,
    line: Vec<u8>,
}

impl<'a> Reader<'a> {
    /// Opens a part at its first row; `None` if it has none.
    fn open(task: &MergeTask, part: &'a ScanPart) -> Result<Option<Self>, LineRefusal> {
        let mut lines = FileLines::new(File::open(&part.path)?);
        if part.headed && !lines.heading(&task.form.heading(task.scan))? {
            return Ok(None);
        }
        let (index, checksum) = (part.points.start, Checksum::NONE);
        let mut reader = Reader { part, lines, checksum, index, line: Vec::new() };
        let any = reader.read(task, part.points.start)?;
        if any {
            reader.compare(task, reader.lines.number())?;
        }
        Ok(any.then_some(reader))
    }

    /// Reads the next row; `false` if there is none.
    fn advance(&mut self, task: &MergeTask) -> Result<bool, LineRefusal> {
        let number = self.lines.number();
        let more = self.read(task, self.index + 1)?;
        if !more {
            self.compare(task, number)?;
        }
        Ok(more)
    }

    /// Reads a row of the point `from` or a later one of this part; an incomplete line does not count.
    fn read(&mut self, task: &MergeTask, from: usize) -> Result<bool, LineRefusal> {
        let FileLine::Whole(line) = self.lines.next(usize::MAX)? else { return Ok(false) };
        let is_of =
            |index: &usize| line.starts_with(task.form.beginning(task.scan, *index).as_bytes());
        let Some(index) = (from..self.part.points.end).find(is_of) else {
            return Err(self.lines.foreign("is of no point that is left"));
        };
        self.checksum = self.checksum.and(&line);
        let known = self.part.checksum.filter(|known| known.rows == self.checksum.rows);
        if known.is_some_and(|known| known != self.checksum) {
            return Err(LineRefusal::Altered { rows: self.checksum.rows });
        }
        (self.index, self.line) = (index, line);
        Ok(true)
    }

    fn compare(&self, task: &MergeTask, number: usize) -> Result<(), LineRefusal> {
        let Some(limits) = task.recheck else { return Ok(()) };
        compare(task.scan, task.form, (self.index, &self.line), number, limits)
    }
}
