//! The cells of a file: lines, separators, and the values of cells.

use super::clock;

/// What instruments write for a missing number, in lower case.
const MISSING: [&str; 14] = [
    "", "-", "--", "---", "nan", "na", "n/a", "#n/a", "null", "none", "inf", "-inf", "ovl",
    "overload",
];

/// The value of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A number, or a clock time in seconds.
    Number(f64),
    /// A missing number, as instruments write it.
    Missing,
    /// Anything else.
    Text,
}

/// A line that is not empty, with its number.
#[derive(Clone, Copy)]
pub struct NumberedLine<'a> {
    /// Counted from 1.
    pub number: usize,
    /// Without leading and trailing blanks.
    pub text: &'a str,
}

/// The lines of a text, except empty ones and comments.
pub fn lines(text: &str) -> Vec<NumberedLine<'_>> {
    let mut found = Vec::new();
    let parts = text.split('\n').flat_map(|part| {
        // A carriage return alone also ends a line; before a newline it is part of the line ending.
        part.strip_suffix('\r').unwrap_or(part).split('\r')
    });
    for (index, text) in parts.enumerate() {
        let text = text.trim_matches(|char| char == ' ' || char == '\0');
        let blank = text.trim().is_empty() || text.chars().all(|char| ";,\t ".contains(char));
        if !(blank || text.starts_with(['#', '%'])) {
            found.push(NumberedLine { number: index + 1, text });
        }
    }
    found
}

/// What separates the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// This character.
    Sign(char),
    /// One or more blanks.
    Blanks,
}

impl Separator {
    /// The separator found in the last rows, which are data in every file.
    pub fn of(lines: &[NumberedLine]) -> Self {
        /// Number of rows that decide.
        const ROWS: usize = 20;
        let last = &lines[lines.len().saturating_sub(ROWS)..];
        let most = |sign: &dyn Fn(&str) -> bool| {
            2 * last.iter().filter(|line| sign(line.text)).count() > last.len()
        };
        if let Some(sign) = [';', '\t'].into_iter().find(|&sign| most(&|text| text.contains(sign)))
        {
            return Separator::Sign(sign);
        }
        let blank = |text: &str| {
            let cells: Vec<&str> = text.split_whitespace().collect();
            cells.len() > 1 && cells.iter().all(|cell| matches!(read(cell, true), Cell::Number(_)))
        };
        if most(&|text| text.contains(',')) && !most(&blank) {
            return Separator::Sign(',');
        }
        Separator::Blanks
    }

    /// The cells of a line.
    pub fn cells(self, text: &str) -> Vec<&str> {
        match self {
            Separator::Sign(sign) => split(text, sign).into_iter().map(unquoted).collect(),
            Separator::Blanks => words(text).into_iter().map(unquoted).collect(),
        }
    }

    /// Whether a comma may be part of a number.
    pub fn comma_is_decimal(self) -> bool {
        self != Separator::Sign(',')
    }
}

/// The parts between separators outside quotation marks. Quotation marks that do not pair have no special meaning.
fn split(text: &str, sign: char) -> Vec<&str> {
    let mut inside = false;
    let cells = text.split(|char| {
        inside ^= char == '"';
        char == sign && !inside
    });
    let cells = cells.collect();
    if inside { text.split(sign).collect() } else { cells }
}

/// The words between blanks; a unit in brackets belongs to the name before it.
fn words(text: &str) -> Vec<&str> {
    let is_unit = |word: &str| word.starts_with(['[', '(']);
    let mut found: Vec<&str> = Vec::new();
    let mut begin = 0;
    for word in text.split_whitespace() {
        let at = word.as_ptr() as usize - text.as_ptr() as usize;
        match found.last_mut() {
            Some(last) if is_unit(word) && !is_unit(last) => *last = &text[begin..at + word.len()],
            _ => {
                begin = at;
                found.push(word);
            }
        }
    }
    found
}

fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// The value of a cell.
pub fn read(cell: &str, comma_is_decimal: bool) -> Cell {
    if MISSING.contains(&cell.to_ascii_lowercase().as_str()) {
        return Cell::Missing;
    }
    if let Some(seconds) = clock::seconds(cell) {
        return Cell::Number(seconds);
    }
    // A comma at the end of a cell separates it from the next.
    let plain = if comma_is_decimal && cell.contains(',') && !cell.ends_with(',') {
        // If there are both, the later sign is the decimal sign and the other one groups digits.
        if cell.rfind(',') > cell.rfind('.') {
            cell.replace('.', "").replace(',', ".")
        } else {
            cell.replace(',', "")
        }
    } else {
        cell.to_owned()
    };
    // Words such as "infinity" are not numbers that an instrument measured.
    if plain.starts_with(|char: char| char.is_ascii_digit() || "+-.".contains(char)) {
        return match plain.parse::<f64>() {
            Ok(value) if value.is_finite() => Cell::Number(value),
            Ok(_) => Cell::Missing,
            Err(_) => Cell::Text,
        };
    }
    Cell::Text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_of_quotation_alone_is_nothing_special() {
        assert_eq!(split("a \"b,c", ','), ["a \"b", "c"]);
    }

    #[test]
    fn a_unit_in_brackets_belongs_to_the_name_before_it() {
        assert_eq!(words("t [s]  x [mm]"), ["t [s]", "x [mm]"]);
        assert_eq!(words("[s] (mm)"), ["[s]", "(mm)"]);
    }
}
