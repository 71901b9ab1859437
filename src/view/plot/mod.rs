//! A plot: title line, axes with ticks, and a raster that takes points of the world.
//!
//! Only here do numbers become cells. World coordinates may be infinite or NaN; what cannot be shown is left out.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "fractions of the screen and lengths of short texts count cells, eighths of a turn are indices"
)]

mod geometry;
mod text;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};

use geometry::{Geometry, along, centred, column, middle};
pub use geometry::{point_at, room, rows, shown};

use super::dots::{Covering, DotPen, DotPlace, Dots};
use super::{Look, Surface, pane::FramedPicture};
use crate::numerics::atan2;
use crate::picture::{Dash, Role, Tick, Ticks};
use crate::scene::{Point, Window};

#[derive(Debug)]
pub struct Canvas<'a> {
    look: &'a Look,
    window: Window,
    /// The cells between the axes.
    pub inner: Rect,
    dots: Dots,
    /// Whether the axes stand outside of the cells.
    roomy: bool,
    rightward: Ticks,
    upward: Ticks,
}

impl<'a> Canvas<'a> {
    /// Writes the title of a picture into its place, and gives the raster between its axes.
    pub fn new(framed: &FramedPicture, screen: &mut Surface<'a>) -> Self {
        let look = screen.look;
        let FramedPicture { area, picture, heading } = framed;
        let (window, scales) = (picture.window, picture.scales);
        let Geometry { inner, roomy, rightward, mut upward } =
            Geometry::of(*area, window, scales, picture.upward.clone());
        let x = rightward.named(scales[0].title(&picture.x));
        if picture.y.is_empty() && picture.upward.is_none() {
            // Heights without meaning have no scale.
            upward.ticks.clear();
        }
        let axes = match &*picture.y {
            "" => x,
            y => format!("{} over {x}", upward.named(scales[1].title(y))),
        };
        screen.title(*area, &picture.title, &axes, heading);
        let dots = Dots::of(inner, look);
        Canvas { look, window, inner, dots, roomy, rightward, upward }
    }

    fn axes(&self, buffer: &mut Buffer) {
        let style = self.look.style(Role::Axis);
        let [line, notch, corner, rule, stub] = &self.look.symbols().axis;
        let Rect { x, y, width, height } = self.inner;
        let (left, bottom) = (x - 1, y + height);
        for row in y..bottom {
            buffer.set_string(left, row, line, style);
        }
        buffer.set_string(left, bottom, corner, style);
        buffer.set_string(x, bottom, rule.repeat(width.into()), style);
        for tick in &self.upward.ticks {
            let row = y + self.row(tick.fraction);
            let start = left.saturating_sub(tick.label.len() as u16);
            buffer.set_string(start, row, &tick.label, style);
            buffer.set_string(left, row, notch, style);
        }
        for tick in &self.rightward.ticks {
            let column = column(tick.fraction, width);
            buffer.set_string(x + column, bottom, stub, style);
            buffer.set_string(x + centred(tick, width), bottom + 1, &tick.label, style);
        }
    }

    /// Labels over the edge of the picture, where there is no room beside it.
    fn labels_inside(&self, buffer: &mut Buffer) {
        let axis = self.look.style(Role::Axis);
        // The colour of a curve below says something of the curve, not of the number.
        let style = axis.fg(axis.fg.unwrap_or(Color::Reset)).remove_modifier(Modifier::BOLD);
        let Rect { x, y, width, height } = self.inner;
        let Some(last) = height.checked_sub(1) else { return };
        let fits = |tick: &&Tick| tick.label.len() < usize::from(width);
        // Nothing of a text is hidden, and no text continues in a number.
        let free = |start: u16, row: u16, label: &str| {
            let end = start + label.len() as u16;
            (start.saturating_sub(1)..=end)
                .all(|column| self.dots.covering((column.into(), row.into())) != Covering::Symbol)
        };
        for tick in self.upward.ticks.iter().filter(fits) {
            let row = self.row(tick.fraction);
            if row < last && free(0, row, &tick.label) {
                buffer.set_string(x, y + row, &tick.label, style);
            }
        }
        for tick in self.rightward.ticks.iter().filter(fits) {
            let start = centred(tick, width);
            if free(start, last, &tick.label) {
                buffer.set_string(x + start, y + last, &tick.label, style);
            }
        }
    }

    fn row(&self, fraction: f64) -> u16 {
        column(1.0 - fraction, self.inner.height)
    }

    fn place(&self, point: Point) -> (f64, f64) {
        let (width, height) = self.dots.size();
        let Window { x, y } = self.window;
        (along(x.fraction(point.x), width), along(1.0 - y.fraction(point.y), height))
    }

