//! The file that tells where rows come from: `rows.csv.provenance` beside `rows.csv`.
//!
//! The file of rows itself stays as other programs expect it, with nothing before the line of column names.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::words::provenance::Provenance;

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
    let mut name = OsString::from(path);
    name.push(ENDING);
    name.into()
}

/// Writes the provenance of a file, unless it is a device or a pipe. Fails if it cannot be written.
pub fn write(path: &Path, provenance: &Provenance) -> io::Result<()> {
    if !fs::metadata(path)?.is_file() {
        return Ok(());
    }
    fs::write(beside(path), serde_json::to_string_pretty(provenance)? + "\n")
}

/// Reads the provenance of a file. Fails if there is none, or it cannot be read or understood.
pub fn read(path: &Path) -> io::Result<Provenance> {
    Ok(serde_json::from_slice(&fs::read(beside(path))?)?)
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
