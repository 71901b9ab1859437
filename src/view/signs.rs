//! Signs as people read them, and as programs do: all texts are made with the signs of the keyboard, and the
//! whole screen gets its minus signs at once, wherever its numbers came from.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Position, Rect};

/// How far a number may be off, on either side.
const PLUS_MINUS: char = '\u{b1}';

/// The minus sign, as wide as a plus sign.
pub const MINUS: char = '\u{2212}';

/// Puts minus signs before the numbers and letters of an area, and plus-minus signs at the beginnings of words, except in
/// rows for which `is_typed` holds.
pub fn minus(area: Rect, buffer: &mut Buffer, is_typed: impl Fn(u16) -> bool) {
    for place @ Position { x, y } in area.positions() {
        // Almost no cell has a hyphen: only beside one is anything read.
        if buffer[place].symbol() != "-" || is_typed(y) {
            continue;
        }
        let around = [-2, -1, 1, 2].map(|by| {
            let beside = x.checked_add_signed(by).filter(|x| (area.x..area.right()).contains(x));
            beside.map_or(' ', |x| letter(&buffer[(x, y)]))
        });
        if around[..2] == [' ', '+'] {
            buffer[(x - 1, y)].set_char(PLUS_MINUS);
            let start = buffer.index_of(x, y);
            close_up(&mut buffer.content[start..start + usize::from(area.right() - x)]);
        } else if is_minus(around) {
            buffer[place].set_char(MINUS);
        }
    }
}

/// Takes a cell away: the text behind it moves up, as far as two blanks or a blank and a frame.
fn close_up(row: &mut [Cell]) {
    let is_end = |pair: &[Cell]| pair[0].symbol() == " " && " │|".contains(letter(&pair[1]));
    let end = row.windows(2).position(is_end).unwrap_or(row.len() - 1);
    row[..=end].rotate_left(1);
    row[end].set_char(' ');
}

fn letter(cell: &Cell) -> char {
    cell.symbol().chars().next().unwrap_or(' ')
}

/// Whether a hyphen between these letters, two before and two after it, is a sign: of a number or a name of
/// one letter, not in a word, and of an exponent.
fn is_minus([early, before, after, late]: [char; 4]) -> bool {
    let number = after.is_ascii_digit() || (after == '.' && late.is_ascii_digit());
    let name = after.is_ascii_alphabetic() && !late.is_alphanumeric() && late != '-';
    let begins = !before.is_alphanumeric() && !"-_/.+".contains(before);
    let exponent = before == 'e' && early.is_ascii_digit() && after.is_ascii_digit();
    exponent || (begins && (number || (name && " ([".contains(before))))
}

/// Replaces what a terminal without Unicode cannot show, wherever the text came from: the sides and corners of boxes by
/// letters that look alike, all else by question marks.
pub fn only_letters(buffer: &mut Buffer) {
    for cell in buffer.content.iter_mut().filter(|cell| !cell.symbol().is_ascii()) {
        cell.set_char(match letter(cell) {
            '─' => '-',
            '│' => '|',
            '┌' | '┐' | '└' | '┘' => '+',
            _ => '?',
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_has_its_sign_and_what_stands_beside_the_text_stays() {
        for (written, read) in [
            ("lost 0.1 +- 1e-11  next", "lost 0.1 ± 1e\u{2212}11   next"),
            ("-D +- j │", "\u{2212}D ± j  │"),
            ("+-2 deviations", "±2 deviations "),
            (" +-2 deviations", " ±2 deviations "),
            ("r=0.1+-0.01", "r=0.1+-0.01"),
        ] {
            let mut buffer = Buffer::with_lines([written]);
            minus(buffer.area, &mut buffer, |_| false);
            let line: String = buffer.content.iter().map(Cell::symbol).collect();
            assert_eq!(line, read);
        }
    }

    #[test]
    fn numbers_have_minus_signs_and_words_keep_their_hyphens() {
        let cases = [
            ("D -0.3", "D \u{2212}0.3"),
            ("\u{b1}1e-10 (-5)", "\u{b1}1e\u{2212}10 (\u{2212}5)"),
            ("-r .. r", "\u{2212}r .. r"),
            ("q in [-0.1, .5]", "q in [\u{2212}0.1, .5]"),
            ("e^-710 -.5", "e^\u{2212}710 \u{2212}.5"),
            ("stick-slip C-r scan-2.csv 2026-11-22", "stick-slip C-r scan-2.csv 2026-11-22"),
            ("--set -- - sign-rk4", "--set -- - sign-rk4"),
        ];
        for (written, read) in cases {
            let mut buffer = Buffer::with_lines([written]);
            let area = buffer.area;
            minus(area, &mut buffer, |_| false);
            let line: String = buffer.content.iter().map(ratatui::buffer::Cell::symbol).collect();
            assert_eq!(line, read);
            assert_eq!(super::super::screen::text(&buffer).trim_end(), written);
            minus(area, &mut buffer, |_| true);
        }
    }
}