    /// The cell of the raster in which a point lies.
    fn cell(&self, point: Point) -> Option<DotPlace> {
        self.dots.cell_at(self.place(point))
    }

    /// The world at the middle of a cell.
    pub fn world(&self, column: u16, row: u16) -> Point {
        self.window.at(middle(self.inner, column, row))
    }

    pub fn curve(&mut self, points: impl IntoIterator<Item = Point>, role: Role, dash: Dash) {
        let placed: Vec<_> = points.into_iter().map(|point| self.place(point)).collect();
        self.dots.stroke(placed, DotPen { role, dash });
    }

    /// Draws `y(x)`, sampled once for each dot across; where there is no value there is no line.
    pub fn function(&mut self, role: Role, dash: Dash, value: impl Fn(f64) -> Option<f64>) {
        let across = self.dots.size().0 as u32;
        let point = |x: f64| Point { x, y: value(x).unwrap_or(f64::NAN) };
        self.curve(self.window.x.evenly(across).map(point), role, dash);
    }

    pub fn upright(&mut self, x: f64, role: Role, dash: Dash) {
        self.curve(self.window.y.ends().map(|y| Point { x, y }), role, dash);
    }

    /// Shades the cells that `curve` does not separate from the origin, or those that it does.
    ///
    /// The curve may be closed, or open with ends outside the window.
    pub fn shade(&mut self, curve: &[Point], with_origin: bool, role: Role) {
        let climbed = crossings(curve, |point| point.x, |point| point.y);
        let between = |a: f64, b: f64, value: f64| a.min(b) < value && value < a.max(b);
        for row in 0..self.inner.height {
            let y = self.world(0, row).y;
            let walls = crossings(curve, |point| point.y - y, |point| point.x);
            let climbs = climbed.iter().filter(|wall| between(0.0, y, **wall)).count();
            self.shade_row(row, role, |Point { x, .. }| {
                let walks = walls.iter().filter(|wall| between(0.0, x, **wall)).count();
                ((climbs + walks) % 2 == 0) == with_origin
            });
        }
    }

    /// Shades the cells whose middle lies in a part of the world.
    pub fn shade_where(&mut self, role: Role, inside: impl Fn(Point) -> bool) {
        (0..self.inner.height).for_each(|row| self.shade_row(row, role, &inside));
    }

    fn shade_row(&mut self, row: u16, role: Role, inside: impl Fn(Point) -> bool) {
        for column in 0..self.inner.width {
            if inside(self.world(column, row)) {
                // The blanks belong to the texture: to write them is shorter than to skip them.
                let shade = self.look.symbols().shade;
                let symbol = if (column + row).is_multiple_of(2) { shade } else { ' ' };
                self.dots.texture((column.into(), row.into()), symbol, role);
            }
        }
    }

    /// Puts a texture on the cells of parts of the world; blanks leave what is there.
    pub fn texture_where(&mut self, texture: impl Fn(Point) -> Option<(char, Role)>) {
        let Rect { width, height, .. } = self.inner;
        for row in 0..height {
            // Every other cell of every other line, so that borders and names can be read.
            for column in (0..width).filter(|column| (column + 2 * row) % 4 == 0) {
                if let Some((symbol, role)) = texture(self.world(column, row)) {
                    self.dots.texture((column.into(), row.into()), symbol, role);
                }
            }
        }
    }

    /// Puts arrows on a sparse lattice of cells, in the direction that `flow` gives there.
    pub fn arrows(&mut self, flow: impl Fn(Point) -> Point) {
        let arrows = self.look.symbols().arrows;
        let Rect { width, height, .. } = self.inner;
        let (dots_across, dots_down) = self.dots.size();
        let (across, down) =
            (dots_across / self.window.x.width(), dots_down / self.window.y.width());
        for row in (1..height).step_by(3) {
            for column in (3..width).step_by(6) {
                let direction = flow(self.world(column, row));
                let angle = atan2(direction.y * down, direction.x * across);
                if angle.is_finite() {
                    let eighth = (angle / std::f64::consts::FRAC_PI_4).round().rem_euclid(8.0);
                    let place = (column.into(), row.into());
                    self.dots.texture(place, arrows[eighth as usize], Role::Field);
                }
            }
        }
    }

    /// Puts a symbol on a point, if it is in the window.
    pub fn mark(&mut self, point: Point, symbol: char, role: Role) {
        if let Some(place) = self.cell(point) {
            self.dots.symbol(place, symbol, role);
        }
    }

    /// Puts the picture on the screen.
    pub fn finish(self, screen: &mut Surface) {
        self.dots.paint(screen);
        if self.roomy {
            self.axes(screen.buffer);
        } else {
            self.labels_inside(screen.buffer);
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

#[cfg(test)]
mod tests;
