//! Arrays with names.

use crate::scan::holds_words;
use crate::words::joined;

/// An array with a name: its lengths, the last index varying fastest, and its cells.
pub struct Array {
    pub name: String,
    shape: Vec<usize>,
    pub cells: ArrayCells,
}

/// Cells of one type.
pub enum ArrayCells {
    /// Codes whose meaning another array tells.
    Codes(Vec<u8>),
    /// Not a number where there is none.
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

impl ArrayCells {
    /// The cells of a column as text with every digit. All numbers are doubles: a count, too, may be missing.
    pub fn read(name: &str, cells: &[&str]) -> Self {
        let number = |cell: &&str| if cell.is_empty() { Ok(f64::NAN) } else { cell.parse() };
        let numbers = cells.iter().map(number).collect::<Result<_, _>>();
        let numbers = numbers.ok().filter(|_| !holds_words(name));
        numbers.map_or_else(|| ArrayCells::words(cells), ArrayCells::Numbers)
    }

    /// These words.
    pub fn words(words: &[&str]) -> Self {
        ArrayCells::Words(words.iter().map(ToString::to_string).collect())
    }
}

impl Array {
    /// An array of these lengths.
    pub fn new(name: &str, shape: &[usize], cells: ArrayCells) -> Self {
        Array { name: name.to_owned(), shape: shape.to_vec(), cells }
    }

    /// The array as a file of numpy.
    pub fn npy(&self) -> Vec<u8> {
        let (kind, bytes) = match &self.cells {
            ArrayCells::Codes(cells) => ("|u1".to_owned(), cells.clone()),
            ArrayCells::Numbers(cells) => {
                ("<f8".to_owned(), cells.iter().flat_map(|cell| cell.to_le_bytes()).collect())
            }
            ArrayCells::Words(cells) => {
                let longest = cells.iter().map(|it| it.chars().count()).fold(1, usize::max);
                let filled = |cell: &String| {
                    let chars = cell.chars().map(u32::from).chain(std::iter::repeat(0));
                    chars.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<_>>()
                };
                (format!("<U{longest}"), cells.iter().flat_map(filled).collect())
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
