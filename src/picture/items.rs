//! The parts of a picture: curves, areas, marks and texts in world coordinates.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::{Dash, Mark, Role, Scale, ScanMap, Ticks, units::said};
use crate::model::{Knob, Parameters};
use crate::numerics::{by_number, hypot, named, real, sin_cos, truncated};
use crate::scene::{Point, Window};
use crate::session::VariantTag;

/// A text that is a constant or was made for this picture.
pub type Text = Cow<'static, str>;

/// How a line looks and what it is called: most are lines of `assets/lines.txt`, and known by their name.
#[derive(Clone, Debug)]
pub struct LineStyle {
    /// What it is; empty for lines that need no name.
    pub name: Text,
    /// What the legend of the screen says in place of the name; nothing where this is empty.
    pub brief: Option<Text>,
    /// The variant that it belongs to; `None` where it belongs to all.
    pub variant: Option<VariantTag>,
    /// What it is, as far as its colour goes.
    pub role: Role,
    /// How it is interrupted.
    pub dash: Dash,
    /// Whether other parameters than those on the axes vary along it too.
    pub varies: bool,
}

impl LineStyle {
    pub fn new(name: impl Into<Text>, role: Role, dash: Dash) -> Self {
        LineStyle { name: name.into(), brief: None, variant: None, role, dash, varies: false }
    }

    /// The same line of one of several variants.
    pub fn of(self, variant: &VariantTag) -> Self {
        LineStyle { variant: Some(variant.clone()), ..self }
    }

    /// The same line with other words in the legend of the screen.
    pub fn briefly(self, words: impl Into<Text>) -> Self {
        LineStyle { brief: Some(words.into()), ..self }
    }

    /// The same line with its name beside it: the legend of the screen leaves it out.
    pub fn captioned(self) -> Self {
        self.briefly("")
    }

    /// Its name, and the variant that it belongs to.
    pub fn full_name(&self) -> Text {
        match self.variant.as_ref().map(|variant| variant.label.as_str()) {
            None | Some("") => self.name.clone(),
            Some(label) => format!("{}, {label}", self.name).into(),
        }
    }

    /// An axis or another line that is there to be read against.
    pub fn guide() -> Self {
        LineStyle::new("", Role::Axis, Dash::Sparse)
    }

    /// The line that a line of the file describes; `None` for a comment. A test reads every line.
    fn described(text: &'static str) -> Option<Self> {
        let parts: Vec<&str> = text.split(" | ").collect();
        let [name, role, dash, ref legend @ ..] = parts[..] else { return None };
        let brief = legend.first().map(|words| if *words == "-" { "" } else { *words }.into());
        Some(LineStyle { brief, ..LineStyle::new(name, named(role)?, named(dash)?) })
    }
}

/// The lines that have a look of their own.
static LINES: LazyLock<Vec<LineStyle>> = LazyLock::new(|| {
    include_str!("../../assets/lines.txt").lines().filter_map(LineStyle::described).collect()
});

impl From<&'static str> for LineStyle {
    /// The line of this name. A test sees to it that there is one, wherever a picture asks for it.
    fn from(name: &'static str) -> Self {
        let known = LINES.iter().find(|line| line.name == name);
        known.cloned().unwrap_or_else(|| LineStyle::new(name, Role::Failure, Dash::Solid))
    }
}

/// What a part of the world is filled with, and what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fill {
    /// What it is, as far as its colour goes.
    pub role: Role,
    pub name: &'static str,
}

/// What fills the world at a point, if anything does.
pub type Texture<'a> = Box<dyn Fn(Point) -> Option<Fill> + 'a>;

/// `y(x)`, or nothing where it has no value.
pub type Function<'a> = Box<dyn Fn(f64) -> Option<f64> + 'a>;

/// A direction at each point.
pub type Flow<'a> = Box<dyn Fn(Point) -> Point + 'a>;

/// Marks of one meaning.
#[derive(Clone, Debug)]
pub struct Marks {
    pub mark: Mark,
    /// What they stand for, as far as their colour goes.
    pub role: Role,
    pub at: Vec<Point>,
    /// What files call each of them.
    pub name: Text,
    /// What the legend of the screen says about them; empty where it leaves them out.
    pub brief: &'static str,
    /// Whether all are left out where they would touch each other.
    pub sparse: bool,
    /// Whether those above and below the window are shown at its edge, by arrows.
    pub at_edge: bool,
}

impl Marks {
    /// Marks with the usual name, which no legend explains.
    pub fn new(mark: Mark, role: Role, at: impl IntoIterator<Item: Into<Point>>) -> Self {
        let (name, at) = (mark.name().into(), at.into_iter().map(Into::into).collect());
        Marks { mark, role, at, name, brief: "", sparse: false, at_edge: false }
    }

    /// The same with a name of their own.
    pub fn called(self, name: impl Into<Text>) -> Self {
        Marks { name: name.into(), ..self }
    }

