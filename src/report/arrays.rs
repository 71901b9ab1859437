//! Columns as arrays, in the forms of numpy and Parquet.
//!
//! Comma-separated values have every digit, so that arrays follow from them: numbers without a fraction are 64-bit integers
//! if none is missing, all others doubles, with NaN where there is none.

use std::path::Path;

use csv::Reader;

/// An array with a name.
pub struct Array {
    pub(super) name: String,
    /// Its lengths, the last index varying fastest; none of a single value.
    shape: Vec<usize>,
    pub(super) data: Data,
}

/// What stands in an array.
pub(super) enum Data {
    Bytes(Vec<u8>),
    Flags(Vec<bool>),
    Counts(Vec<i64>),
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

impl Array {
    /// Small numbers, such as labels.
    pub fn bytes(name: &str, shape: &[usize], data: Vec<u8>) -> Self {
        Array { name: name.to_owned(), shape: shape.to_vec(), data: Data::Bytes(data) }
    }

    /// Numbers; NaN where there is none.
    pub fn numbers(name: &str, shape: &[usize], data: Vec<f64>) -> Self {
        Array { name: name.to_owned(), shape: shape.to_vec(), data: Data::Numbers(data) }
    }

    /// A list of words.
    pub fn words<S: Into<String>>(name: &str, words: impl IntoIterator<Item = S>) -> Self {
        let words: Vec<String> = words.into_iter().map(Into::into).collect();
        Array { name: name.to_owned(), shape: vec![words.len()], data: Data::Words(words) }
    }

    /// A column of cells as comma-separated values have them.
    fn column(name: &str, cells: Vec<String>) -> Self {
        let shape = [cells.len()];
        let flags = cells.iter().map(|cell| cell.parse()).collect();
        if let Ok(flags) = flags
            && shape != [0]
        {
            return Array {
                name: name.to_owned(),
                shape: shape.to_vec(),
                data: Data::Flags(flags),
            };
        }
        let number = |cell: &String| if cell.is_empty() { Ok(f64::NAN) } else { cell.parse() };
        if let Ok(counts) = cells.iter().map(|cell| cell.parse()).collect() {
            return Array {
                name: name.to_owned(),
                shape: shape.to_vec(),
                data: Data::Counts(counts),
            };
        }
        match cells.iter().map(number).collect() {
            Ok(numbers) => Array::numbers(name, &shape, numbers),
            Err(_) => Array::words(name, cells),
        }
    }

    /// The array as a file of numpy.
    fn npy(&self) -> Vec<u8> {
        let (kind, bytes) = match &self.data {
            Data::Bytes(data) => ("|u1".to_owned(), data.clone()),
            Data::Flags(data) => ("|b1".to_owned(), data.iter().map(|it| u8::from(*it)).collect()),
            Data::Counts(data) => {
                ("<i8".to_owned(), data.iter().flat_map(|it| it.to_le_bytes()).collect())
            }
            Data::Numbers(data) => {
                ("<f8".to_owned(), data.iter().flat_map(|it| it.to_le_bytes()).collect())
            }
            Data::Words(data) => {
                let longest = data.iter().map(|it| it.chars().count()).max().unwrap_or(0).max(1);
                let code = |word: &String| {
                    let chars = word.chars().map(u32::from).chain(std::iter::repeat(0));
                    chars.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<_>>()
                };
                (format!("<U{longest}"), data.iter().flat_map(code).collect())
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
pub fn columns(csv: &str) -> Vec<Array> {
    let mut reader = Reader::from_reader(csv.as_bytes());
    let names = reader.headers().cloned().unwrap_or_default();
    let rows: Vec<_> = reader.records().flatten().collect();
    let cells = |at: usize| rows.iter().map(|row| row[at].to_owned()).collect();
    names.iter().enumerate().map(|(at, name)| Array::column(name, cells(at))).collect()
}

/// An archive of numpy: a zip file of arrays, not compressed, the same bytes for the same arrays.
pub fn npz(arrays: &[Array]) -> Vec<u8> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for array in arrays {
        let (name, data) = (format!("{}.npy", array.name), array.npy());
        let at = size(archive.len());
        // Version 2.0, no flags, no compression, midnight of 1 January 1980.
        let mut entry = [20_u16, 0, 0, 0, 0x21].map(u16::to_le_bytes).concat();
        for number in [crc32fast::hash(&data), size(data.len()), size(data.len())] {
            entry.extend(number.to_le_bytes());
        }
        entry.extend(size(name.len()).to_le_bytes());
        archive.extend([b"PK\x03\x04", entry.as_slice(), name.as_bytes(), &data].concat());
        directory.extend([b"PK\x01\x02\x14\x00", entry.as_slice(), &[0; 10]].concat());
        directory.extend([&at.to_le_bytes(), name.as_bytes()].concat());
    }
    let count = u16::try_from(arrays.len()).unwrap_or(u16::MAX).to_le_bytes();
    let [length, start] = [&directory, &archive].map(|part| size(part.len()).to_le_bytes());
    let end = [b"PK\x05\x06".as_slice(), &[0; 4], &count, &count, &length, &start, &[0; 2]];
    [archive, directory, end.concat()].concat()
}

/// A length as a zip file has it. A larger one makes an archive that no reader takes.
fn size(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

/// Columns as a Parquet file of one row group, not compressed; NaN and empty words are null.
///
/// # Errors
/// One line, if the build has no Parquet.
#[cfg(not(feature = "parquet"))]
fn parquet(_: &[Array]) -> Result<Vec<u8>, String> {
    Err("this build has no Parquet; cargo build --features parquet makes one that has".to_owned())
}

#[cfg(feature = "parquet")]
use super::parquet::parquet;

/// The name of a form of arrays that the ending of a file stands for: `npz` or `parquet`.
pub fn form_of(path: &Path) -> Option<&'static str> {
    let ending = path.extension()?.to_str()?;
    ["npz", "parquet"].into_iter().find(|form| ending.eq_ignore_ascii_case(form))
}

/// Comma-separated values in the form that a file stands for.
///
/// # Errors
/// One line, if the build does not have that form.
pub fn packed(path: &Path, csv: &str) -> Result<Vec<u8>, String> {
    match form_of(path) {
        None => Ok(csv.as_bytes().to_vec()),
        Some("npz") => Ok(npz(&columns(csv))),
        Some(_) => parquet(&columns(csv)),
    }
}
