//! Texts in a plot: beside points and curves, and in rows; and the cross of the cursor.

use super::Canvas;
use crate::picture::{Caption, Role, along};
use crate::scene::Point;
use crate::view::dots::{Covering, DotPlace};
use crate::view::pane;
use crate::words::fitting;

/// Plots at least this wide have the long form of captions.
const WIDE: u16 = 36;

/// What a text may hide anywhere, the best first.
const FREE: [Covering; 2] = [Covering::Texture, Covering::Guide];

/// Distance from other curves, in rows, from which on a name cannot be taken for theirs.
const CLEAR: i32 = 3;

/// Distance from other curves, in rows, below which a name touches them.
const NEAR: i32 = 1;

/// Cells that a text takes.
fn length(text: &str) -> i32 {
    i32::try_from(text.chars().count()).unwrap_or(i32::MAX)
}

/// How far a text that begins in a cell is from some others, in rows; a column is half as wide as a row is high.
fn far_from(others: &[DotPlace], (first, row): DotPlace, text: &str) -> i32 {
    let last = first + length(text) - 1;
    let distance = |(x, y): &DotPlace| {
        // Beside each other, one free column is no distance.
        let aside = (first - x).max(x - last).max(1) - 1;
        (row - y).abs().max(aside / 2)
    };
    others.iter().map(distance).min().unwrap_or(i32::MAX)
}

