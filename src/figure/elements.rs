//! What a printed page is made of, as data: lines, areas and texts at their places. SVG, PDF and PNG write the same page.

use strum::IntoStaticStr;
use tiny_skia_path::{Path, PathBuilder};

use super::symbols::{TextRun, runs};
use crate::numerics::truncated;

/// A place on a page, in its unit: to the right and down from the upper left corner. Also a width and a height.
pub type Spot = (f64, f64);

/// Size of the plot of a panel of `plain`, in pixels of 1/96 inch. All plots have its shape.
pub const PLOT: Spot = (380.0, 300.0);

/// Red, green and blue.
pub type Color = [u8; 3];

pub const BLACK: Color = [0; 3];
pub const WHITE: Color = [255; 3];

/// A page with what stands on it, from back to front.
#[derive(Clone, Debug)]
pub struct Page {
    /// Width and height.
    pub size: Spot,
    /// The unit of all its lengths.
    pub unit: PageUnit,
    pub elements: Vec<Element>,
}

/// What lengths on a page are measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageUnit {
    /// A pixel of a browser: a 96th of an inch.
    Pixel,
    /// A point of print: a 72nd of an inch.
    Point,
}

impl PageUnit {
    pub fn in_points(self) -> f64 {
        if self == PageUnit::Pixel { 0.75 } else { 1.0 }
    }
}

#[derive(Clone, Debug)]
pub enum Element {
    Shape(Shape),
    Text(TextLine),
    /// What is seen of others within a rectangle: its upper left corner, and its width and height.
    Clipped(Spot, Spot, Vec<Element>),
}

impl From<Shape> for Element {
    fn from(shape: Shape) -> Self {
        Element::Shape(shape)
    }
}

impl From<TextLine> for Element {
    fn from(line: TextLine) -> Self {
        Element::Text(line)
    }
}

/// A path that is drawn, filled, or both. What it encloses is filled by the even-odd rule; lines are joined roundly.
#[derive(Clone, Debug)]
pub struct Shape {
    /// `None` if it leads nowhere.
    pub path: Option<Path>,
    pub pen: Option<PlotPen>,
    pub tint: Option<Tint>,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotPen {
    pub width: f64,
    pub color: Color,
    /// Lengths of dashes and gaps in turn; none for a solid line.
    pub dash: &'static [f64],
}

/// How an area is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    pub color: Color,
    pub opacity: f64,
}

impl PlotPen {
    pub const fn solid(width: f64, color: Color) -> Self {
        PlotPen { width, color, dash: &[] }
    }
}

impl Tint {
    /// The same as it looks on white paper, where nothing is seen through it.
    pub fn on_white(self) -> Self {
        let mixed = |part: u8| truncated(255.5 - self.opacity * (255.0 - f64::from(part)));
        let color = self.color.map(|part| u8::try_from(mixed(part)).unwrap_or(u8::MAX));
        Tint { color, opacity: 1.0 }
    }
}

/// A length as paths have it, with seven digits.
#[expect(clippy::cast_possible_truncation, reason = "no page is seen more finely")]
pub fn single(length: f64) -> f32 {
    length as f32
}

/// Adds a line through these spots to a path.
pub fn lead(path: &mut PathBuilder, spots: impl IntoIterator<Item = Spot>) {
    for (number, (x, y)) in spots.into_iter().enumerate() {
        match number {
            0 => path.move_to(single(x), single(y)),
            _ => path.line_to(single(x), single(y)),
        }
    }
}

impl Shape {
    pub fn along(path: PathBuilder) -> Self {
        Shape { path: path.finish(), pen: None, tint: None }
    }

    /// A line through these spots.
    pub fn line(spots: impl IntoIterator<Item = Spot>) -> Self {
        let mut path = PathBuilder::new();
        lead(&mut path, spots);
        Shape::along(path)
    }

    /// A closed polygon.
    pub fn polygon(spots: impl IntoIterator<Item = Spot>) -> Self {
        let mut path = PathBuilder::new();
        lead(&mut path, spots);
        path.close();
        Shape::along(path)
    }

    /// An upright rectangle: its upper left corner, and its width and height.
    pub fn rectangle((x, y): Spot, (width, height): Spot) -> Self {
        Shape::polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
    }

    pub fn circle((x, y): Spot, radius: f64) -> Self {
        let mut path = PathBuilder::new();
        path.push_circle(single(x), single(y), single(radius));
        Shape::along(path)
    }

    /// The same, drawn.
    pub fn drawn(self, pen: PlotPen) -> Self {
        Shape { pen: Some(pen), ..self }
    }

    /// The same, filled.
    pub fn filled(self, tint: Tint) -> Self {
        Shape { tint: Some(tint), ..self }
    }

    /// The same, filled with a colour through which nothing is seen.
    pub fn solid(self, color: Color) -> Self {
        self.filled(Tint { color, opacity: 1.0 })
    }
}

/// What a spot is of the text that is written there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text.
#[derive(Clone, Debug)]
pub struct TextLine {
    /// Where its base line starts, has its middle, or ends.
    pub at: Spot,
    pub anchor: Anchor,
    /// Size of its letters.
    pub size: f64,
    pub color: Color,
    /// A line around its letters, below them: in white, where it stands on lines; in its own colour, to be bold.
    pub edge: Option<PlotPen>,
    /// Whether it is read upwards.
    pub upward: bool,
    pub runs: Vec<TextRun>,
}

impl TextLine {
    /// A text in black, its symbols set as one writes them.
    pub fn new(at: Spot, anchor: Anchor, size: f64, text: &str) -> Self {
        let runs = runs(text);
        TextLine { at, anchor, size, color: BLACK, edge: None, upward: false, runs }
    }
}
