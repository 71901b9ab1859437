//! What a printed page is made of, as data: lines, areas and texts at their places. SVG, PDF and PNG write the same page.

use strum::IntoStaticStr;
use tiny_skia_path::{Path, PathBuilder};

use super::symbols::runs;

/// A place on a page, in its unit: to the right and down from the upper left corner. Also a width and a height.
pub type Spot = (f64, f64);

/// Red, green and blue.
pub type Color = [u8; 3];

pub const BLACK: Color = [0; 3];
pub const WHITE: Color = [255; 3];

/// A pixel of a browser and a point of print, a 96th and a 72nd of an inch, in points.
pub const PIXEL: f64 = 0.75;
pub const POINT: f64 = 1.0;

/// A page with what stands on it, from back to front.
#[derive(Clone, Debug)]
pub struct Page {
    /// Width and height.
    pub size: Spot,
    /// The unit of all its lengths, in points.
    pub unit: f64,
    pub elements: Vec<Element>,
}

#[derive(Clone, Debug)]
pub enum Element {
    Shape(Shape),
    Text(TextLine),
    /// What is seen of others within a rectangle: its upper left corner, and its width and height.
    Clipped(Spot, Spot, Vec<Element>),
    /// Areas beside each other, painted without smoothing: along smooth edges a hair of paper would show.
    Cells(Vec<Shape>),
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
    pub pen: Option<Pen>,
    pub tint: Option<Tint>,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
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

impl Pen {
    pub const fn solid(width: f64, color: Color) -> Self {
        Pen { width, color, dash: &[] }
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
    pub fn drawn(self, pen: Pen) -> Self {
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
    pub edge: Option<Pen>,
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

/// A part of a text whose letters are set alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextRun {
    pub text: String,
    pub setting: Setting,
}

/// How letters are set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    Upright,
    Italic,
    Subscript,
    Superscript,
}

impl Setting {
    /// Size of the letters, and how far they stand below the base line, in a text of this size. No letter is smaller
    /// than 6 where those beside it are not.
    pub fn of(self, size: f64) -> (f64, f64) {
        let smaller = (0.72 * size).max(size.min(6.0));
        match self {
            Setting::Upright | Setting::Italic => (size, 0.0),
            Setting::Subscript => (smaller, 0.2 * size),
            Setting::Superscript => (smaller, -0.36 * size),
        }
    }
}
