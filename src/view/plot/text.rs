//! Texts in a plot: beside points and curves, and in rows; and the cross of the cursor.

#![expect(clippy::cast_possible_truncation, reason = "lengths of short texts count cells")]

use super::Canvas;
use crate::picture::items::Caption;
use crate::picture::role::Role;
use crate::scene::Point;
use crate::view::dots::Covering;
use crate::view::pane;
use crate::words::number::significant;

/// What a text may hide anywhere, the best first.
const FREE: [Covering; 2] = [Covering::Texture, Covering::Guide];

/// Distance from other curves, in rows, from which on a name cannot be taken for theirs.
const CLEAR: i32 = 6;

/// Distance from other curves, in rows, below which a name is rather left out.
const NEAR: i32 = 2;

impl Canvas<'_> {
    /// Writes names beside their curves, each where the others are far away.
    pub fn names(&mut self, names: &[&Caption]) {
        let cells = |name: &&Caption| {
            let points = std::iter::once(&name.at).chain(&name.or_at);
            points.filter_map(|point| self.cell(*point)).collect::<Vec<_>>()
        };
        let all: Vec<_> = names.iter().map(cells).collect();
        for (name, own) in names.iter().zip(&all) {
            let others = names.iter().zip(&all).filter(|(other, _)| other.short != name.short);
            let others: Vec<_> = others.flat_map(|(_, cells)| cells).collect();
            // A column is half as wide as a row is high.
            let distance = |(x, y): &(i32, i32)| {
                let far = others.iter().map(|(a, b)| (y - b).abs().max((x - a).abs() / 2));
                far.min().unwrap_or(CLEAR).min(CLEAR)
            };
            let mut places = own.clone();
            places.sort_by_key(|cell| -distance(cell));
            let clear: Vec<_> =
                places.iter().copied().filter(|cell| distance(cell) >= CLEAR / 2).collect();
            // Where the whole curve runs along others, any place is as good.
            let farthest = places.first().map_or(0, distance).min(NEAR);
            let near: Vec<_> =
                places.into_iter().filter(|cell| distance(cell) >= farthest).collect();
            let tries = [
                (&clear, Covering::Texture),
                (&clear, Covering::Guide),
                (&near, Covering::Texture),
                (&clear, Covering::Curve),
                (&near, Covering::Curve),
            ];
            // What a figure tells in its legend hides no curve.
            let mut tries = tries.into_iter().take(if name.long.is_empty() { 3 } else { 5 });
            let found = tries.find_map(|(cells, over)| self.free(cells, &name.short, over));
            if let Some((column, row)) = found {
                self.letters(column, row, &name.short, name.role);
            }
        }
    }

    fn cell(&self, point: Point) -> Option<(i32, i32)> {
        let (column, row) = self.dots.cell_at(self.place(point))?;
        Some((i32::from(column), i32::from(row)))
    }

    /// Writes one of some texts, the best first, beside a point.
    ///
    /// A text stands where nothing else does; where there is no such place it may hide guides, then
    /// curves, but no other text and no mark. Where there is not even that, or the point is not in the window, it is left out.
    pub fn caption(&mut self, point: Point, texts: &[&str], role: Role) {
        let cells: Vec<_> = self.cell(point).into_iter().collect();
        let mut candidates = texts
            .iter()
            .flat_map(|text| FREE.map(|over| (over, text)))
            .chain(texts.last().map(|text| (Covering::Curve, text)));
        let found =
            candidates.find_map(|(over, text)| Some((self.free(&cells, text, over)?, text)));
        if let Some(((column, row), text)) = found {
            self.letters(column, row, text, role);
        }
    }

    /// Where a text can begin beside one of some cells, hiding no more than this.
    fn free(&self, cells: &[(i32, i32)], text: &str, over: Covering) -> Option<(u16, u16)> {
        let length = i32::try_from(text.chars().count()).ok()?;
        let (width, height) = (i32::from(self.inner.width), i32::from(self.inner.height));
        let middle = -length / 2;
        let beside = [
            (1, 0),
            (-length, 0),
            (1, -1),
            (-length, -1),
            (1, 1),
            (-length, 1),
            (middle, -1),
            (middle, 1),
            (0, -2),
            (0, 2),
        ];
        let cell =
            |column: i32, row: i32| Some((u16::try_from(column).ok()?, u16::try_from(row).ok()?));
        let no_symbol = |(x, y)| self.dots.covering(x, y) != Covering::Symbol;
        let fits = |((x, y), own): &((i32, i32), (i32, i32))| {
            // Two texts never run together; the mark of its own point a text may touch where it hides curves.
            let may_touch = |at: &(i32, i32)| over == Covering::Curve && at == own;
            let apart = [(x - 1, *y), (x + length, *y)].into_iter().filter(|at| !may_touch(at));
            let apart = apart.filter_map(|(column, row)| cell(column, row));
            let within = (0..length).filter_map(|offset| cell(x + offset, *y));
            (0..=width - length).contains(x)
                && (0..height).contains(y)
                && apart.into_iter().all(no_symbol)
                && within.into_iter().all(|(x, y)| self.dots.covering(x, y) <= over)
        };
        let places = cells
            .iter()
            .flat_map(|own| beside.iter().map(move |(x, y)| ((own.0 + x, own.1 + y), *own)));
        let ((column, row), _) = places.into_iter().find(fits)?;
        cell(column, row)
    }

    /// Writes a text from the left end of the row in which a height lies.
    pub fn write(&mut self, y: f64, text: &str, role: Role) {
        let left = Point { x: self.window.x.from(), y };
        if let Some((_, row)) = self.dots.cell_at(self.place(left)) {
            let text = pane::cut(text, self.inner.width.into(), self.look);
            self.letters(0, row, &text, role);
        }
    }

    /// Writes a number beside the line `x = 0`, with as many of the digits as there is room for.
    pub fn beside_zero(&mut self, y: f64, value: f64, digits: usize, right: bool) {
        let Some((column, row)) = self.dots.cell_at(self.place(Point { x: 0.0, y })) else {
            return;
        };
        let room = if right { self.inner.width.saturating_sub(column + 2) } else { column };
        let texts = (1..=digits).rev().map(|digits| significant(value, digits));
        let fits = |text: &String| text.len() <= usize::from(room);
        let Some(text) = texts.into_iter().find(fits) else { return };
        let start = if right { column + 2 } else { column.saturating_sub(text.len() as u16 + 1) };
        self.letters(start, row, &text, Role::Text);
    }

    fn letters(&mut self, start: u16, row: u16, text: &str, role: Role) {
        for (column, letter) in (start..self.inner.width).zip(text.chars()) {
            self.dots.symbol(column, row, letter, role);
        }
    }

    pub fn cross(&mut self, point: Point) {
        let [centre, level, upright] = self.look.symbols().cross;
        let Some((column, row)) = self.dots.cell_at(self.place(point)) else { return };
        let arms = [
            (column.checked_sub(2), Some(row), level),
            (column.checked_sub(1), Some(row), level),
            (Some(column + 1), Some(row), level),
            (Some(column + 2), Some(row), level),
            (Some(column), row.checked_sub(1), upright),
            (Some(column), Some(row + 1), upright),
            (Some(column), Some(row), centre),
        ];
        for (column, row, symbol) in arms {
            if let (Some(column), Some(row)) = (column, row) {
                // Above and below it hides no letter: a number without its sign is another number.
                let hides = self.dots.covering(column, row) == Covering::Symbol;
                if symbol != upright || !hides {
                    self.dots.symbol(column, row, symbol, Role::Cursor);
                }
            }
        }
    }
}
