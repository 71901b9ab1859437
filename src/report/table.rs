//! Aligned columns of text, for reading.

use std::fmt;

use crate::numerics::elementary::powi;

/// A table: titles, and rows with at most as many cells. Numbers are aligned at their decimal points.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    pub(super) titles: Vec<&'static str>,
    pub(super) rows: Vec<Vec<String>>,
}

impl Table {
    /// Whether there is nothing to show.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty() || self.titles.is_empty()
    }

    /// The table as text with left-aligned columns, for words.
    pub fn aligned_left(&self) -> String {
        self.aligned(|_| true)
    }

    /// The table as text whose columns are aligned at the left or at the right.
    pub(super) fn aligned(&self, is_left: impl Fn(usize) -> bool) -> String {
        let titles = self.titles.iter().map(|title| (*title).to_owned()).collect();
        let rows: Vec<&Vec<String>> = std::iter::once(&titles).chain(&self.rows).collect();
        let width = |column: usize| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..titles.len()).map(width).collect();
        let line = |row: &&Vec<String>| {
            let cells = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| {
                if is_left(column) { format!("{cell:width$}") } else { format!("{cell:>width$}") }
            });
            cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        rows.iter().map(line).collect()
    }

    /// Width of a column before the decimal points, and from there on.
    fn widths(&self, column: usize) -> (usize, usize) {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let (whole, part) = cells.map(|cell| split(cell)).fold((0, 0), |widest, (whole, part)| {
            (widest.0.max(whole.chars().count()), widest.1.max(part.chars().count()))
        });
        let title = self.titles.get(column).map_or(0, |title| title.chars().count());
        (whole.max(title.saturating_sub(part)), part)
    }
}

/// A cell before its decimal point, and from there on.
fn split(cell: &str) -> (&str, &str) {
    cell.split_at(cell.find('.').unwrap_or(cell.len()))
}

impl fmt::Display for Table {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths: Vec<_> = (0..self.titles.len()).map(|column| self.widths(column)).collect();
        let titles = self.titles.iter().zip(&widths);
        let titles = titles.map(|(title, (whole, part))| format!("{title:>0$}", whole + part));
        writeln!(out, "{}", titles.collect::<Vec<_>>().join("  "))?;
        for row in &self.rows {
            let cells = row.iter().zip(&widths).map(|(cell, &(before, after))| {
                let (whole, part) = split(cell);
                format!("{whole:>before$}{part:<after$}")
            });
            writeln!(out, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

/// Number of digits to show for a tolerance, 3 to 16.
pub(super) fn digits(tolerance: f64) -> usize {
    (3..16)
        .find(|&digits| powi(10.0, -digits) <= tolerance * 1.5)
        .map_or(16, |digits| usize::try_from(digits).unwrap_or(16))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_numbers_stand_above_each_other() {
        let cells = [["1.5", "-0.25"], ["10.25", "1"], ["100", "-"]];
        let rows = cells.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        let table = Table { titles: vec!["tau", "q"], rows };
        assert_eq!(table.to_string(), "   tau      q\n  1.5   -0.25\n 10.25   1\n100      -\n");
    }

    #[test]
    fn a_tolerance_says_how_many_digits_count() {
        let expected = [(1e-10, 10), (3e-11, 11), (1e-2, 3), (1e-15, 15), (1e-30, 16)];
        for (tolerance, places) in expected {
            assert_eq!(digits(tolerance), places, "{tolerance}");
        }
    }
}
