//! Aligned columns of text, for reading: on a screen, and on a page.

use std::fmt;

use crate::numerics::powi;
use crate::words::printable::signs;
use crate::words::wrapped;

/// Width of a screen that every table fits.
pub const SCREEN: usize = 80;

/// Narrowest readable column of words.
const NARROWEST: usize = 30;

/// Blanks before what goes on below its row.
const INDENT: usize = 4;

/// A table: titles, and rows with as many cells. Words begin, and the points of numbers stand, below each other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    pub(super) titles: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
    /// What it shows.
    pub(super) caption: String,
    /// Whether its lines may be longer than a screen is wide.
    is_unbroken: bool,
    /// The width within which such lines go on below themselves.
    width: Option<usize>,
}

/// How the cells of a column are set.
struct Alignment {
    is_number: bool,
    /// Characters before the decimal points of numbers, or of words.
    whole: usize,
    /// Characters from the decimal points on.
    part: usize,
}

impl Table {
    /// A table of these titles and rows.
    pub(super) fn new(titles: Vec<String>, rows: Vec<Vec<String>>) -> Self {
        let read = |row: Vec<String>| row.iter().map(|cell| signs(cell)).collect();
        Table { titles, rows: rows.into_iter().map(read).collect(), ..Table::default() }
    }

    /// The same with lines of any length, or wrapped to a width, if one is given.
    pub(super) fn unbroken(self, width: Option<usize>) -> Self {
        Table { is_unbroken: true, width, ..self }
    }

    /// The same with what it shows below it.
    pub(super) fn captioned(self, caption: impl Into<String>) -> Self {
        Table { caption: caption.into(), ..self }
    }

    /// Whether there is nothing to show.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty() || self.titles.is_empty()
    }

    /// The same with rows as columns; the first cell of a row becomes its title.
    pub(super) fn transposed(&self) -> Table {
        let lines = std::iter::once(&self.titles).chain(&self.rows);
        let line = |at: usize| lines.clone().map(|line| line[at].clone()).collect::<Vec<_>>();
        let mut lines = (0..self.titles.len()).map(line);
        Table::new(lines.next().unwrap_or_default(), lines.collect())
    }

    /// The same without columns in which nothing stands.
    pub(super) fn lean(&self) -> Table {
        let stands = |at: &usize| self.rows.iter().any(|row| !["", "-"].contains(&&*row[*at]));
        let columns: Vec<usize> = (0..self.titles.len()).filter(stands).collect();
        self.of(&columns)
    }

    /// Some of its columns.
    fn of(&self, columns: &[usize]) -> Table {
        let of = |line: &Vec<String>| columns.iter().map(|at| line[*at].clone()).collect();
        Table::new(of(&self.titles), self.rows.iter().map(of).collect())
    }

    /// The titles and the rows, each cell padded to the width of its column.
    pub(super) fn padded(&self) -> Vec<Vec<String>> {
        let columns: Vec<_> = (0..self.titles.len()).map(|at| self.alignment(at)).collect();
        let titles = self.titles.iter().zip(&columns);
        let titles = titles.map(|(title, column)| column.title(title)).collect();
        let cells = |row: &Vec<String>| {
            row.iter().zip(&columns).map(|(cell, column)| column.cell(cell)).collect()
        };
        std::iter::once(titles).chain(self.rows.iter().map(cells)).collect()
    }

    pub(super) fn is_number(&self, at: usize) -> bool {
        self.alignment(at).is_number
    }

    fn alignment(&self, at: usize) -> Alignment {
        let cells = || self.rows.iter().map(|row| row[at].as_str());
        let title = length(&self.titles[at]);
        if cells().all(is_gap) || !cells().all(|cell| is_gap(cell) || is_number(cell)) {
            let whole = cells().map(length).fold(title, usize::max);
            return Alignment { is_number: false, whole, part: 0 };
        }
        let (whole, part) = cells().map(split).fold((0, 0), |widest, (whole, part)| {
            (widest.0.max(length(whole)), widest.1.max(length(part)))
        });
        Alignment { is_number: true, whole: whole.max(title.saturating_sub(part)), part }
    }

    /// The table on lines of any length, or the cells of rows longer than the width on several lines. Words in the last
    /// column are wrapped; where their place leaves little room, they go on below their row.
    fn lines(&self) -> String {
        let width = self.width.filter(|width| *width > INDENT + NARROWEST).unwrap_or(usize::MAX);
        let columns = self.titles.len() - usize::from(!self.is_number(self.titles.len() - 1));
        let below = |head: &str| format!("{}\n{:INDENT$}", head.trim_end(), "");
        let line = |mut cells: Vec<String>| {
            let last = cells.split_off(columns).concat();
            let (mut head, mut start) = (String::new(), 0);
            // The cells of a column have one width, so that all lines go on at the same column.
            for cell in cells {
                if start > 0 && start + length(&cell) > width {
                    (head, start) = (below(&head), INDENT);
                }
                start += length(&cell) + 2;
                head += &(cell + "  ");
            }
            let end = length(last.trim_end());
            if end == 0 || start + end <= width {
                return (head + &last).trim_end().to_owned() + "\n";
            }
            if width < start + NARROWEST {
                (head, start) = (below(&head), INDENT);
            }
            head + &wrapped(&last, width - start).join(&format!("\n{:start$}", "")) + "\n"
        };
        self.padded().into_iter().map(line).collect()
    }

    /// Columns that fit a screen together, and those of the tables that continue it; each begins with the first. Words at
    /// the end of a line may be long.
    fn parts(&self) -> Vec<Vec<usize>> {
        let titles = self.padded().swap_remove(0);
        let width = |at: &usize| length(&titles[*at]) + 2;
        let mut parts = vec![vec![]];
        for at in 0..titles.len() {
            let last = parts.len() - 1;
            let full = parts[last].iter().map(width).sum::<usize>() + width(&at) > SCREEN + 2;
            let is_remark = at + 1 == titles.len() && !self.is_number(at);
            if full && parts[last].len() > 1 && !is_remark {
                parts.push(vec![0, at]);
            } else {
                parts[last].push(at);
            }
        }
        parts
    }
}

