//! Lists whose last column is text, wrapped to the width of the terminal.

use crate::words;

/// Narrowest readable last column; with less room the text continues below its row.
const NARROWEST: usize = 30;

/// Number of blanks before text that continues below its row.
const INDENT: usize = 4;

/// The list wrapped to the width of the terminal; unchanged if the output goes to a file or a pipe.
pub fn on_terminal(list: &str) -> String {
    columns().map_or_else(|| list.to_owned(), |width| wrapped(list, usize::from(width)))
}

/// Number of columns of the terminal to which the output goes; `None` if it goes elsewhere.
pub fn columns() -> Option<u16> {
    rustix::termios::tcgetwinsize(rustix::stdio::stdout()).map(|size| size.ws_col).ok()
}

/// Wraps the last column of rows longer than `width` between words. The first line of the list holds the titles of
/// the columns, separated by two or more blanks.
fn wrapped(list: &str, width: usize) -> String {
    let heading: Vec<char> = list.lines().next().unwrap_or_default().chars().collect();
    let gap = heading.windows(2).rposition(|pair| pair == [' ', ' ']);
    let Some(start) = gap.map(|gap| gap + 2).filter(|_| width > INDENT + NARROWEST) else {
        return list.to_owned();
    };
    let (indent, room) =
        if width >= start + NARROWEST { (start, width - start) } else { (INDENT, width - INDENT) };
    let mut out = String::new();
    for row in list.lines() {
        let cells: Vec<char> = row.chars().collect();
        if cells.len() <= width.max(start) || cells[start - 1] != ' ' {
            out += row;
            out.push('\n');
            continue;
        }
        let head: String = cells[..start].iter().collect();
        let text: String = cells[start..].iter().collect();
        if indent == start {
            out += &head;
        } else {
            out += &format!("{}\n{:INDENT$}", head.trim_end(), "");
        }
        out += &words::wrapped(&text, room).join(&format!("\n{:indent$}", ""));
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "\
key  meaning
a    one two three four five six seven eight nine ten
b    short
";

    #[test]
    fn the_last_column_goes_on_below_itself() {
        let expected = "\
key  meaning
a    one two three four five six
     seven eight nine ten
b    short
";
        assert_eq!(wrapped(LIST, 36), expected);
    }

    #[test]
    fn where_there_is_little_room_it_goes_on_below_its_row() {
        let list = format!("{:40}meaning\n{:40}one two three four\nnot a row\n", "key", "a");
        let narrow = list.replace("one two three four", "one two three four five six");
        assert_eq!(wrapped(&list, 58), list);
        assert_eq!(
            wrapped(&narrow, 58),
            format!("{:40}meaning\na\n    one two three four five six\nnot a row\n", "key")
        );
    }

    #[test]
    fn nothing_changes_where_all_fits_or_nothing_would() {
        assert_eq!(wrapped(LIST, 80), LIST);
        assert_eq!(wrapped(LIST, 20), LIST);
        assert_eq!(wrapped("", 80), "");
    }
}
