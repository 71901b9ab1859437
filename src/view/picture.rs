//! What a plot shows, before anyone draws it: curves, areas and marks in world coordinates, each with a
//! name and a role.
//!
//! A [`Picture`] decides nothing and knows no terminal. Each view builds one from the session; the
//! terminal ([`super::paint`]) and files ([`crate::export::figure`]) draw the same one, so what is
//! exported is what was looked at.

use std::borrow::Cow;
use std::fmt;

use super::dots::Dash;
use super::look::Role;
use super::ticks::Scale;
use super::{
    belt, diagram, eigenvalues, energy_ledger, energy_rate, phase_plane, regimes, return_map, scan,
    time_series, trade,
};
use crate::scene::{Point, View, Window};
use crate::session::Session;

/// A text that is a constant or was made for this picture.
pub type Text = Cow<'static, str>;

/// What a mark says about its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A motion starts here.
    Start,
    /// A motion came to rest here.
    Rest,
    /// A motion is here at its end time.
    Head,
    /// A turning point.
    Turn,
    /// A stable point.
    Stable,
    /// An unstable point.
    Unstable,
}

impl Mark {
    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Mark::Start => "start",
            Mark::Rest => "rest",
            Mark::Head => "head",
            Mark::Turn => "turning point",
            Mark::Stable => "stable",
            Mark::Unstable => "unstable",
        }
    }
}

/// How a line looks and what it is called.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What it is, as the legend says it; empty for lines that need no name.
    pub name: Text,
    /// What it is, as far as its colour goes.
    pub role: Role,
    /// How it is interrupted.
    pub dash: Dash,
}

impl Line {
    /// A line of this name and look.
    pub fn new(name: impl Into<Text>, role: Role, dash: Dash) -> Self {
        Line { name: name.into(), role, dash }
    }

    /// An axis or another line that is there to be read against.
    #[must_use]
    pub fn guide() -> Self {
        Line::new("", Role::Axis, Dash::Sparse)
    }
}

/// How a part of the world is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Shaded.
    Shade,
    /// With arrows that lead away.
    Arrows,
    /// With stable points.
    Stable,
    /// With unstable points.
    Unstable,
}

/// What a part of the world is filled with, and what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fill {
    /// How it is filled.
    pub pattern: Pattern,
    /// What it is, as far as its colour goes.
    pub role: Role,
    /// What it is called.
    pub name: &'static str,
}

/// What fills the world at a point, if anything does.
pub type Texture<'a> = Box<dyn Fn(Point) -> Option<Fill> + 'a>;

/// `y(x)`, or nothing where it has no value.
pub type Function<'a> = Box<dyn Fn(f64) -> Option<f64> + 'a>;

/// A direction at each point.
pub type Flow<'a> = Box<dyn Fn(Point) -> Point + 'a>;

/// Something in a picture.
pub enum Item<'a> {
    /// A polyline; a point that is not finite interrupts it.
    Curve(Line, Vec<Point>),
    /// A polyline along which other parameters than those on the axes vary too.
    Path(Line, Vec<Point>),
    /// A graph over the whole window, sampled as finely as whoever draws it needs.
    Graph(Line, Function<'a>),
    /// An upright through the whole window.
    Upright(Line, f64),
    /// A thick straight line.
    Bar(Line, Point, Point),
    /// The area that a curve, closed or with ends outside the window, does not separate from the origin.
    Shade(Line, Vec<Point>),
    /// All points whose abscissa lies between two values.
    Columns(Line, f64, f64),
    /// All points whose ordinate lies between two values.
    Rows(Line, f64, f64),
    /// Parts of the world, each filled with its pattern.
    Texture(Texture<'a>),
    /// Directions on a sparse lattice.
    Arrows(Role, Flow<'a>),
    /// A mark with a meaning.
    Mark(Mark, Point, Role),
    /// A point on the way, and what files call it.
    Milestone(Point, String, Role),
    /// Marks of one meaning, left out where they would touch each other.
    Marks(Mark, Vec<Point>, Role),
    /// A text beside a point, and a shorter one for where there is little room.
    Caption {
        /// The point.
        at: Point,
        /// Points beside which it says the same, for where there is no room beside the first; the best
        /// first.
        or_at: Vec<Point>,
        /// The text.
        long: Text,
        /// The text for small plots.
        short: Text,
        /// What it is.
        role: Role,
    },
    /// The cross of the cursor.
    Cross(Point),
}

/// What a plot shows, in the order in which it is painted.
pub struct Picture<'a> {
    /// What it is called.
    pub title: Text,
    /// Name of the horizontal axis.
    pub x: Text,
    /// Name of the vertical axis.
    pub y: Text,
    /// What the numbers along both axes stand for.
    pub scales: [Scale; 2],
    /// The part of the world on show.
    pub window: Window,
    /// What the cursor reads.
    pub reading: Option<String>,
    /// From back to front.
    pub items: Vec<Item<'a>>,
}

impl fmt::Debug for Picture<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "Picture {:?}: {} over {}, {} items",
            self.title,
            self.y,
            self.x,
            self.items.len()
        )
    }
}

impl Item<'_> {
    /// The line of a curve, an area or a bar that has a name and is seen in this window.
    #[must_use]
    pub fn seen(&self, window: Window) -> Option<&Line> {
        let (line, seen) = match self {
            Item::Curve(line, points) | Item::Path(line, points) => (line, passes(points, window)),
            Item::Graph(line, value) => (line, is_met(value, window)),
            Item::Upright(line, x) => (line, window.x.contains(*x)),
            Item::Bar(line, from, to) => (line, passes(&[*from, *to], window)),
            Item::Shade(line, edge) => (line, !edge.is_empty()),
            Item::Columns(line, from, to) => (line, *from < window.x.to() && *to > window.x.from()),
            Item::Rows(line, from, to) => (line, *from < window.y.to() && *to > window.y.from()),
            Item::Texture(_)
            | Item::Arrows(..)
            | Item::Mark(..)
            | Item::Milestone(..)
            | Item::Marks(..)
            | Item::Caption { .. }
            | Item::Cross(_) => return None,
        };
        Some(line).filter(|line| seen && !line.name.is_empty())
    }
}

