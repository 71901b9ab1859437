//! A screen as text, and as a picture in SVG.
//!
//! The picture needs no special font: braille dots, blocks and lines are drawn as shapes, other
//! characters as text in any monospaced font, stretched to its cells.

use std::fmt::Write;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

use super::look::{FIXED, fixed};
use super::signs::MINUS;
use crate::numerics::real;
use crate::words::printable::xml;

/// The rows of a screen, without the blanks at their ends and with minus signs as programs read them.
pub fn text(screen: &Buffer) -> String {
    let mut out = String::new();
    for row in rows(screen) {
        let line: String = row.iter().map(|place| place.symbol).collect();
        out.push_str(&line.trim_end().replace(MINUS, "-"));
        out.push('\n');
    }
    out
}

/// Width and height of a cell, and of the font in it, in the picture's units.
const CELL: (f64, f64) = (8.0, 16.0);
// At this size the letters of the first font asked for are as wide as a cell.
const FONT_SIZE: f64 = 13.29;

/// Where letters stand in a cell, from its top.
const BASELINE: f64 = 12.0;

/// Colours of text and of the ground where the screen leaves them to the terminal.
#[derive(Clone, Copy)]
pub struct Paper {
    pub(super) ink: u32,
    pub(super) ground: u32,
}

impl Paper {
    /// As most terminals are.
    pub const DARK: Self = Paper { ink: 0xd8_d8d8, ground: 0x10_1418 };

    /// For the theme made for it.
    pub const LIGHT: Self = Paper { ink: 0x14_1414, ground: 0xfd_fdfd };
}

pub fn svg(screen: &Buffer, paper: Paper) -> String {
    // As to blanks, browsers go by the style, other readers of SVG by the attribute.
    let mut out = format!(
        include_str!("../../assets/terminal.svg"),
        width = f64::from(screen.area.width) * CELL.0,
        height = f64::from(screen.area.height) * CELL.1,
        font_size = FONT_SIZE,
        ground = paper.ground,
    );
    let paint = |place: &ScreenCell| Paint::of(place.cell, paper);
    for (number, row) in rows(screen).enumerate() {
        let mut corner = (0.0, CELL.1 * real(number));
        for run in row.chunk_by(|one, other| paint(one) == paint(other)) {
            draw(&mut out, run, paint(&run[0]), corner);
            corner.0 += CELL.0 * real(run.len());
        }
    }
    out + "</svg>\n"
}

/// One place on the screen: what stands there and the cell as which it is painted.
struct ScreenCell<'a> {
    /// Empty where the character before covers this place too.
    symbol: &'a str,
    cell: &'a Cell,
}

fn rows(screen: &Buffer) -> impl Iterator<Item = Vec<ScreenCell<'_>>> {
    screen.content.chunks(usize::from(screen.area.width).max(1)).map(places)
}

/// The places of a row; what a wide character covers looks as it does.
fn places(row: &[Cell]) -> Vec<ScreenCell<'_>> {
    let mut places: Vec<ScreenCell> = Vec::with_capacity(row.len());
    for cell in row {
        let wide = places.last().filter(|last| last.symbol.width() > 1);
        let place = match wide {
            Some(last) => ScreenCell { symbol: "", cell: last.cell },
            None => ScreenCell { symbol: cell.symbol(), cell },
        };
        places.push(place);
    }
    places
}

/// How a cell is painted: colours after reversal, and the modifiers that remain.
#[derive(Clone, Copy, PartialEq)]
struct Paint {
    ink: u32,
    ground: Option<u32>,
    modifier: Modifier,
}

impl Paint {
    fn of(cell: &Cell, paper: Paper) -> Self {
        let (ink, ground) = (painted(cell.fg), painted(cell.bg));
        let (own, modifier) = (ink.unwrap_or(paper.ink), cell.modifier);
        if modifier.contains(Modifier::REVERSED) {
            return Paint { ink: ground.unwrap_or(paper.ground), ground: Some(own), modifier };
        }
        Paint { ink: own, ground, modifier }
    }

