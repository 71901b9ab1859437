//! Cells as arrays, in the forms of numpy and Parquet.
//!
//! Cells are told as text with every digit, as comma-separated values have them, and their array follows: integers if all
//! of them are, doubles with NaN for a missing one if all are numbers, else words; integers in rows and columns are bytes.

use std::io::{Cursor, Write};
use std::path::Path;

use csv::Reader;
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

/// An array with a name: its lengths, the last index varying fastest, and its cells.
pub struct Array {
    pub name: String,
    shape: Vec<usize>,
    pub cells: Vec<String>,
}

/// Cells as what all of them are.
pub enum Cells {
    Counts(Vec<i64>),
    Numbers(Vec<Option<f64>>),
    Words,
}

impl Array {
    /// An array of these cells.
    pub fn new(name: &str, shape: &[usize], cells: impl IntoIterator<Item: ToString>) -> Self {
        let cells = cells.into_iter().map(|cell| cell.to_string()).collect();
        Array { name: name.to_owned(), shape: shape.to_vec(), cells }
    }

    /// Its cells by their type.
    pub fn typed(&self) -> Cells {
        let number = |cell: &String| match cell.as_str() {
            "" => Some(None),
            cell => cell.parse().ok().map(Some),
        };
        let counts: Option<_> = self.cells.iter().map(|cell| cell.parse().ok()).collect();
        let numbers = || self.cells.iter().map(number).collect::<Option<_>>().map(Cells::Numbers);
        counts.map(Cells::Counts).or_else(numbers).unwrap_or(Cells::Words)
    }

    /// The array as a file of numpy.
    fn npy(&self) -> Vec<u8> {
        let (kind, bytes): (_, Vec<u8>) = match self.typed() {
            Cells::Counts(cells) if self.shape.len() > 1 => {
                ("|u1".to_owned(), cells.into_iter().filter_map(|it| it.try_into().ok()).collect())
            }
            Cells::Counts(cells) => {
                ("<i8".to_owned(), cells.into_iter().flat_map(i64::to_le_bytes).collect())
            }
            Cells::Numbers(cells) => {
                let cells = cells.into_iter().map(|cell| cell.unwrap_or(f64::NAN));
                ("<f8".to_owned(), cells.flat_map(f64::to_le_bytes).collect())
            }
            Cells::Words => {
                let longest = self.cells.iter().map(|it| it.chars().count()).max().unwrap_or(0);
                let filled = |cell: &String| {
                    let chars = cell.chars().map(u32::from).chain(std::iter::repeat(0));
                    chars.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<_>>()
                };
                (format!("<U{longest}"), self.cells.iter().flat_map(filled).collect())
            }
        };
        let shape: String = self.shape.iter().map(|length| format!("{length},")).collect();
        let named = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
        // With the ten bytes before it and its newline the header ends at a multiple of 64.
        let length = (named.len() + 11).next_multiple_of(64) - 10;
        let header = format!("{named:<width$}\n", width = length - 1);
        let size = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
        [b"\x93NUMPY\x01\x00".as_slice(), &size, header.as_bytes(), &bytes].concat()
    }
}

/// The columns of comma-separated values.
fn columns(csv: &str) -> Vec<Array> {
    let mut reader = Reader::from_reader(csv.as_bytes());
    let names = reader.headers().cloned().unwrap_or_default();
    let rows: Vec<_> = reader.records().flatten().collect();
    let column =
        |(at, name)| Array::new(name, &[rows.len()], rows.iter().map(|row| row[at].to_owned()));
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