impl Canvas<'_> {
    /// Writes names beside their curves, each where the other `curves` are farther away than its own.
    pub fn names(&mut self, names: &[&Caption], curves: &[&[Point]]) {
        let cells: Vec<_> = curves.iter().map(|curve| self.cells_of(curve)).collect();
        for name in names {
            let points = || std::iter::once(&name.at).chain(&name.or_at);
            let own: Vec<_> = points().filter_map(|point| self.cell(*point)).collect();
            let is_other = |curve: &[Point]| !points().any(|point| curve.contains(point));
            let others = curves.iter().zip(&cells).filter(|(curve, _)| is_other(curve));
            let others: Vec<_> = others.flat_map(|(_, cells)| cells).copied().collect();
            let tries = [
                (Covering::Texture, CLEAR),
                (Covering::Guide, CLEAR),
                (Covering::Texture, NEAR),
                (Covering::Curve, NEAR),
                // Where the whole curve runs along others, any place is as good.
                (Covering::Curve, 0),
            ];
            // What a figure tells in its legend hides no curve.
            let mut tries = tries.into_iter().take(if name.long.is_empty() { 3 } else { 5 });
            let found = tries.find_map(|(over, far)| {
                let clearance = |place| far_from(&others, place, &name.short).min(CLEAR);
                let all = self.places(&own, &name.short, over).map(|at| (clearance(at), at));
                let is_own = |clear, at| clear > far_from(&own, at, &name.short);
                let far =
                    all.filter(|(clear, at)| far == 0 || (*clear >= far && is_own(*clear, *at)));
                far.reduce(|best, next| if next.0 > best.0 { next } else { best })
            });
            if let Some((_, at)) = found {
                self.letters(at, &name.short, name.role);
            }
        }
    }

    /// The cells that a curve runs through.
    fn cells_of(&self, curve: &[Point]) -> Vec<DotPlace> {
        let places: Vec<_> = curve.iter().map(|point| self.place(*point)).collect();
        let mut cells = Vec::new();
        for ends in places.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let [first, last] = [from, to].map(|at| self.dots.cell_at(at));
            if first.is_some() && first == last {
                cells.extend(first);
            } else {
                cells.extend(along(from, to, 2.0).filter_map(|at| self.dots.cell_at(at)));
            }
        }
        cells.dedup();
        cells
    }

    /// Writes a caption beside its point.
    ///
    /// A text stands where nothing else does; where there is no such place it may hide guides, then
    /// curves, but no other text and no mark. Where there is not even that, or the point is not in the window, it is left out.
    pub fn caption(&mut self, Caption { at, long, short, role, .. }: &Caption) {
        let cells: Vec<_> = self.cell(*at).into_iter().collect();
        let texts = [long, short].into_iter().skip(usize::from(self.inner.width < WIDE));
        let mut candidates =
            texts.flat_map(|text| FREE.map(|over| (over, text))).chain([(Covering::Curve, short)]);
        let found = candidates
            .find_map(|(over, text)| Some((self.places(&cells, text, over).next()?, text)));
        if let Some((at, text)) = found {
            self.letters(at, text, *role);
        }
    }

    /// Where a text can begin beside one of some cells, hiding no more than this, the best first.
    fn places(
        &self,
        cells: &[DotPlace],
        text: &str,
        over: Covering,
    ) -> impl Iterator<Item = DotPlace> {
        let length = length(text);
        let (width, height) = (i32::from(self.inner.width), i32::from(self.inner.height));
        let middle = -length / 2;
        let aside = [0, -1, 1].into_iter().flat_map(move |row| [(1, row), (-length, row)]);
        let beside = aside.chain([(middle, -1), (middle, 1), (0, -2), (0, 2)]);
        let no_symbol = move |at| self.dots.covering(at) != Covering::Symbol;
        let fits = move |((x, y), own): &(DotPlace, DotPlace)| {
            // Two texts never run together; the mark of its own point a text may touch where it hides curves.
            let may_touch = |at: &DotPlace| over == Covering::Curve && at == own;
            let mut apart = [(x - 1, *y), (x + length, *y)].into_iter().filter(|at| !may_touch(at));
            (0..=width - length).contains(x)
                && (0..height).contains(y)
                && apart.all(no_symbol)
                && (0..length).all(|offset| self.dots.covering((x + offset, *y)) <= over)
        };
        let places = cells
            .iter()
            .flat_map(move |own| beside.clone().map(|(x, y)| ((own.0 + x, own.1 + y), *own)));
        places.filter(fits).map(|(at, _)| at)
    }

    /// Writes a text from the left end of the row in which a height lies.
    pub fn write(&mut self, y: f64, text: &str, role: Role) {
        let left = Point { x: self.window.x.from(), y };
        if let Some((_, row)) = self.cell(left) {
            let text = pane::cut(text, self.inner.width.into(), self.look);
            self.letters((0, row), &text, role);
        }
    }

    /// Writes a number beside the line `x = 0`, with as many of the digits as there is room for.
    pub fn beside_zero(&mut self, y: f64, value: f64, digits: usize, right: bool) {
        let Some((column, row)) = self.cell(Point { x: 0.0, y }) else { return };
        let room = if right {
            i32::from(self.inner.width) - column - 2
        } else {
            column
        };
        let text = usize::try_from(room).ok().and_then(|room| fitting(value, digits, room));
        let Some(text) = text else { return };
        let start = if right {
            column + 2
        } else {
            (column - length(&text) - 1).max(0)
        };
        self.letters((start, row), &text, Role::Text);
    }

    fn letters(&mut self, (start, row): DotPlace, text: &str, role: Role) {
        for (column, letter) in (start..self.inner.width.into()).zip(text.chars()) {
            self.dots.symbol((column, row), letter, role);
        }
    }

    pub fn cross(&mut self, point: Point) {
        let [centre, level, upright] = self.look.symbols().cross;
        let Some((column, row)) = self.cell(point) else { return };
        let along = [-2, -1, 1, 2].map(|right| (right, 0, level));
        let arms = along.into_iter().chain([(0, -1, upright), (0, 1, upright), (0, 0, centre)]);
        for (right, down, symbol) in arms {
            let place = (column + right, row + down);
            // Above and below it hides no letter: a number without its sign is another number.
            if symbol != upright || self.dots.covering(place) != Covering::Symbol {
                self.dots.symbol(place, symbol, Role::Cursor);
            }
        }
    }
}
