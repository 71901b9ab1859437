//! Arrays in one file: an archive of numpy, or Parquet.

use std::io::{Cursor, Write};
use std::path::Path;

use csv::Reader;
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

use super::arrays::{Array, ArrayCells};
use crate::words::ends_in;

/// The columns of comma-separated values. Fails where a row cannot be read.
fn columns(csv: &str) -> csv::Result<Vec<Array>> {
    let mut reader = Reader::from_reader(csv.as_bytes());
    let names = reader.headers()?.clone();
    let rows = reader.records().collect::<csv::Result<Vec<_>>>()?;
    let column = |(at, name)| {
        let cells: Vec<&str> = rows.iter().map(|row| &row[at]).collect();
        Array::new(name, &[rows.len()], ArrayCells::read(name, &cells))
    };
    Ok(names.iter().enumerate().map(column).collect())
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

/// Whether a file holds arrays, by its ending.
pub fn is_of_arrays(path: &Path) -> bool {
    ["npz", "parquet"].into_iter().any(|ending| ends_in(path, ending))
}

/// Arrays in the form that a file stands for.
///
/// # Errors
/// One line, if the build does not have that form, or they are too long for it.
pub fn packed(path: &Path, arrays: &[Array]) -> Result<Vec<u8>, String> {
    if !ends_in(path, "parquet") {
        return npz(arrays).map_err(|error| error.to_string());
    }
    #[cfg(feature = "parquet")]
    return super::parquet::file(arrays).map_err(|error| error.to_string());
    #[cfg(not(feature = "parquet"))]
    Err("this build has no Parquet: cargo build --features parquet".to_owned())
}

/// Comma-separated values in the form that a file stands for.
///
/// # Errors
/// One line, as for [`packed`], or if a row cannot be read.
pub fn packed_rows(path: &Path, csv: &str) -> Result<Vec<u8>, String> {
    if is_of_arrays(path) {
        packed(path, &columns(csv).map_err(|error| error.to_string())?)
    } else {
        Ok(csv.as_bytes().to_vec())
    }
}
