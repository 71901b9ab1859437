//! A plot: title line, axes with ticks, and a raster that takes points of the world.
//!
//! This is the one gate between numbers and cells. World coordinates may be anything, also infinite
//! or not a number; what cannot be shown is left out.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "fractions of the screen count cells"
)]

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use super::dots::{Dash, Dots, Pen};
use super::look::{Look, Role};
use super::number::{resolved, significant};
use super::pane;
use super::ticks::{Tick, Ticks};
use crate::scene::{Point, Span, Window};
use crate::session::settings::Glyphs;

/// Smallest area in which axes stand outside the picture; below it labels lie inside.
const ROOMY: (u16, u16) = (22, 9);

/// Fewest columns of the labels at the left, so that the picture does not jump when they change.
const GUTTER: u16 = 5;

/// What a plot is called.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// The plot.
    pub title: &'a str,
    /// Its horizontal axis.
    pub x: &'a str,
    /// Its vertical axis; empty where heights mean nothing.
    pub y: &'a str,
}

/// The coordinates of a point, to the digits that can be told apart in a window.
#[must_use]
pub fn reading(point: Point, window: Window) -> (String, String) {
    (resolved(point.x, window.x.width() / CELLS), resolved(point.y, window.y.width() / CELLS))
}

/// Cells of a large plot: what a cursor can tell apart.
pub(super) const CELLS: f64 = 200.0;

/// Where the parts of a plot stand, and the ticks that there is room for.
struct Geometry {
    /// The cells between the axes.
    inner: Rect,
    /// Whether the axes stand outside of them.
    roomy: bool,
    rightward: Ticks,
    upward: Ticks,
}

impl Geometry {
    fn of(area: Rect, window: Window, upward: Option<Ticks>) -> Self {
        let body = Rect { y: area.y + 1, height: area.height.saturating_sub(1), ..area };
        let roomy = body.width >= ROOMY.0 && body.height >= ROOMY.1;
        let rows = rows(area);
        let most = usize::from(rows / 3).clamp(2, 9);
        let upward =
            upward.unwrap_or_else(|| Ticks::fitting(window.y, |ticks| ticks.len() <= most));
        let widest = upward.ticks.iter().map(|tick| tick.label.len()).max().unwrap_or(0) as u16;
        let gutter = if roomy { (widest + 1).max(GUTTER) } else { 0 };
        let inner = Rect {
            x: body.x + gutter,
            width: body.width.saturating_sub(gutter),
            height: rows,
            ..body
        };
        let spaced = |gap| Ticks::fitting(window.x, |ticks| apart(ticks, inner.width, gap));
        // Two ticks make a scale: rather closer together than only one.
        let rightward = Some(spaced(3)).filter(|ticks| ticks.ticks.len() > 1).unwrap_or(spaced(1));
        Geometry { inner, roomy, rightward, upward }
    }
}

/// Rows of the raster of a plot in `area`.
#[must_use]
pub fn rows(area: Rect) -> u16 {
    let height = area.height.saturating_sub(1);
    let roomy = area.width >= ROOMY.0 && height >= ROOMY.1;
    if roomy { height - 2 } else { height }
}

/// The point of a plot in `area` that a cell stands for, to the digits that cells tell apart; `None`
/// for the cells outside of its axes. `upward` are the marks of its vertical axis if those are no round
/// numbers.
#[must_use]
pub fn point_at(
    area: Rect,
    window: Window,
    upward: Option<Ticks>,
    cell: Position,
) -> Option<Point> {
    let Geometry { inner, .. } = Geometry::of(area, window, upward);
    if !inner.contains(cell) {
        return None;
    }
    let fraction = |cell: u16, cells: u16| (f64::from(cell) + 0.5) / f64::from(cells);
    let right = fraction(cell.x - inner.x, inner.width);
    let down = fraction(cell.y - inner.y, inner.height);
    let rounded = |span: Span, fraction, cells: u16| {
        resolved(span.at(fraction), span.width() / f64::from(cells)).parse().ok()
    };
    Some(Point {
        x: rounded(window.x, right, inner.width)?,
        y: rounded(window.y, 1.0 - down, inner.height)?,
    })
}

/// A plot being drawn.
#[derive(Debug)]
pub struct Plot<'a> {
    look: &'a Look,
    window: Window,
    inner: Rect,
    dots: Dots,
    inside: Option<(Ticks, Ticks)>,
}