    /// Where a point above or below a window is shown at its edge, and whether it lies above.
    pub fn edge(at: Point, window: Window) -> Option<(Point, bool)> {
        let Window { x, y } = window;
        let above = at.y > y.to();
        let outside = x.contains(at.x) && (above || at.y < y.from());
        outside.then(|| (Point { x: at.x, y: if above { y.to() } else { y.from() } }, above))
    }
}

pub enum Item<'a> {
    /// A polyline; a point that is not finite interrupts it.
    Curve(LineStyle, Vec<Point>),
    /// A graph over the whole window, sampled as finely as its renderer needs.
    Graph(LineStyle, Function<'a>),
    /// An upright through the whole window.
    Upright(LineStyle, f64),
    /// The area that a curve, closed or with ends outside the window, does not separate from the origin.
    Shade(LineStyle, Vec<Point>),
    /// The area that a closed curve separates from the origin.
    Beyond(LineStyle, Vec<Point>),
    /// All points whose abscissa lies between two values.
    Columns(LineStyle, f64, f64),
    /// All points whose ordinate lies between two values.
    Rows(LineStyle, f64, f64),
    /// Parts of the world, each filled with its pattern.
    Texture(Texture<'a>),
    /// Directions on a sparse lattice.
    Arrows(Flow<'a>),
    /// Marks of one meaning.
    Marks(Marks),
}

/// A text beside a point, and a shorter one for where there is little room.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    pub at: Point,
    /// Points beside which it may stand as well, for where there is no room beside the first; the best first.
    pub or_at: Vec<Point>,
    /// Empty where a figure explains the curve in its legend.
    pub long: Text,
    /// The text for small plots.
    pub short: Text,
    pub role: Role,
}

/// What a plot shows, in the order in which it is painted.
#[derive(Default)]
pub struct Picture<'a> {
    pub title: Text,
    /// Name of the horizontal axis.
    pub x: Text,
    /// Name of the vertical axis.
    pub y: Text,
    /// What the numbers along both axes stand for.
    pub scales: [Scale; 2],
    /// The ticks of the vertical axis, where they are not round numbers.
    pub upward: Option<Ticks>,
    /// The part of the world on show.
    pub window: Window,
    /// The parameters of each variant on show; one set where there are no variants.
    pub variants: Vec<Parameters>,
    /// The parameters on the axes, which differ along the curves.
    pub varied: Vec<Knob>,
    /// Where the cursor is.
    pub cursor: Option<Point>,
    /// What the cursor reads.
    pub reading: Option<String>,
    /// What is behind all items, where the plot is a map.
    pub map: Option<ScanMap>,
    /// From back to front.
    pub items: Vec<Item<'a>>,
    /// The texts, which find their places when all else is there.
    pub captions: Vec<Caption>,
}

impl Item<'_> {
    /// Whether it is drawn in this window and says more than the axes and the present values.
    fn draws(&self, window: Window) -> bool {
        match self {
            // What the parts of a texture are is written on them.
            Item::Upright(..) | Item::Texture(_) => false,
            Item::Arrows(_) => true,
            Item::Marks(Marks { role, at, .. }) => {
                role.tells() && at.iter().any(|at| window.contains(*at))
            }
            item => item.seen(window).is_some_and(|line| line.role.tells()),
        }
    }

    /// The line of a curve, an area or a bar that has a name and is seen in this window.
    pub fn seen(&self, window: Window) -> Option<&LineStyle> {
        let (line, seen) = match self {
            Item::Curve(line, points) => (line, passes(points, window)),
            Item::Graph(line, value) => (line, is_met(value, window)),
            Item::Upright(line, x) => (line, window.x.contains(*x)),
            Item::Shade(line, edge) | Item::Beyond(line, edge) => (line, !edge.is_empty()),
            Item::Columns(line, from, to) => (line, *from < window.x.to() && *to > window.x.from()),
            Item::Rows(line, from, to) => (line, *from < window.y.to() && *to > window.y.from()),
            Item::Texture(_) | Item::Arrows(_) | Item::Marks(_) => return None,
        };
        Some(line).filter(|line| seen && !line.name.is_empty())
    }
}

/// Whether a polyline is seen in a window: one of its points, or the middle of one of its chords.
pub fn passes(points: &[Point], window: Window) -> bool {
    let middle = |pair: &[Point]| Point {
        x: f64::midpoint(pair[0].x, pair[1].x),
        y: f64::midpoint(pair[0].y, pair[1].y),
    };
    points.iter().any(|point| window.contains(*point))
        || points.windows(2).any(|pair| window.contains(middle(pair)))
}

/// An ellipse as a closed polygon: its centre and its half axis in each direction.
pub fn ellipse(x: (f64, f64), y: (f64, f64)) -> impl Iterator<Item = [f64; 2]> {
    const CORNERS: u16 = 240;
    (0..=CORNERS).map(move |corner| {
        let (sin, cos) = sin_cos(TAU * f64::from(corner) / f64::from(CORNERS));
        [x.0 + x.1 * cos, y.0 + y.1 * sin]
    })
}