    /// Attributes of shapes and of text in this paint.
    fn attributes(&self) -> String {
        let mut out = format!("fill=\"#{:06x}\"", self.ink);
        for (modifier, attribute) in [
            (Modifier::BOLD, " font-weight=\"bold\""),
            (Modifier::ITALIC, " font-style=\"italic\""),
            (Modifier::UNDERLINED, " text-decoration=\"underline\""),
            (Modifier::DIM, " opacity=\"0.6\""),
        ] {
            if self.modifier.contains(modifier) {
                out.push_str(attribute);
            }
        }
        out
    }
}

/// Draws neighbouring places of one paint, the first with its upper left corner there: their ground, what is drawn as
/// shapes in one path, and what is left as one text.
fn draw(out: &mut String, run: &[ScreenCell], paint: Paint, (left, top): (f64, f64)) {
    if let Some(ground) = paint.ground {
        let (width, height) = (CELL.0 * real(run.len()), CELL.1);
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"#{ground:06x}\"/>"
        );
    }
    let (mut path, mut line) = (String::new(), String::new());
    for (number, ScreenCell { symbol, .. }) in run.iter().enumerate() {
        let shaped = shape(&mut path, symbol, left + CELL.0 * real(number), top);
        line += if shaped { " " } else { symbol };
    }
    let attributes = paint.attributes();
    if !path.is_empty() {
        let _ = writeln!(out, "<path {attributes} d=\"{path}\"/>");
    }
    let text = line.trim();
    if !text.is_empty() {
        let indent = line.chars().take_while(|char| char.is_whitespace()).count();
        let (x, y) = (left + CELL.0 * real(indent), top + BASELINE);
        let (length, text) = (CELL.0 * real(text.width()), xml(text));
        let _ = writeln!(
            out,
            "<text x=\"{x}\" y=\"{y}\" textLength=\"{length}\" {attributes}>{text}</text>"
        );
    }
}

/// Appends the shape of a character to a path, if it is one of those drawn as shapes; returns whether it is.
fn shape(path: &mut String, symbol: &str, x: f64, top: f64) -> bool {
    /// Radius of a braille dot.
    const DOT: f64 = 1.3;
    /// Width of a line.
    const LINE: f64 = 1.0;
    let mut chars = symbol.chars();
    let (Some(char), None) = (chars.next(), chars.next()) else { return false };
    if let Some(dots) = braille(char) {
        for (column, row) in dots {
            let (x, y) = (x + CELL.0 * (0.25 + 0.5 * column), top + CELL.1 * (0.125 + 0.25 * row));
            let (left, size) = (x - DOT, 2.0 * DOT);
            let _ =
                write!(path, "M{left} {y}a{DOT} {DOT} 0 1 0 {size} 0a{DOT} {DOT} 0 1 0 -{size} 0");
        }
    } else if let Some((from, to)) = block(char) {
        rectangle(path, (x, top + CELL.1 * from), (CELL.0, CELL.1 * (to - from)));
    } else if let Some([left, right, up, down]) = strokes(char) {
        let (middle, center, half) = (x + 0.5 * CELL.0, top + 0.5 * CELL.1, 0.5 * LINE);
        let reach = |is_there: bool, edge: f64, own: f64| if is_there { edge } else { own };
        let (from, to) = (reach(left, x, middle - half), reach(right, x + CELL.0, middle + half));
        rectangle(path, (from, center - half), (to - from, LINE));
        let from = reach(up, top, center - half);
        let to = reach(down, top + CELL.1, center + half);
        rectangle(path, (middle - half, from), (LINE, to - from));
    } else {
        return false;
    }
    true
}

fn rectangle(path: &mut String, (x, y): (f64, f64), (width, height): (f64, f64)) {
    let _ = write!(path, "M{x} {y}h{width}v{height}h{}z", -width);
}

