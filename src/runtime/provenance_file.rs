//! The file beside a file of rows that says where they come from: `rows.csv.provenance` beside `rows.csv`.
//!
//! The rows themselves stay as programs expect them, a line of names and nothing before it.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::words::provenance::Provenance;

/// What the name of a file of rows is followed by.
const ENDING: &str = ".provenance";

/// What this process was started as.
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

/// Writes it, unless the rows go to a device or a pipe. Fails if it cannot be written.
pub fn write(path: &Path, provenance: &Provenance) -> io::Result<()> {
    if !fs::metadata(path)?.is_file() {
        return Ok(());
    }
    fs::write(beside(path), serde_json::to_string_pretty(provenance)? + "\n")
}

/// Reads it. Fails if it is not there, cannot be read, or says something else.
pub fn read(path: &Path) -> io::Result<Provenance> {
    Ok(serde_json::from_slice(&fs::read(beside(path))?)?)
}

/// The files in a folder that have such a file beside them, in the order of their names. Fails if the folder cannot
/// be read.
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
