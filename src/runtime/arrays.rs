//! Cells as arrays, and their files of numpy.
//!
//! Cells are told as text with every digit, as comma-separated values have them, and their array follows: integers if all
//! of them are, doubles with NaN for a missing one if all are numbers, else words; integers in rows and columns are bytes.

use crate::words::joined;

/// An array with a name: its lengths, the last index varying fastest, and its cells.
pub struct Array {
    pub name: String,
    shape: Vec<usize>,
    pub cells: Vec<String>,
}

/// Cells as what all of them are.
pub enum ArrayCells {
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
    pub fn typed(&self) -> ArrayCells {
        let number = |cell: &String| match cell.as_str() {
            "" => Some(None),
            cell => cell.parse().ok().map(Some),
        };
        let counts: Option<_> = self.cells.iter().map(|cell| cell.parse().ok()).collect();
        let numbers =
            || self.cells.iter().map(number).collect::<Option<_>>().map(ArrayCells::Numbers);
        counts.map(ArrayCells::Counts).or_else(numbers).unwrap_or(ArrayCells::Words)
    }

    /// The array as a file of numpy.
    pub fn npy(&self) -> Vec<u8> {
        let (kind, bytes): (_, Vec<u8>) = match self.typed() {
            ArrayCells::Counts(cells) if self.shape.len() > 1 => {
                ("|u1".to_owned(), cells.into_iter().filter_map(|it| it.try_into().ok()).collect())
            }
            ArrayCells::Counts(cells) => {
                ("<i8".to_owned(), cells.into_iter().flat_map(i64::to_le_bytes).collect())
            }
            ArrayCells::Numbers(cells) => {
                let cells = cells.into_iter().map(|cell| cell.unwrap_or(f64::NAN));
                ("<f8".to_owned(), cells.flat_map(f64::to_le_bytes).collect())
            }
            ArrayCells::Words => {
                let longest = self.cells.iter().map(|it| it.chars().count()).max().unwrap_or(0);
                let filled = |cell: &String| {
                    let chars = cell.chars().map(u32::from).chain(std::iter::repeat(0));
                    chars.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<_>>()
                };
                (format!("<U{longest}"), self.cells.iter().flat_map(filled).collect())
            }
        };
        let shape = joined(&self.shape, ",");
        let named = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape},), }}");
        // With the ten bytes before it and its newline the header ends at a multiple of 64.
        let length = (named.len() + 11).next_multiple_of(64) - 10;
        let header = format!("{named:<width$}\n", width = length - 1);
        let size = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
        [b"\x93NUMPY\x01\x00".as_slice(), &size, header.as_bytes(), &bytes].concat()
    }
}