/// Places along a chord on paper or on a screen, both ends among them, about this far apart.
pub fn along(from: (f64, f64), to: (f64, f64), spacing: f64) -> impl Iterator<Item = (f64, f64)> {
    /// A chord from far outside is followed in so many places only.
    const MOST: f64 = 1000.0;
    let (across, up) = (to.0 - from.0, to.1 - from.1);
    let parts = (hypot(across, up) / spacing).ceil().clamp(1.0, MOST);
    let shares = (0..=truncated(parts)).map(move |part| real(part) / parts);
    shares.map(move |share| (from.0 + share * across, from.1 + share * up))
}

/// Whether a graph is seen in a window.
fn is_met(value: &Function, window: Window) -> bool {
    /// Places that are looked at.
    const PLACES: u32 = 200;
    window.x.evenly(PLACES).any(|x| value(x).is_some_and(|y| window.y.contains(y)))
}

impl<'a> Picture<'a> {
    /// Whether anything is drawn besides axes and present values.
    pub fn draws(&self) -> bool {
        let window = self.window;
        let mut texts = self.captions.iter();
        texts.any(|text| text.role.tells() && window.contains(text.at))
            || self.items.iter().any(|item| item.draws(window))
    }

    pub fn new(
        title: impl Into<Text>,
        x: impl Into<Text>,
        y: impl Into<Text>,
        window: Window,
    ) -> Self {
        let (title, x, y) = (title.into(), x.into(), y.into());
        Picture { title, x, y, window, ..Picture::default() }
    }

    /// Names the axes; under these names the cursor reads its coordinates, where a view says nothing else.
    pub fn axes(&mut self, x: impl Into<Text>, y: impl Into<Text>) {
        (self.x, self.y) = (x.into(), y.into());
        self.reading = self.cursor.map(|at| self.coordinates(at));
    }

    pub fn add_to_title(&mut self, remark: &str) {
        self.title = format!("{}, {remark}", self.title).into();
    }

    /// The coordinates of a point under the names of the axes, to the digits that the window resolves.
    pub fn coordinates(&self, at: Point) -> String {
        let ([across, upward], Window { x, y }) = (self.scales, self.window);
        format!("{} {}", said(across, &self.x, at.x, x), said(upward, &self.y, at.y, y))
    }

    pub fn curve(
        &mut self,
        line: impl Into<LineStyle>,
        points: impl IntoIterator<Item = impl Into<Point>>,
    ) {
        let points = points.into_iter().map(Into::into).collect();
        self.items.push(Item::Curve(line.into(), points));
    }

    pub fn graph(&mut self, line: impl Into<LineStyle>, value: impl Fn(f64) -> Option<f64> + 'a) {
        self.items.push(Item::Graph(line.into(), Box::new(value)));
    }

    /// Adds the line on which the ordinate has this value.
    pub fn level(&mut self, line: impl Into<LineStyle>, y: f64) {
        self.graph(line, move |_| Some(y));
    }

    pub fn upright(&mut self, line: impl Into<LineStyle>, x: f64) {
        self.items.push(Item::Upright(line.into(), x));
    }

    pub fn mark(&mut self, mark: Mark, at: impl Into<Point>, role: Role) {
        self.marks(Marks::new(mark, role, [at]));
    }

    /// Adds marks, if there are any.
    pub fn marks(&mut self, marks: Marks) {
        if !marks.at.is_empty() {
            self.items.push(Item::Marks(marks));
        }
    }

    pub fn caption(&mut self, at: impl Into<Point>, text: impl Into<Text>, role: Role) {
        let (at, long) = (at.into(), text.into());
        let short = long.clone();
        self.captions.push(Caption { at, or_at: Vec::new(), short, long, role });
    }

    /// Adds the letter of a special point, and its value where there is room.
    pub fn special(&mut self, at: impl Into<Point>, letter: &'static str, value: &str) {
        let (at, or_at) = (at.into(), Vec::new());
        let long = format!("{letter} {value}").into();
        self.captions.push(Caption { at, or_at, long, short: letter.into(), role: Role::Special });
    }

    /// Adds the name of a curve, beside the highest of its points in the window that has room. Where `long` is empty, only
    /// screens write the name: figures have it in their legend.
    pub fn name_curve(&mut self, curve: &[Point], long: &str, name: &str, role: Role) {
        /// Points that are tried: more than a screen has rows.
        const PLACES: usize = 60;
        let mut points: Vec<Point> =
            curve.iter().copied().filter(|point| self.window.contains(*point)).collect();
        points.sort_by(by_number(|point: &Point| -point.y));
        let step = points.len().div_ceil(PLACES).max(1);
        let mut places = points.into_iter().step_by(step);
        if let Some(at) = places.next().filter(|_| !name.is_empty()) {
            let or_at = places.collect();
            let [long, short] = [long, name].map(|text| text.to_owned().into());
            self.captions.push(Caption { at, or_at, long, short, role });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_file_is_read_and_has_a_name_of_its_own() {
        let lines = include_str!("../../assets/lines.txt").lines();
        let told = lines.filter(|line| !(line.is_empty() || line.starts_with('#')));
        assert_eq!(told.count(), LINES.len());
        for (index, line) in LINES.iter().enumerate() {
            assert!(LINES[..index].iter().all(|other| other.name != line.name), "{}", line.name);
        }
    }
}
