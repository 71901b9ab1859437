//! Strokes: the changed cells of a frame, in the order and with the cursor moves that cost least.
//!
//! A stroke is text in one pen on one row. Blanks look alike in most pens, so they join any stroke that they
//! touch, and a stroke also redraws a few unchanged cells where that is shorter than a cursor move. The strokes
//! are drawn either row by row or pen by pen, whichever takes fewer bytes: a curve along a row favours the
//! first order, a line down the screen the second.

use std::ops::Range;

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Position, Size};
use unicode_width::UnicodeWidthStr;

use super::pen::Pen;
use crate::numerics::distinct;
use crate::words::printable::is_printable;

#[derive(Clone, Copy, Debug)]
pub struct Cursor {
    /// Column and row, from 0.
    pub at: Position,
    /// Whether the column is reliable: some terminals draw some characters wider than others do.
    pub certain: bool,
}

/// The known state of the terminal between two strokes.
#[derive(Clone, Copy, Debug, Default)]
pub struct TerminalState {
    /// The pen; `None` if unknown.
    pub pen: Option<Pen>,
    /// The cursor; `None` if unknown.
    pub cursor: Option<Cursor>,
}

/// Text in one pen on one row.
#[derive(Clone)]
struct Stroke {
    start: Position,
    width: u16,
    /// `None` if the text is only blanks, which look alike in most pens; `background` is then one of these
    /// pens.
    pen: Option<Pen>,
    background: Pen,
    text: Range<usize>,
    /// Whether all terminals agree on its width.
    certain: bool,
}

/// The cell at a position of a screen, if it is one column wide and no wide character before it covers it.
fn narrow(shown: &Buffer, x: u16, y: u16) -> Option<&Cell> {
    let width = |x: u16| shown.cell((x, y)).map(|cell| cell.symbol().width());
    let covered = x.checked_sub(1).and_then(width).is_some_and(|width| width > 1);
    shown.cell((x, y)).filter(|_| !covered && width(x) == Some(1))
}

/// The strokes of a frame.
#[derive(Default)]
struct StrokeSheet {
    strokes: Vec<Stroke>,
    text: String,
}

/// Length in bytes of the shortest cursor move to the right; a stroke may redraw cells that cost no more.
const SHORT_MOVE: usize = 3;

impl StrokeSheet {
    /// Adds a cell to the last stroke if possible, else begins a new stroke with it.
    fn put(&mut self, x: u16, y: u16, cell: &Cell, shown: &Buffer) {
        if !self.bridge(x, y, cell, shown) {
            let end = self.text.len();
            self.strokes.push(Stroke {
                start: Position { x, y },
                width: 0,
                pen: None,
                background: Pen::of(cell),
                text: end..end,
                certain: true,
            });
        }
        self.extend(cell);
    }

    /// Extends the last stroke up to a cell, over the unchanged cells between; `false` if that is impossible or
    /// too long.
    fn bridge(&mut self, x: u16, y: u16, cell: &Cell, shown: &Buffer) -> bool {
        let Some(last) = self.strokes.last() else { return false };
        let end = last.start.x + last.width;
        if last.start.y != y || end > x || usize::from(x - end) > SHORT_MOVE || !last.takes(cell) {
            return false;
        }
        let between: Option<Vec<&Cell>> = (end..x).map(|x| narrow(shown, x, y)).collect();
        let Some(between) = between else { return false };
        let cost: usize = between.iter().map(|cell| cell.symbol().len()).sum();
        let mut trial = last.clone();
        let takes = between.iter().copied().chain([cell]).all(|cell| {
            let takes = trial.takes(cell);
            trial.adopt(cell);
            takes
        });
        let fits = takes && cost <= SHORT_MOVE;
        between.into_iter().filter(|_| fits).for_each(|cell| self.extend(cell));
        fits
    }

