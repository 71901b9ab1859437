//! A raster finer than the cells of the terminal: strokes with dashes, sparse textures and symbols.
//!
//! Each cell shows one thing in one colour, which keeps the stream of bytes short: a symbol hides
//! curves, curves (solid or dashed, also in the gaps of their dashes) hide guides (with dots), and guides
//! hide texture. Where curves share a cell the dots of both are shown in the colour of the later one; a thick
//! line, which stands for an area, leaves the colour to the curve. Coordinates
//! count dots from the top left corner; lines are clipped in floating point before they become dots, and what is not
//! finite is not drawn.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are clipped to the raster before they count dots"
)]

use ratatui::layout::Rect;
use ratatui::symbols::braille::BRAILLE;
use ratatui::symbols::pixel::{OCTANTS, QUADRANTS};

use super::{Look, Surface};
use crate::picture::{Dash, Role};
use crate::session::Glyphs;

/// What a curve is drawn with.
#[derive(Clone, Copy, Debug)]
pub struct DotPen {
    pub role: Role,
    pub dash: Dash,
}

/// The dots of a wide line around each dot of a line.
const BRUSH: [(i32, i32); 4] = [(0, 0), (1, 0), (0, 1), (1, 1)];

/// Rows of a raster that has room for wide lines; where there are fewer, a screen that fills a wall has large dots.
const ROOM: u16 = 16;

/// A point in dots from the top left corner.
type DotPoint = (f64, f64);

/// Column and row of a cell, which need not lie on the raster.
pub type DotPlace = (i32, i32);

/// What a cell shows, as far as a text that would stand there is concerned; each hides less than the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Covering {
    Texture,
    Guide,
    Curve,
    /// A letter or a mark.
    Symbol,
    /// The cell is not on the raster.
    Outside,
}

/// A cell: dots, where it has no symbol.
#[derive(Clone, Copy, Debug)]
struct DotCell {
    covering: Covering,
    role: Role,
    dots: u8,
    symbol: Option<char>,
}

#[derive(Clone, Debug)]
pub struct Dots {
    area: Rect,
    glyphs: Glyphs,
    /// Whether lines are twice as wide.
    wide: bool,
    cells: Vec<DotCell>,
}

impl Dots {
    /// An empty raster over `area`, for curves as wide as a look has them.
    pub fn of(area: Rect, look: &Look) -> Self {
        let wide = look.wide && look.glyphs != Glyphs::Ascii && area.height >= ROOM;
        Dots { wide, ..Dots::new(area, look.glyphs) }
    }

    /// An empty raster over `area`.
    pub fn new(area: Rect, glyphs: Glyphs) -> Self {
        let cells = usize::from(area.width) * usize::from(area.height);
        let empty =
            DotCell { covering: Covering::Texture, role: Role::Text, dots: 0, symbol: None };
        Dots { area, glyphs, wide: false, cells: vec![empty; cells] }
    }

    pub fn size(&self) -> DotPoint {
        let ((across, down), Rect { width, height, .. }) = (self.glyphs.dots(), self.area);
        (f64::from(width) * f64::from(across), f64::from(height) * f64::from(down))
    }