/// A table that is too wide for a screen is continued below itself.
impl fmt::Display for Table {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return Ok(());
        }
        let parts = if self.is_unbroken {
            vec![self.lines()]
        } else {
            self.parts().iter().map(|columns| self.of(columns).lines()).collect()
        };
        out.write_str(&parts.join("\n"))?;
        if self.caption.is_empty() {
            Ok(())
        } else {
            writeln!(out, "{}", self.caption)
        }
    }
}

impl Alignment {
    fn title(&self, title: &str) -> String {
        let width = self.whole + self.part;
        if self.is_number {
            format!("{title:>width$}")
        } else {
            format!("{title:width$}")
        }
    }

    fn cell(&self, cell: &str) -> String {
        let Alignment { is_number, whole, part } = *self;
        let (before, after) = split(cell);
        if is_number {
            format!("{before:>whole$}{after:part$}")
        } else {
            format!("{cell:whole$}")
        }
    }
}

/// Columns of a text.
fn length(text: &str) -> usize {
    text.chars().count()
}

/// Whether a cell stands for a number that does not exist.
fn is_gap(cell: &str) -> bool {
    ["", "-", "?", "none", "any"].contains(&cell)
}

/// Whether a cell begins with a number.
fn is_number(cell: &str) -> bool {
    let cell = cell.trim_start_matches(['-', '<', '>', ' ']);
    cell.starts_with(|char: char| char.is_ascii_digit()) || cell.starts_with("exp(")
}

/// A cell before its decimal point, and from there on.
fn split(cell: &str) -> (&str, &str) {
    cell.split_at(cell.find('.').unwrap_or(cell.len()))
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

    fn table(titles: &[&str], rows: &[&[&str]]) -> Table {
        let owned = |cells: &&[&str]| cells.iter().map(|&cell| cell.to_owned()).collect();
        Table::new(owned(&titles), rows.iter().map(owned).collect())
    }

    #[test]
    fn points_of_numbers_and_beginnings_of_words_stand_above_each_other() {
        let table = table(
            &["tau", "q", "ends"],
            &[&["1.5", "-0.25", "at rest"], &["10.25", "1", "-"], &["100", "-", "so"]],
        );
        let shown =
            "   tau      q  ends\n  1.5   -0.25  at rest\n 10.25   1     -\n100      -     so\n";
        assert_eq!(table.to_string(), shown);
        assert_eq!(table.transposed().transposed(), table);
    }

    #[test]
    fn a_wide_table_is_continued_below_itself() {
        let cells = ["a"; 30].map(|cell| cell.repeat(3));
        let cells: Vec<&str> = cells.iter().map(String::as_str).collect();
        let shown = table(&cells, &[&cells]).to_string();
        assert!(shown.lines().all(|line| line.len() <= SCREEN), "{shown}");
        // Fifteen of the other columns, and fourteen.
        assert_eq!((shown.matches("aaa").count(), shown.lines().count()), (2 * 31, 5));
    }

    #[test]
    fn the_last_column_goes_on_below_itself_or_where_there_is_little_room_below_its_row() {
        let list = table(&["key", "meaning"], &[&["a", "one two three four five six seven"]]);
        let shown = |width| list.clone().unbroken(Some(width)).to_string();
        assert_eq!(shown(35), "key  meaning\na    one two three four five six\n     seven\n");
        assert_eq!([shown(38), shown(30)], [list.to_string(), list.to_string()]);
        let wide = table(&["a".repeat(38).as_str(), "b"], &[&["a", "one two three four five six"]]);
        let wide = wide.unbroken(Some(58)).to_string();
        assert!(wide.ends_with("\na\n    one two three four five six\n"), "{wide}");
    }

    #[test]
    fn rows_that_are_too_long_go_on_below_themselves_at_the_same_columns() {
        let numbers = ["12345678901234567"; 4];
        let wide = table(&["a", "b", "c", "d"], &[&numbers, &["1", "2", "3", "4"]]);
        let shown = wide.unbroken(Some(40)).to_string();
        let gap = " ".repeat(16);
        let first = format!("{gap}a  {gap}b\n    {gap}c  {gap}d\n");
        assert!(shown.starts_with(&first), "{shown}");
        assert!(shown.ends_with(
            &first.replace('a', "1").replace('b', "2").replace('c', "3").replace('d', "4")
        ));
    }

    #[test]
    fn a_tolerance_says_how_many_digits_count() {
        let expected = [(1e-10, 10), (3e-11, 11), (1e-2, 3), (1e-15, 15), (1e-30, 16)];
        for (tolerance, places) in expected {
            assert_eq!(digits(tolerance), places, "{tolerance}");
        }
    }
}