    fn extend(&mut self, cell: &Cell) {
        let Some(last) = self.strokes.last_mut() else { return };
        let symbol = cell.symbol();
        let width = symbol.width();
        last.adopt(cell);
        last.width += u16::try_from(width).unwrap_or(1);
        last.certain &= symbol.width_cjk() == width;
        // As far as it is printable: ratatui adds invisible characters to the cell before.
        let end = symbol.find(|char| !is_printable(char)).unwrap_or(symbol.len());
        let seen = &symbol[..end];
        self.text.push_str(seen);
        self.text.extend(std::iter::repeat_n(' ', width.saturating_sub(seen.width())));
        last.text.end = self.text.len();
    }

    /// Draws the strokes in this order.
    fn draw(
        &self,
        strokes: &[&Stroke],
        mut hand: TerminalState,
        size: Size,
    ) -> (String, TerminalState) {
        let mut out = String::with_capacity(2 * self.text.len());
        let mut awaited = PendingCells::of(strokes, size);
        for stroke in strokes {
            match hand.cursor.and_then(|cursor| awaited.blanks(cursor, stroke.start)) {
                Some(blanks) => out.push_str(blanks),
                None => go_to(stroke.start, hand.cursor, size, &mut out),
            }
            awaited.range(stroke.start, stroke.width).fill(false);
            let present = hand.pen;
            let pen = match (stroke.pen, present) {
                (Some(pen), _) => pen,
                (None, Some(present)) if present.is_alike_on_blanks(stroke.background) => present,
                (None, _) => stroke.background,
            };
            pen.take_up(present, &mut out);
            out.push_str(&self.text[stroke.text.clone()]);
            let at = Position { x: stroke.start.x + stroke.width, ..stroke.start };
            hand = TerminalState {
                pen: Some(pen),
                cursor: Some(Cursor { at, certain: stroke.certain }),
            };
        }
        (out, hand)
    }
}

/// The cells of strokes that are not drawn yet: their present content does not matter.
struct PendingCells {
    width: usize,
    cells: Vec<bool>,
}

impl PendingCells {
    fn of(strokes: &[&Stroke], size: Size) -> PendingCells {
        let width = usize::from(size.width);
        let mut awaited =
            PendingCells { width, cells: vec![false; width * usize::from(size.height)] };
        for stroke in strokes {
            awaited.range(stroke.start, stroke.width).fill(true);
        }
        awaited
    }

    fn range(&mut self, start: Position, width: u16) -> &mut [bool] {
        let row = usize::from(start.y) * self.width;
        let end = (usize::from(start.x) + usize::from(width)).min(self.width);
        self.cells.get_mut(row + usize::from(start.x)..row + end).unwrap_or_default()
    }

    /// Blanks that lead from the cursor to a position, if they are no longer than a cursor move and all of them
    /// will be drawn over.
    fn blanks(&mut self, cursor: Cursor, target: Position) -> Option<&'static str> {
        const BLANKS: &str = "   ";
        let way = target.x.checked_sub(cursor.at.x)?;
        let passes = cursor.certain && cursor.at.y == target.y;
        let blanks =
            BLANKS.get(..usize::from(way)).filter(|blanks| passes && !blanks.is_empty())?;
        self.range(cursor.at, way).iter().all(|awaited| *awaited).then_some(blanks)
    }
}

impl Stroke {
    /// Whether the stroke can include a cell.
    fn takes(&self, cell: &Cell) -> bool {
        let pen = Pen::of(cell);
        match self.pen {
            Some(own) if cell.symbol() == " " => own.is_alike_on_blanks(pen),
            Some(own) => own == pen,
            None => self.background.is_alike_on_blanks(pen),
        }
    }

    /// Adopts the pen of a cell, unless that is blank.
    fn adopt(&mut self, cell: &Cell) {
        if cell.symbol() != " " {
            self.pen = Some(Pen::of(cell));
        }
    }
}