/// Whether a polyline is seen in a window: one of its points, or the middle of one of its chords.
#[must_use]
pub fn passes(points: &[Point], window: Window) -> bool {
    let middle = |pair: &[Point]| Point {
        x: f64::midpoint(pair[0].x, pair[1].x),
        y: f64::midpoint(pair[0].y, pair[1].y),
    };
    points.iter().any(|point| window.contains(*point))
        || points.windows(2).any(|pair| window.contains(middle(pair)))
}

/// Whether a graph is seen in a window.
fn is_met(value: &Function, window: Window) -> bool {
    /// Places that are looked at.
    const PLACES: u16 = 200;
    (0..=PLACES)
        .map(|place| window.x.at(f64::from(place) / f64::from(PLACES)))
        .any(|x| value(x).is_some_and(|y| window.y.contains(y)))
}

/// What a name says without the variant.
#[must_use]
pub fn common(name: &str) -> &str {
    name.split_once(", ").map_or(name, |(common, _)| common)
}

impl<'a> Picture<'a> {
    /// An empty picture.
    pub fn new(
        title: impl Into<Text>,
        x: impl Into<Text>,
        y: impl Into<Text>,
        window: Window,
    ) -> Self {
        let (title, x, y) = (title.into(), x.into(), y.into());
        Picture { title, x, y, scales: [Scale::Even; 2], window, reading: None, items: Vec::new() }
    }

    /// Adds a polyline.
    pub fn curve(&mut self, line: Line, points: impl IntoIterator<Item = Point>) {
        self.items.push(Item::Curve(line, points.into_iter().collect()));
    }

    /// Adds a graph.
    pub fn graph(&mut self, line: Line, value: impl Fn(f64) -> Option<f64> + 'a) {
        self.items.push(Item::Graph(line, Box::new(value)));
    }

    /// Adds the line on which the ordinate has this value.
    pub fn level(&mut self, line: Line, y: f64) {
        self.graph(line, move |_| Some(y));
    }

    /// Adds an upright.
    pub fn upright(&mut self, line: Line, x: f64) {
        self.items.push(Item::Upright(line, x));
    }

    /// Adds a thick straight line.
    pub fn bar(&mut self, name: impl Into<Text>, role: Role, from: Point, to: Point) {
        self.items.push(Item::Bar(Line::new(name, role, Dash::Solid), from, to));
    }

    /// Adds a mark.
    pub fn mark(&mut self, mark: Mark, at: Point, role: Role) {
        self.items.push(Item::Mark(mark, at, role));
    }

    /// Adds a text.
    pub fn caption(&mut self, at: Point, text: impl Into<Text>, role: Role) {
        let long = text.into();
        let or_at = Vec::new();
        self.items.push(Item::Caption { at, or_at, short: long.clone(), long, role });
    }

    /// Adds the name of a curve, beside the highest of its points in the window that has room.
    pub fn name_curve(&mut self, curve: &[Point], name: &str, role: Role) {
        /// Points that are tried: more than a screen has rows.
        const PLACES: usize = 60;
        let mut points: Vec<Point> =
            curve.iter().copied().filter(|point| self.window.contains(*point)).collect();
        points.sort_by(|a, b| b.y.total_cmp(&a.y));
        let step = points.len().div_ceil(PLACES).max(1);
        let mut places = points.into_iter().step_by(step);
        if let Some(at) = places.next().filter(|_| !name.is_empty()) {
            let long: Text = name.to_owned().into();
            let or_at = places.collect();
            self.items.push(Item::Caption { at, or_at, short: long.clone(), long, role });
        }
    }

    /// Adds the cross of the cursor, if there is one.
    pub fn cross(&mut self, cursor: Option<Point>) {
        self.items.extend(cursor.map(Item::Cross));
    }
}

/// What the numbers along the axes of the plot with this index stand for.
#[must_use]
pub fn scales(session: &Session, index: usize) -> [Scale; 2] {
    match session.plots[index].view {
        View::Scan => session.scanned.as_ref().map_or_else(Default::default, scan::scales),
        View::Trade => [Scale::Logarithmic; 2],
        _ => [Scale::Even; 2],
    }
}

/// What the plot with this index shows.
#[must_use]
pub fn of(session: &Session, index: usize) -> Picture<'_> {
    let mut picture = match session.plots[index].view {
        View::Phase => phase_plane::picture(session, index),
        View::Diagram => diagram::picture(session, index),
        View::TimeSeries => time_series::picture(session, index),
        View::EnergyLedger => energy_ledger::picture(session, index),
        View::ReturnMap => return_map::picture(session, index),
        View::Regimes => regimes::picture(session, index),
        View::Trade => trade::picture(session, index),
        View::EnergyRate => energy_rate::picture(session, index),
        View::Eigenvalues => eigenvalues::picture(session, index),
        View::Scan => scan::picture(session, index),
        View::Belt => belt::picture(session, index),
    };
    picture.scales = scales(session, index);
    // What all of a plot is held at stands in its title; what tells several apart, at their curves.
    let held = session.held_alike(index);
    if !held.is_empty() {
        picture.title = format!("{}, {held}", picture.title).into();
    }
    picture
}
