//! Every object as data: motions at times, orbits, basins and scans as arrays, against closed forms, against each other and
//! against single answers.

#![expect(clippy::cast_precision_loss, reason = "indices of samples are small")]
#![expect(clippy::disallowed_methods, reason = "the closed form is that of another library")]

mod archive;
mod orbits;
#[path = "../program/mod.rs"]
mod program;
mod scans;
mod times;

use std::path::{Path, PathBuf};

use tempfile::TempDir;

/// A folder for files, with the path of one in it.
fn file(name: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    (folder, path)
}

/// A path as a word of a command line.
fn word(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The numbers of a CSV text, row by row, without the names.
fn table(text: &str) -> Vec<Vec<f64>> {
    let rows = text.lines().skip(1);
    rows.map(|row| row.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect()
}