    /// The cell (column, row) in which a point lies, if it lies on the raster.
    pub fn cell_at(&self, (x, y): DotPoint) -> Option<DotPlace> {
        let (width, height) = self.size();
        let (across, down) = self.glyphs.dots();
        let inside = (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
        let column = ((x / f64::from(across)) as i32).min(i32::from(self.area.width) - 1);
        let row = ((y / f64::from(down)) as i32).min(i32::from(self.area.height) - 1);
        (inside && !self.area.is_empty()).then_some((column, row))
    }

    /// Draws a polyline; a point that is not finite interrupts it.
    pub fn stroke(&mut self, points: impl IntoIterator<Item = DotPoint>, pen: DotPen) {
        if pen.dash != Dash::Thick || self.glyphs == Glyphs::Ascii {
            return self.line(points, pen);
        }
        // Both dots of a thick one stand in the cell that the line is in, as a mark on it does.
        let (height, down) = (self.size().1, f64::from(self.glyphs.dots().1));
        let inside = |y: f64| {
            if !(0.0..=height).contains(&y) {
                return y;
            }
            let top = (y.min(height - 1.0) / down).floor() * down;
            y.clamp(top + 0.5, top + down - 1.0)
        };
        let points: Vec<DotPoint> = points.into_iter().map(|(x, y)| (x, inside(y))).collect();
        for offset in [-0.5, 0.5] {
            self.line(points.iter().map(|(x, y)| (*x, y + offset)), pen);
        }
    }

    fn line(&mut self, points: impl IntoIterator<Item = DotPoint>, pen: DotPen) {
        let (mut run, mut drawn) = (Vec::new(), 0);
        let mut previous: Option<DotPoint> = None;
        let size = self.size();
        for point in points {
            if !(point.0.is_finite() && point.1.is_finite()) {
                self.ink_run(&mut run, &mut drawn, pen);
                previous = None;
                continue;
            }
            let segment = clip(previous.unwrap_or(point), point, size);
            if let Some(((x0, y0), (x1, y1), _)) = segment {
                let steps = (x1 - x0).abs().max((y1 - y0).abs()).ceil().max(1.0);
                for index in 0..=steps as u32 {
                    let along = f64::from(index) / steps;
                    let (x, y) = (x0 + (x1 - x0) * along, y0 + (y1 - y0) * along);
                    extend(&mut run, (x as i32, y as i32));
                }
            }
            if segment.is_none_or(|(.., unclipped)| !unclipped) {
                self.ink_run(&mut run, &mut drawn, pen);
            }
            previous = Some(point);
        }
        self.ink_run(&mut run, &mut drawn, pen);
    }

    /// Draws a run of dots; dashes go on after those `drawn` before.
    fn ink_run(&mut self, run: &mut Vec<(i32, i32)>, drawn: &mut u32, pen: DotPen) {
        let (pattern, period) = self.glyphs.dash(pen.dash);
        // Axes stay as they are, so that they differ from curves the more.
        let wide = self.wide && pen.role != Role::Axis;
        let brush = if wide { &BRUSH[..] } else { &BRUSH[..1] };
        // A pattern of wide dots is twice as long.
        let times = if wide { 2 } else { 1 };
        for (x, y) in run.drain(..) {
            let on = (pattern >> (*drawn / times % period)) & 1 == 1;
            for (across, down) in brush {
                self.ink((x + across, y + down), pen, on);
            }
            *drawn += 1;
        }
    }

    /// Draws a dot, or the gap of a dash.
    fn ink(&mut self, (x, y): (i32, i32), DotPen { role, dash }: DotPen, on: bool) {
        let (across, down) = self.glyphs.dots();
        let bit = 1_u8 << (y.rem_euclid(down) * across + x.rem_euclid(across));
        let bit = if on { bit } else { 0 };
        let place = (x.div_euclid(across), y.div_euclid(down));
        let Some(cell) = self.at(place) else { return };
        let guide = matches!(dash, Dash::DashDot | Dash::Dotted | Dash::Sparse);
        let covering = if guide { Covering::Guide } else { Covering::Curve };
        if cell.covering > covering || (guide && !on) {
            return;
        }
        let before = if cell.covering == covering { cell.dots } else { 0 };
        let keeps_role = before != 0 && !guide && (!on || dash == Dash::Thick);
        let role = if keeps_role { cell.role } else { role };
        *cell = DotCell { covering, role, dots: before | bit, symbol: None };
    }

    /// Puts texture into a cell, if nothing else is there.
    pub fn texture(&mut self, place: DotPlace, symbol: char, role: Role) {
        if self.covering(place) == Covering::Texture {
            self.put(place, Covering::Texture, symbol, role);
        }
    }

    /// Puts a symbol into a cell, over everything else.
    pub fn symbol(&mut self, place: DotPlace, symbol: char, role: Role) {
        self.put(place, Covering::Symbol, symbol, role);
    }

    fn put(&mut self, place: DotPlace, covering: Covering, symbol: char, role: Role) {
        if let Some(cell) = self.at(place) {
            *cell = DotCell { covering, role, dots: 0, symbol: Some(symbol) };
        }
    }

    pub fn covering(&self, place: DotPlace) -> Covering {
        let cell = self.index(place).and_then(|index| self.cells.get(index));
        cell.map_or(Covering::Outside, |cell| cell.covering)
    }

    fn index(&self, (column, row): DotPlace) -> Option<usize> {
        let width = i32::from(self.area.width);
        let on_a_row = (0..width).contains(&column);
        usize::try_from(row * width + column).ok().filter(|_| on_a_row)
    }

    fn at(&mut self, place: DotPlace) -> Option<&mut DotCell> {
        self.index(place).and_then(|index| self.cells.get_mut(index))
    }

    /// Writes the raster into the buffer; empty cells leave what is there.
    pub fn paint(&self, Surface { look, buffer }: &mut Surface) {
        for (position, content) in self.area.positions().zip(&self.cells) {
            let DotCell { role, dots, symbol, .. } = *content;
            let symbol = match (symbol, dots) {
                (None, 0) => continue,
                (None, dots) => self.glyphs.draw(dots, look.letter(role)),
                (Some(symbol), _) => symbol,
            };
            if let Some(cell) = buffer.cell_mut(position) {
                cell.set_char(symbol).set_style(look.style(role));
            }
        }
    }
}

/// Adds a dot to a run. A dot that would only make a corner between its neighbours is left out, so that curves stay
/// one dot wide.
fn extend(run: &mut Vec<(i32, i32)>, dot: (i32, i32)) {
    match run[..] {
        [.., last] if last == dot => {}
        [.., before, _] if (dot.0 - before.0).abs() == 1 && (dot.1 - before.1).abs() == 1 => {
            run.pop();
            run.push(dot);
        }
        _ => run.push(dot),
    }
}

impl Glyphs {
    /// Dots of one cell, across and down.
    pub fn dots(self) -> (i32, i32) {
        match self {
            Glyphs::Auto | Glyphs::Braille | Glyphs::Octant => (2, 4),
            Glyphs::Block => (2, 2),
            Glyphs::Ascii => (1, 1),
        }
    }

