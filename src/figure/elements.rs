//! What a printed page is made of, as data: lines, areas and texts at their places. SVG, PDF and PNG write the same page.

use strum::IntoStaticStr;

use super::symbols::runs;

/// A place on a page, in its unit: to the right and down from the upper left corner. Also a width and a height.
pub type Spot = (f64, f64);

/// A length as the painters take it, with seven digits.
#[cfg(feature = "print")]
#[expect(clippy::cast_possible_truncation, reason = "a page is no finer than that")]
pub fn single(length: f64) -> f32 {
    length as f32
}

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
        match self {
            PageUnit::Pixel => 0.75,
            PageUnit::Point => 1.0,
        }
    }
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
#[derive(Clone, Debug, Default)]
pub struct Shape {
    pub steps: Vec<PathStep>,
    pub pen: Option<Pen>,
    pub tint: Option<Tint>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathStep {
    Move(Spot),
    Line(Spot),
    /// A cubic Bezier curve: its two control points, and its end.
    Curve(Spot, Spot, Spot),
    Close,
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

impl Shape {
    /// A line through these spots.
    pub fn line(spots: impl IntoIterator<Item = Spot>) -> Self {
        let mut steps: Vec<PathStep> = spots.into_iter().map(PathStep::Line).collect();
        if let Some(PathStep::Line(first)) = steps.first().copied() {
            steps[0] = PathStep::Move(first);
        }
        Shape { steps, ..Shape::default() }
    }

    /// A closed polygon.
    pub fn polygon(spots: impl IntoIterator<Item = Spot>) -> Self {
        let mut shape = Shape::line(spots);
        shape.steps.push(PathStep::Close);
        shape
    }

    /// An upright rectangle: its upper left corner, and its width and height.
    pub fn rectangle((x, y): Spot, (width, height): Spot) -> Self {
        Shape::polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
    }

    /// A circle, as four curves that miss it by 0.03 % of its radius.
    pub fn circle((x, y): Spot, radius: f64) -> Self {
        /// Distance of the control points from the ends of a quarter, in radii.
        const ARM: f64 = 0.552_284_75;
        let at = |across: f64, down: f64| (x + radius * across, y + radius * down);
        let quarters = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x0, y0)| {
            // The next end is this one turned by a right angle, and the way there begins in its direction.
            let (x1, y1) = (-y0, x0);
            let leave = at(x0 + ARM * x1, y0 + ARM * y1);
            PathStep::Curve(leave, at(x1 + ARM * x0, y1 + ARM * y0), at(x1, y1))
        });
        let mut steps = vec![PathStep::Move(at(1.0, 0.0))];
        steps.extend(quarters);
        steps.push(PathStep::Close);
        Shape { steps, ..Shape::default() }
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

impl Anchor {
    /// How far a text of this width starts before its spot.
    pub fn before(self, width: f64) -> f64 {
        match self {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        }
    }
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
    pub slant: Slant,
    pub level: TextLevel,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slant {
    Upright,
    Italic,
}

/// Where a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextLevel {
    /// On the base line.
    Base,
    /// A subscript.
    Below,
    /// A superscript.
    Above,
}

impl TextLevel {
    /// Size of the letters of a run, and how far it stands below the base line, in a text of this size. No letter is
    /// smaller than 6 where those beside it are not.
    pub fn set(self, size: f64) -> (f64, f64) {
        let smaller = (0.72 * size).max(size.min(6.0));
        match self {
            TextLevel::Base => (size, 0.0),
            TextLevel::Below => (smaller, 0.2 * size),
            TextLevel::Above => (smaller, -0.36 * size),
        }
    }
}