impl<'a> Plot<'a> {
    /// Writes title and axes into `area`, and gives the raster between them.
    pub fn new(
        area: Rect,
        window: Window,
        names: Names,
        heading: &pane::Heading,
        look: &'a Look,
        buffer: &mut Buffer,
    ) -> Self {
        Self::with_ticks(area, window, names, heading, look, buffer, None)
    }

    /// The same with these marks on the vertical axis in place of round numbers.
    pub fn with_ticks(
        area: Rect,
        window: Window,
        names: Names,
        heading: &pane::Heading,
        look: &'a Look,
        buffer: &mut Buffer,
        upward: Option<Ticks>,
    ) -> Self {
        let Geometry { inner, roomy, rightward, mut upward } = Geometry::of(area, window, upward);
        let (x, y) = (named(names.x, &rightward), named(names.y, &upward));
        let axes = if names.y.is_empty() {
            // Heights without meaning have no scale.
            upward.ticks.clear();
            x
        } else {
            format!("{y} over {x}")
        };
        pane::title(area, names.title, &axes, heading, look, buffer);
        let dots = Dots::new(inner, look.glyphs);
        let mut plot = Plot { look, window, inner, dots, inside: None };
        if roomy {
            plot.axes(&rightward, &upward, buffer);
        } else {
            plot.inside = Some((rightward, upward));
        }
        plot
    }

    /// The cells between the axes.
    #[must_use]
    pub fn inner(&self) -> Rect {
        self.inner
    }

    fn axes(&self, rightward: &Ticks, upward: &Ticks, buffer: &mut Buffer) {
        let style = self.look.style(Role::Axis);
        let [line, notch, corner, rule, stub] = self.look.symbols().axis;
        let Rect { x, y, width, height } = self.inner;
        let (left, bottom) = (x - 1, y + height);
        for row in y..bottom {
            buffer.set_string(left, row, line, style);
        }
        buffer.set_string(left, bottom, corner, style);
        buffer.set_string(x, bottom, rule.repeat(width.into()), style);
        for tick in &upward.ticks {
            let row = y + self.row(tick.fraction);
            let start = left.saturating_sub(tick.label.len() as u16);
            buffer.set_string(start, row, &tick.label, style);
            buffer.set_string(left, row, notch, style);
        }
        for tick in &rightward.ticks {
            let column = column(tick.fraction, width);
            buffer.set_string(x + column, bottom, stub, style);
            buffer.set_string(x + centred(tick, width), bottom + 1, &tick.label, style);
        }
    }

    /// Labels over the edge of the picture, where there is no room beside it.
    fn labels_inside(&self, rightward: &Ticks, upward: &Ticks, buffer: &mut Buffer) {
        let style = self.look.style(Role::Axis);
        let Rect { x, y, width, height } = self.inner;
        let Some(last) = height.checked_sub(1) else { return };
        let fits = |tick: &&Tick| tick.label.len() < usize::from(width);
        for tick in upward.ticks.iter().filter(fits) {
            let row = self.row(tick.fraction);
            if row < last {
                buffer.set_string(x, y + row, &tick.label, style);
            }
        }
        for tick in rightward.ticks.iter().filter(fits) {
            buffer.set_string(x + centred(tick, width), y + last, &tick.label, style);
        }
    }

    fn row(&self, fraction: f64) -> u16 {
        column(1.0 - fraction, self.inner.height)
    }

    fn place(&self, point: Point) -> (f64, f64) {
        let (width, height) = self.dots.size();
        let Window { x, y } = self.window;
        (x.fraction(point.x) * width, (1.0 - y.fraction(point.y)) * height)
    }

    /// The world at the middle of a cell.
    #[must_use]
    pub fn world(&self, column: u16, row: u16) -> Point {
        let fraction = |cell: u16, cells: u16| (f64::from(cell) + 0.5) / f64::from(cells.max(1));
        Point {
            x: self.window.x.at(fraction(column, self.inner.width)),
            y: self.window.y.at(1.0 - fraction(row, self.inner.height)),
        }
    }

    /// Draws a polyline.
    pub fn curve(&mut self, points: impl IntoIterator<Item = Point>, role: Role, dash: Dash) {
        let placed: Vec<_> = points.into_iter().map(|point| self.place(point)).collect();
        self.dots.stroke(placed, Pen { role, dash });
    }