    /// A bit for each dot, the first last, and how many until they repeat.
    fn dash(self, dash: Dash) -> (u32, u32) {
        let coarse = matches!(self, Glyphs::Ascii);
        match dash {
            Dash::Solid | Dash::Thick => (0b1, 1),
            Dash::Dashed if coarse => (0b011, 3),
            Dash::Dashed => (0b00_1111, 6),
            Dash::DashDot if coarse => (0b0_1011, 5),
            Dash::DashDot => (0b01_0111, 6),
            Dash::Dotted => (0b01, 2),
            Dash::Sparse if coarse => (0b001, 3),
            Dash::Sparse => (0b0001, 4),
        }
    }

    /// The character that shows these dots, bit by bit from the top left, row by row.
    fn draw(self, bits: u8, letter: char) -> char {
        match self {
            Glyphs::Auto | Glyphs::Braille => BRAILLE[usize::from(bits)],
            Glyphs::Octant => OCTANTS[usize::from(bits)],
            Glyphs::Block => QUADRANTS[usize::from(bits & 0b1111)],
            Glyphs::Ascii => letter,
        }
    }
}

/// The part of a segment that lies on a raster of this size, by Liang and Barsky: its two ends, drawn back
/// from the far borders so that they are on dots, and whether the second is the segment's own.
fn clip(start: DotPoint, end: DotPoint, size: DotPoint) -> Option<(DotPoint, DotPoint, bool)> {
    const SHORT: f64 = 1e-6;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let limits = (size.0 - SHORT, size.1 - SHORT);
    for (from, to, limit) in [(start.0, end.0, size.0), (start.1, end.1, size.1)] {
        let run = to - from;
        if run == 0.0 {
            if !(0.0..=limit).contains(&from) {
                return None;
            }
            continue;
        }
        let (at_zero, at_limit) = (-from / run, (limit - from) / run);
        enter = enter.max(at_zero.min(at_limit));
        leave = leave.min(at_zero.max(at_limit));
    }
    let point = |along: f64| {
        let (x, y) = (start.0 + (end.0 - start.0) * along, start.1 + (end.1 - start.1) * along);
        (x.clamp(0.0, limits.0), y.clamp(0.0, limits.1))
    };
    // Runs beyond the range of floating point make no visible line.
    let finite = (end.0 - start.0).is_finite() && (end.1 - start.1).is_finite();
    let visible = finite && enter <= leave && limits.0 > 0.0 && limits.1 > 0.0;
    visible.then(|| (point(enter), point(leave), leave >= 1.0))
}

#[cfg(test)]
mod tests;