/// The shorter of two texts that draw what differs between two screens, row by row or pen by pen, and the state in
/// which it leaves pen and cursor.
pub fn draw(shown: &Buffer, picture: &Buffer, hand: TerminalState) -> (String, TerminalState) {
    let mut sheet = StrokeSheet::default();
    for (x, y, cell) in shown.diff_iter(picture) {
        sheet.put(x, y, cell, shown);
    }
    let size = picture.area.as_size();
    let mut strokes: Vec<&Stroke> = sheet.strokes.iter().collect();
    let by_rows = sheet.draw(&strokes, hand, size);
    // In the order in which the pens first appear; strokes of blanks form a group too.
    let pens = distinct(strokes.iter().map(|stroke| stroke.pen));
    strokes.sort_by_key(|stroke| pens.iter().position(|pen| *pen == stroke.pen));
    let by_pens = sheet.draw(&strokes, hand, size);
    if by_pens.0.len() < by_rows.0.len() {
        by_pens
    } else {
        by_rows
    }
}

/// Writes the shorter of the absolute and the relative cursor move.
fn go_to(target: Position, cursor: Option<Cursor>, size: Size, out: &mut String) {
    let Position { x, y } = target;
    let absolute = match (x, y) {
        (0, 0) => "\x1b[H".to_owned(),
        (0, _) => format!("\x1b[{}H", y + 1),
        _ => format!("\x1b[{};{}H", y + 1, x + 1),
    };
    let relative = cursor.and_then(|cursor| relative_move(target, cursor, size));
    let relative = relative.filter(|relative| relative.len() < absolute.len());
    out.push_str(&relative.unwrap_or(absolute));
}

/// The shortest move from a known position, if there is one: down by line feeds or a sequence, left by
/// backspaces, a sequence or from the margin, right by a sequence. There is none upwards.
fn relative_move(target: Position, cursor: Cursor, size: Size) -> Option<String> {
    let Position { x, y } = cursor.at;
    if target.y < y {
        return None;
    }
    let down = steps(target.y - y, "\n", 'B');
    let from_margin = format!("\r{down}{}", steps(target.x, "", 'C'));
    // At the right margin, terminals disagree about the position of the cursor.
    let inside = x < size.width;
    if !(cursor.certain && inside) {
        // Text that follows at once stays together, wherever the terminal has got to.
        let follows = inside && target == cursor.at;
        let is_known = target.x == 0 || (inside && target.y == y);
        return if follows {
            Some(String::new())
        } else {
            is_known.then_some(from_margin)
        };
    }
    let along = if target.x >= x {
        steps(target.x - x, "", 'C')
    } else {
        steps(x - target.x, "\x08", 'D')
    };
    let directly = down + &along;
    Some(if directly.len() <= from_margin.len() {
        directly
    } else {
        from_margin
    })
}