    /// Draws `y(x)`, sampled once for each dot across; where there is no value there is no line.
    pub fn function(&mut self, role: Role, dash: Dash, value: impl Fn(f64) -> Option<f64>) {
        let across = self.dots.size().0 as u32;
        let x = self.window.x;
        let points: Vec<Point> = (0..=across)
            .map(|dot| x.at(f64::from(dot) / f64::from(across.max(1))))
            .map(|x| Point { x, y: value(x).unwrap_or(f64::NAN) })
            .collect();
        self.curve(points, role, dash);
    }

    /// Draws an upright through the whole window.
    pub fn upright(&mut self, x: f64, role: Role, dash: Dash) {
        let Window { y, .. } = self.window;
        self.curve([y.from(), y.to()].map(|y| Point { x, y }), role, dash);
    }

    /// Draws a straight line two dots thick, or one letter.
    pub fn bar(&mut self, from: Point, to: Point, role: Role) {
        let offsets: &[f64] = if self.look.glyphs == Glyphs::Ascii { &[0.0] } else { &[-0.5, 0.5] };
        for offset in offsets {
            let ends = [from, to].map(|end| {
                let (x, y) = self.place(end);
                (x, y + offset)
            });
            self.dots.stroke(ends, Pen { role, dash: Dash::Solid });
        }
    }

    /// Shades the cells that `curve` does not separate from the origin.
    ///
    /// The curve may be closed, or open with ends outside the window.
    pub fn shade(&mut self, curve: &[Point], role: Role) {
        let symbol = self.look.symbols().shade;
        let Rect { width, height, .. } = self.inner;
        let climbed = crossings(curve, |point| point.x, |point| point.y);
        for row in 0..height {
            let y = self.world(0, row).y;
            let walls = crossings(curve, |point| point.y - y, |point| point.x);
            let between = |a: f64, b: f64, value: f64| a.min(b) < value && value < a.max(b);
            let climbs = climbed.iter().filter(|wall| between(0.0, y, **wall)).count();
            for column in 0..width {
                let x = self.world(column, row).x;
                let walks = walls.iter().filter(|wall| between(0.0, x, **wall)).count();
                if (climbs + walks) % 2 == 0 {
                    // The blanks belong to the texture: to write them is shorter than to skip them.
                    let symbol = if (column + row) % 2 == 0 { symbol } else { ' ' };
                    self.dots.texture(column, row, symbol, role);
                }
            }
        }
    }

