//! The file that tells where rows come from: `rows.csv.provenance` beside `rows.csv`.
//!
//! The file of rows itself stays as other programs expect it, with nothing before the line of column names. And what
//! identifies a file that an answer was computed from: its name, its date and its SHA-256.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::UNIX_EPOCH;

use sha2::{Digest, Sha256};
use time::OffsetDateTime;

use super::failure::{Failure, Result};
use super::{Readers, bounded, new_file};
use crate::report::page::SourceFile;
use crate::words::provenance::{Checksum, Provenance};

/// Appended to the name of the file of rows.
const ENDING: &str = ".provenance";

/// The provenance of rows that this process writes.
pub fn of_process() -> Provenance {
    Provenance::of(&arguments())
}

/// The words of the command line where they are not those of the process, as in an interpreter that runs the program.
pub static WORDS: OnceLock<Vec<OsString>> = OnceLock::new();

/// The words of the command line, the name of the program first.
pub fn words() -> Vec<OsString> {
    WORDS.get().cloned().unwrap_or_else(|| std::env::args_os().collect())
}

/// The arguments of this process.
pub fn arguments() -> Vec<String> {
    words().iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect()
}

pub fn beside(path: &Path) -> PathBuf {
    new_file::beside(path, ENDING)
}

/// Writes the provenance of a file, unless it is a device or a pipe. Fails if it cannot be written.
pub fn write(path: &Path, provenance: &Provenance) -> Result<()> {
    if !new_file::is_regular(path) {
        return Ok(());
    }
    let path = beside(path);
    let text = serde_json::to_string_pretty(provenance);
    let text = text.map_err(io::Error::from).map_err(Failure::unwritten(&path))? + "\n";
    new_file::write(&path, text.as_bytes(), Readers::Usual, None)
}

/// The checksum in the provenance of a file that grows, renewed with each row: whenever the process is killed, it
/// is that of all rows but perhaps the last.
pub struct RunningChecksum {
    file: File,
    /// Offset of the checksum in bytes.
    at: u64,
    pub checksum: Checksum,
}

impl RunningChecksum {
    /// Writes the provenance of a file whose rows have this checksum. Fails if it cannot be written.
    pub fn begin(path: &Path, provenance: Provenance, checksum: Checksum) -> Result<Self> {
        let provenance = Provenance { checksum: Some(checksum), ..provenance };
        write(path, &provenance)?;
        let path = beside(path);
        let unwritten = Failure::unwritten(&path);
        let at = bounded::text(&path)?.rfind(&String::from(checksum));
        let at = at.ok_or_else(|| unwritten(io::ErrorKind::InvalidData.into()))? as u64;
        let file = OpenOptions::new().write(true).open(&path).map_err(unwritten)?;
        Ok(RunningChecksum { file, at, checksum })
    }

    /// Counts a row that has been written. Fails if its checksum cannot be.
    pub fn count(&mut self, row: &[u8]) -> io::Result<()> {
        self.checksum = self.checksum.and(row);
        new_file::write_at(&self.file, String::from(self.checksum).as_bytes(), self.at)
    }
}

/// Reads the provenance of a file. Fails if there is none, or it cannot be read or understood.
pub fn read(path: &Path) -> Result<Provenance> {
    let path = beside(path);
    serde_json::from_slice(&bounded::bytes(&path)?).map_err(|error| Failure::file(&path, error))
}

/// The files in a folder that have a file of provenance, sorted by name. Fails if the folder cannot be read.
pub fn files_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(|error| Failure::file(folder, &error))?;
    let paths = entries.flatten().map(|entry| entry.path());
    let mut found: Vec<_> = paths.filter(|path| path.is_file() && beside(path).is_file()).collect();
    found.sort();
    Ok(found)
}

/// The file that held these bytes when it was read.
pub fn source(path: &Path, bytes: &[u8]) -> SourceFile {
    let regular = fs::metadata(path).ok().filter(fs::Metadata::is_file);
    let changed = regular.and_then(|file| file.modified().ok()?.duration_since(UNIX_EPOCH).ok());
    SourceFile {
        name: path.display().to_string(),
        changed: changed.map(|since| date(since.as_secs().cast_signed())),
        sha256: sha256(bytes),
    }
}

/// The SHA-256 in hexadecimal digits.
fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |hex, byte| format!("{hex}{byte:02x}"))
}

/// Seconds since 1970 as `2026-03-02 10:11:12 UTC`.
fn date(seconds: i64) -> String {
    let Ok(at) = OffsetDateTime::from_unix_timestamp(seconds) else { return String::new() };
    let ((hours, minutes, seconds), month) = (at.to_hms(), u8::from(at.month()));
    format!("{}-{month:02}-{:02} {hours:02}:{minutes:02}:{seconds:02} UTC", at.year(), at.day())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // By `date -u -d @..`.
        for (seconds, shown) in [
            (0, "1970-01-01 00:00:00 UTC"),
            (-1, "1969-12-31 23:59:59 UTC"),
            (951_782_399, "2000-02-28 23:59:59 UTC"),
            (951_782_400, "2000-02-29 00:00:00 UTC"),
            (1_709_251_199, "2024-02-29 23:59:59 UTC"),
            (1_772_446_272, "2026-03-02 10:11:12 UTC"),
            (4_107_542_400, "2100-03-01 00:00:00 UTC"),
        ] {
            assert_eq!(date(seconds), shown);
        }
    }
}
