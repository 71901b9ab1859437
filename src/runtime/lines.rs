//! The lines of a file of rows, read one at a time, and why such a file is refused.

use std::fmt;
use std::io::{self, BufRead, BufReader, Read};

/// Why a file cannot take the rows of a scan.
#[derive(Debug)]
pub enum LineRefusal {
    /// It cannot be opened, read or written.
    Io(io::Error),
    /// Another process writes to it.
    Busy,
    /// It holds something other than rows of this scan.
    Foreign {
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        why: &'static str,
    },
    /// Its rows have another checksum than those that were written.
    Altered {
        /// Number of the rows with a checksum.
        rows: usize,
    },
    /// The check was interrupted.
    Interrupted,
}

impl From<io::Error> for LineRefusal {
    fn from(error: io::Error) -> Self {
        LineRefusal::Io(error)
    }
}

impl fmt::Display for LineRefusal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LineRefusal::Io(error) => write!(out, "{error}"),
            LineRefusal::Busy => write!(out, "another scan is writing to it"),
            LineRefusal::Foreign { line, why } => {
                write!(out, "not a part of this scan: line {line} {why}")
            }
            LineRefusal::Altered { rows } => {
                write!(
                    out,
                    "altered: the checksum of its first {rows} rows is another in .provenance"
                )
            }
            LineRefusal::Interrupted => write!(out, "interrupted"),
        }
    }
}

/// Longest line that is read, in bytes: a row has no more than some thousand.
const LONGEST: u64 = 1 << 20;

/// The lines of a file, with their numbers.
pub(super) struct FileLines<R> {
    reader: BufReader<R>,
    /// Number of the line read last, from 1.
    number: usize,
    /// Length in bytes up to the end of the last whole line.
    bytes: u64,
}

pub(super) enum FileLine {
    Whole(Vec<u8>),
    /// A line without its end: the last one, perhaps empty, or one that was cut.
    Cut(Vec<u8>),
}

impl<R: Read> FileLines<R> {
    pub(super) fn new(file: R) -> Self {
        FileLines { reader: BufReader::new(file), number: 0, bytes: 0 }
    }

    /// Number of the line read last, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// Reads this heading, unless it is empty; `false` if the file ends within it.
    pub(super) fn heading(&mut self, heading: &str) -> Result<bool, LineRefusal> {
        if heading.is_empty() {
            return Ok(true);
        }
        match self.next(heading.len())? {
            FileLine::Whole(line) if line == heading.as_bytes() => Ok(true),
            FileLine::Cut(begun) if heading.as_bytes().starts_with(&begun) => Ok(false),
            _ => Err(self.foreign("names other columns")),
        }
    }

    /// The next line; a line longer than `most` bytes is cut there. Fails if it is longer than any row.
    pub(super) fn next(&mut self, most: usize) -> io::Result<FileLine> {
        let mut line = Vec::new();
        let most = u64::try_from(most).unwrap_or(u64::MAX).min(LONGEST);
        (&mut self.reader).take(most).read_until(b'\n', &mut line)?;
        self.number += 1;
        if line.len() as u64 == LONGEST {
            let told = format!("line {} is longer than {} MB", self.number, LONGEST >> 20);
            return Err(io::Error::new(io::ErrorKind::InvalidData, told));
        }
        if line.last() == Some(&b'\n') {
            self.bytes += line.len() as u64;
            Ok(FileLine::Whole(line))
        } else {
            Ok(FileLine::Cut(line))
        }
    }

    /// Length in bytes up to the end of the last whole line.
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }

    pub(super) fn foreign(&self, why: &'static str) -> LineRefusal {
        LineRefusal::Foreign { line: self.number, why }
    }
}