    /// Shades the cells whose middle lies in a part of the world.
    pub fn shade_where(&mut self, role: Role, inside: impl Fn(Point) -> bool) {
        let symbol = self.look.symbols().shade;
        let Rect { width, height, .. } = self.inner;
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column)))
        {
            if inside(self.world(column, row)) {
                let symbol = if (column + row) % 2 == 0 { symbol } else { ' ' };
                self.dots.texture(column, row, symbol, role);
            }
        }
    }

    /// Puts a texture on the cells of parts of the world; blanks leave what is there.
    pub fn texture_where(&mut self, texture: impl Fn(Point) -> Option<(char, Role)>) {
        let Rect { width, height, .. } = self.inner;
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column)))
        {
            // Every other cell of every other line, so that borders and names can be read.
            if (column + 2 * row) % 4 == 0
                && let Some((symbol, role)) = texture(self.world(column, row))
            {
                self.dots.texture(column, row, symbol, role);
            }
        }
    }

    /// Puts arrows on a sparse lattice of cells, in the direction that `flow` gives there.
    pub fn arrows(&mut self, role: Role, flow: impl Fn(Point) -> Point) {
        let arrows = self.look.symbols().arrows;
        let Rect { width, height, .. } = self.inner;
        let (dots_across, dots_down) = self.dots.size();
        let (across, down) =
            (dots_across / self.window.x.width(), dots_down / self.window.y.width());
        for row in (1..height).step_by(3) {
            for column in (3..width).step_by(6) {
                let direction = flow(self.world(column, row));
                let angle = (direction.y * down).atan2(direction.x * across);
                if angle.is_finite() {
                    let eighth = (angle / std::f64::consts::FRAC_PI_4).round().rem_euclid(8.0);
                    self.dots.texture(column, row, arrows[eighth as usize % 8], role);
                }
            }
        }
    }

    /// Puts a symbol on a point, if it is in the window.
    pub fn mark(&mut self, point: Point, symbol: char, role: Role) {
        if let Some((column, row)) = self.dots.cell_at(self.place(point)) {
            self.dots.symbol(column, row, symbol, role);
        }
    }

    /// Writes a text beside a point, where it hides least.
    pub fn caption(&mut self, point: Point, text: &str, role: Role) {
        let Some((column, row)) = self.dots.cell_at(self.place(point)) else { return };
        let (column, row) = (i32::from(column), i32::from(row));
        let length = text.chars().count() as i32;
        let width = i32::from(self.inner.width);
        let places =
            [(1, 0), (-length, 0), (1, -1), (-length, -1), (1, 1), (-length, 1), (0, -2), (0, 2)];
        let inside = |(x, y): &(i32, i32)| {
            *x >= 0 && x + length <= width && (0..i32::from(self.inner.height)).contains(y)
        };
        let free = |(x, y): &(i32, i32)| {
            (0..length).all(|offset| self.dots.is_free((x + offset) as u16, *y as u16))
        };
        let candidates = || places.iter().map(|(x, y)| (column + x, row + y)).filter(inside);
        let Some((x, y)) = candidates().find(free).or_else(|| candidates().next()) else { return };
        for (offset, letter) in (0..).zip(text.chars()) {
            self.dots.symbol((x + offset) as u16, y as u16, letter, role);
        }
    }

    /// Writes a text from the left end of the row in which a height lies.
    pub fn write(&mut self, y: f64, text: &str, role: Role) {
        let left = Point { x: self.window.x.from(), y };
        if let Some((_, row)) = self.dots.cell_at(self.place(left)) {
            self.letters(0, row, text, role);
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

    /// Draws a level bar half a cell thick.
    pub fn thick(&mut self, from: Point, to: Point, role: Role) {
        let offsets: &[f64] = if self.look.glyphs == Glyphs::Ascii { &[0.0] } else { &[-0.5, 0.5] };
        for offset in offsets {
            let ends = [from, to].map(|end| {
                let (x, y) = self.place(end);
                (x, y + offset)
            });
            self.dots.stroke(ends, Pen { role, dash: Dash::Solid });
        }
    }

    /// Draws the cross of the cursor.
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
                self.dots.symbol(column, row, symbol, Role::Cursor);
            }
        }
    }

    /// Puts the picture on the screen.
    pub fn finish(self, buffer: &mut Buffer) {
        self.dots.paint(buffer, self.look);
        if let Some((rightward, upward)) = &self.inside {
            self.labels_inside(rightward, upward, buffer);
        }
    }
}

/// Where a polyline crosses the line `height = 0`, measured by `place`.
fn crossings(
    curve: &[Point],
    height: impl Fn(Point) -> f64,
    place: impl Fn(Point) -> f64,
) -> Vec<f64> {
    let crossing = |pair: &[Point]| {
        let (before, after) = (height(pair[0]), height(pair[1]));
        ((before < 0.0) != (after < 0.0)).then(|| {
            let along = before / (before - after);
            place(pair[0]) + (place(pair[1]) - place(pair[0])) * along
        })
    };
    curve.windows(2).filter_map(crossing).collect()
}

/// The cell in which a fraction of the axis lies.
fn column(fraction: f64, cells: u16) -> u16 {
    ((fraction * f64::from(cells)) as u16).min(cells.saturating_sub(1))
}

/// Where the label of a tick begins, so that it is centred below its tick and inside the axis.
fn centred(tick: &Tick, cells: u16) -> u16 {
    let length = tick.label.len() as u16;
    column(tick.fraction, cells).saturating_sub(length / 2).min(cells.saturating_sub(length))
}

/// Whether the labels of a horizontal axis fit on it with a gap between them.
fn apart(ticks: &[Tick], cells: u16, gap: u16) -> bool {
    let places = || ticks.iter().map(|tick| (centred(tick, cells), tick.label.len() as u16));
    let fits = places().all(|(start, length)| start + length <= cells);
    let clear = places()
        .zip(places().skip(1))
        .all(|((start, length), (next, _))| start + length + gap <= next);
    fits && clear
}

/// The name of an axis whose labels may count from a base.
fn named(name: &str, ticks: &Ticks) -> String {
    match ticks.base.as_deref() {
        None => name.into(),
        Some(base) => match base.strip_prefix('-') {
            Some(positive) => format!("{name}+{positive}"),
            None => format!("{name}-{base}"),
        },
    }
}
