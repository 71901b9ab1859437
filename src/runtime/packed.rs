//! Arrays in one file: an archive of numpy, or Parquet.

use std::io::{Cursor, Write};
use std::path::Path;

use csv::Reader;
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

use super::arrays::{Array, ArrayCells};

/// The columns of comma-separated values.
fn columns(csv: &str) -> Vec<Array> {
    let mut reader = Reader::from_reader(csv.as_bytes());
    let names = reader.headers().cloned().unwrap_or_default();
    let rows: Vec<_> = reader.records().flatten().collect();
    let column = |(at, name)| {
        let cells: Vec<&str> = rows.iter().map(|row| &row[at]).collect();
        Array::new(name, &[rows.len()], ArrayCells::read(&cells))
    };
    names.iter().enumerate().map(column).collect()
}

/// An archive of numpy, not compressed: the same bytes for the same arrays.
fn npz(arrays: &[Array]) -> ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for array in arrays {
        archive.start_file(format!("{}.npy", array.name), SimpleFileOptions::default())?;
        archive.write_all(&array.npy())?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The form of arrays that the ending of a file stands for.
pub fn form_of(path: &Path) -> Option<&str> {
    path.extension()?.to_str().filter(|ending| ["npz", "parquet"].contains(ending))
}

/// Arrays in the form that a file stands for.
///
/// # Errors
/// One line, if the build does not have that form, or they are too long for it.
pub fn packed(path: &Path, arrays: &[Array]) -> Result<Vec<u8>, String> {
    match form_of(path) {
        #[cfg(feature = "parquet")]
        Some("parquet") => super::parquet::file(arrays).map_err(|error| error.to_string()),
        #[cfg(not(feature = "parquet"))]
        Some("parquet") => {
            Err("this build has no Parquet: cargo build --features parquet".to_owned())
        }
        _ => npz(arrays).map_err(|error| error.to_string()),
    }
}

/// Comma-separated values in the form that a file stands for.
///
/// # Errors
/// As for [`packed`].
pub fn packed_rows(path: &Path, csv: &str) -> Result<Vec<u8>, String> {
    match form_of(path) {
        None => Ok(csv.as_bytes().to_vec()),
        Some(_) => packed(path, &columns(csv)),
    }
}
