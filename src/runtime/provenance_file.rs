//! The file that tells where rows come from: `rows.csv.provenance` beside `rows.csv`.
//!
//! The file of rows itself stays as other programs expect it, with nothing before the line of column names.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};

use super::bounded;
use super::new_file::{self, Readers};
use crate::words::provenance::{Checksum, Provenance};

/// Appended to the name of the file of rows.
const ENDING: &str = ".provenance";

/// The provenance of rows that this process writes.
pub fn of_process() -> Provenance {
    Provenance::of(&arguments())
}

/// The arguments of this process.
pub fn arguments() -> Vec<String> {
    std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect()
}

pub fn beside(path: &Path) -> PathBuf {
    new_file::beside(path, ENDING)
}

/// Writes the provenance of a file, unless it is a device or a pipe. Fails if it cannot be written.
pub fn write(path: &Path, provenance: &Provenance) -> io::Result<()> {
    if !new_file::is_regular(path) {
        return Ok(());
    }
    let text = serde_json::to_string_pretty(provenance)? + "\n";
    new_file::write(&beside(path), text.as_bytes(), Readers::Usual, true)
}

/// The checksum in the provenance of a file that grows, renewed with each row: whenever the process is killed, it
/// is that of all rows but perhaps the last.
#[derive(Debug)]
pub struct RunningChecksum {
    file: File,
    /// Offset of the checksum in bytes.
    at: u64,
    pub checksum: Checksum,
}

impl RunningChecksum {
    /// Writes the provenance of a file whose rows have this checksum. Fails if it cannot be written.
    pub fn begin(path: &Path, provenance: Provenance, checksum: Checksum) -> io::Result<Self> {
        let provenance = Provenance { checksum: Some(checksum), ..provenance };
        write(path, &provenance)?;
        let path = beside(path);
        let at = fs::read_to_string(&path)?.rfind(&checksum.to_string());
        let at = at.ok_or(io::ErrorKind::InvalidData)? as u64;
        Ok(RunningChecksum { file: OpenOptions::new().write(true).open(path)?, at, checksum })
    }

    /// Counts a row that has been written. Fails if its checksum cannot be.
    pub fn count(&mut self, row: &[u8]) -> io::Result<()> {
        self.checksum = self.checksum.and(row);
        self.file.write_all_at(self.checksum.to_string().as_bytes(), self.at)
    }
}

/// Reads the provenance of a file. Fails if there is none, or it cannot be read or understood.
pub fn read(path: &Path) -> io::Result<Provenance> {
    Ok(serde_json::from_slice(&bounded::bytes(&beside(path))?)?)
}

/// The files in a folder that have a file of provenance, sorted by name. Fails if the folder cannot be read.
pub fn files_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_file() && beside(&path).is_file() {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