/// A move by `count` steps: repeated single characters if that is shorter, else a sequence.
fn steps(count: u16, single: &str, letter: char) -> String {
    let sequence = match count {
        0 => String::new(),
        1 => format!("\x1b[{letter}"),
        _ => format!("\x1b[{count}{letter}"),
    };
    let is_shorter = !single.is_empty() && usize::from(count) < sequence.len();
    if is_shorter {
        single.repeat(count.into())
    } else {
        sequence
    }
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;
    use ratatui::style::{Color, Style};

    use super::*;

    const SIZE: Size = Size { width: 40, height: 10 };

    /// A drawing board: the present and the wanted content of the terminal.
    struct Board {
        hand: TerminalState,
        before: Buffer,
        after: Buffer,
    }

    impl Board {
        fn new() -> Board {
            let blank = Buffer::empty(Rect::from((Position::ORIGIN, SIZE)));
            let cursor = Some(Cursor { at: Position::ORIGIN, certain: true });
            Board {
                hand: TerminalState { pen: Some(Pen::PLAIN), cursor },
                before: blank.clone(),
                after: blank,
            }
        }

        fn put(&mut self, x: u16, y: u16, text: &str, color: Color) {
            self.after.set_string(x, y, text, Style::new().fg(color));
        }

        fn draw(&mut self) -> String {
            let (text, hand) = draw(&self.before, &self.after, self.hand);
            self.hand = hand;
            self.before = self.after.clone();
            text
        }
    }

    #[test]
    fn a_short_gap_is_drawn_over_and_a_long_one_jumped() {
        let mut board = Board::new();
        board.put(0, 0, "abcdefghijkl", Color::Reset);
        assert_eq!(board.draw(), "abcdefghijkl");
        board.put(0, 0, "Abcdefghijkl", Color::Reset);
        board.draw();
        board.put(0, 0, "aBcdEfghijkL", Color::Reset);
        // After the A: two changed cells with two unchanged ones between, then six unchanged ones.
        assert_eq!(board.draw(), "\x08aBcdE\x1b[6CL");
    }

    #[test]
    fn what_is_not_printable_is_not_drawn() {
        let mut board = Board::new();
        for (x, symbol) in (0..).zip(["a\u{202e}", "b\u{200d}", "\u{9b}", "c\u{301}"]) {
            board.after[(x, 0)].set_symbol(symbol);
        }
        assert_eq!(board.draw(), "ab c\u{301}");
    }

    #[test]
    fn nothing_is_drawn_over_in_another_colour() {
        let mut board = Board::new();
        board.put(0, 0, "a", Color::Reset);
        board.put(1, 0, "b", Color::Indexed(1));
        board.put(2, 0, "c", Color::Reset);
        board.draw();
        board.put(0, 0, "A", Color::Reset);
        board.put(2, 0, "C", Color::Reset);
        let text = board.draw();
        assert!(text.contains("A\x1b[CC"), "{text:?}");
    }

    #[test]
    fn a_line_down_the_screen_is_one_pen_and_short_moves() {
        let mut board = Board::new();
        for y in 0..5 {
            board.put(10, y, "|", Color::Indexed(6));
            board.put(0, y, "x", Color::Reset);
        }
        let text = board.draw();
        assert_eq!(text.matches('m').count(), 1, "{text:?}");
        assert!(text.contains("|\n\x08|\n\x08|"), "{text:?}");
    }

    #[test]
    fn behind_a_character_of_doubtful_width_no_step_starts_from_its_column() {
        let mut board = Board::new();
        // The width of the circle depends on the terminal.
        board.put(3, 0, "\u{25cb}", Color::Reset);
        board.put(4, 1, "a", Color::Reset);
        board.put(4, 2, "b", Color::Reset);
        assert_eq!(board.draw(), "\x1b[3C\u{25cb}\x1b[2;5Ha\n\x08b");
        board.put(0, 3, "\u{25cb}", Color::Reset);
        board.draw();
        board.put(0, 3, "c", Color::Reset);
        assert_eq!(board.draw(), "\rc");
        // Nor does one along the row, over a blank that stays.
        board.put(20, 5, "\u{25cb}", Color::Reset);
        board.put(25, 5, "d", Color::Reset);
        assert_eq!(board.draw(), "\x1b[6;21H\u{25cb}\r\x1b[25Cd");
    }

    #[test]
    fn at_the_right_margin_the_cursor_is_not_trusted() {
        let mut board = Board::new();
        board.put(39, 0, "a", Color::Reset);
        board.put(39, 1, "b", Color::Reset);
        assert_eq!(board.draw(), "\x1b[39Ca\x1b[2;40Hb");
    }

    #[test]
    fn an_unknown_cursor_is_placed_absolutely() {
        let mut board = Board::new();
        board.hand = TerminalState::default();
        board.put(4, 2, "a", Color::Reset);
        assert_eq!(board.draw(), "\x1b[3;5H\x1b[ma");
    }
}