/// The dots of a braille pattern as column 0 or 1 and row 0 to 3; none for other characters.
fn braille(char: char) -> Option<impl Iterator<Item = (f64, f64)>> {
    let pattern = u32::from(char).checked_sub(0x2800).filter(|pattern| *pattern < 0x100)?;
    // Three dots down each side have the first bits, the lowest ones the last two (Unicode chapter 21.1).
    let place = |bit: u8| if bit < 6 { (bit / 3, bit % 3) } else { (bit - 6, 3) };
    let set = (0..8).filter(move |bit| (pattern >> bit) & 1 == 1).map(place);
    Some(set.map(|(column, row)| (f64::from(column), f64::from(row))))
}

/// The part of the cell's height that a block covers.
fn block(char: char) -> Option<(f64, f64)> {
    match char {
        '█' => Some((0.0, 1.0)),
        '▀' => Some((0.0, 0.5)),
        '▄' => Some((0.5, 1.0)),
        _ => None,
    }
}

/// Whether a line goes from the middle of the cell to the left, right, up and down.
fn strokes(char: char) -> Option<[bool; 4]> {
    const LINES: [&str; 4] = ["─┐┘┤┬┴┼", "─┌└├┬┴┼", "│└┘├┤┴┼", "│┌┐├┤┬┼"];
    let sides = LINES.map(|lines| lines.contains(char));
    sides.contains(&true).then_some(sides)
}

/// Red, green and blue of a colour as one number, or `None` where it is left to the terminal.
fn painted(color: Color) -> Option<u32> {
    /// The sixteen colours of the terminal's palette, as in most terminals today.
    const PALETTE: [u32; 16] = [
        0x00_0000, 0xcd_3131, 0x0d_bc79, 0xe5_e510, 0x24_72c8, 0xbc_3fbc, 0x11_a8cd, 0xe5_e5e5,
        0x66_6666, 0xf1_4c4c, 0x23_d18b, 0xf5_f543, 0x3b_8eea, 0xd6_70d6, 0x29_b8db, 0xff_ffff,
    ];
    let [red, green, blue] = match color {
        Color::Rgb(red, green, blue) => [red, green, blue],
        Color::Indexed(index @ FIXED..) => fixed(index),
        Color::Indexed(index) => return Some(PALETTE[usize::from(index)]),
        _ => return None,
    };
    Some(u32::from_be_bytes([0, red, green, blue]))
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    use super::*;

    fn screen() -> Buffer {
        let mut screen = Buffer::empty(Rect::new(0, 0, 12, 3));
        screen.set_string(
            0,
            0,
            "a < b",
            Style::new().fg(Color::Indexed(1)).add_modifier(Modifier::BOLD),
        );
        screen.set_string(6, 0, "⣿⠁", Style::new().fg(Color::Indexed(196)));
        screen.set_string(1, 1, "世x", Style::new().add_modifier(Modifier::REVERSED));
        screen
    }

    #[test]
    fn text_has_every_row_without_blanks_at_the_end() {
        assert_eq!(text(&screen()), "a < b ⣿⠁\n 世x\n\n");
    }

    #[test]
    fn the_picture_draws_letters_as_text_and_dots_as_shapes() {
        let picture = svg(&screen(), Paper::DARK);
        assert!(picture.contains("font-weight=\"bold\">a &lt; b</text>"), "{picture}");
        // Eight dots and one, two arcs each, in one path of one colour.
        assert_eq!(picture.matches("a1.3 1.3").count(), 18);
        assert!(picture.contains("<path fill=\"#ff0000\""), "{picture}");
        assert!(!picture.contains('⣿'));
        // The wide character covers two cells; with the next it is three, reversed.
        assert!(picture.contains("textLength=\"24\""), "{picture}");
        let ground = format!("width=\"24\" height=\"16\" fill=\"#{:06x}\"", Paper::DARK.ink);
        assert!(picture.contains(&ground), "{picture}");
        assert!(picture.contains("width=\"96\" height=\"48\""));
    }

    #[test]
    fn indexed_colours_are_those_of_the_cube_and_the_greys() {
        let cases = [
            (16, 0x00_0000),
            (21, 0x00_00ff),
            (231, 0xff_ffff),
            (232, 0x08_0808),
            (255, 0xee_eeee),
        ];
        for (index, expected) in cases {
            assert_eq!(painted(Color::Indexed(index)), Some(expected), "{index}");
        }
    }
}
