//! Figures for papers and for other programs: the pictures of a session as SVG, CSV, JSON and text.
//!
//! A [`Figure`] is what the plots of a session show, with every function sampled and every line a list
//! of points; each form writes the same data, and with it the parameters, method, tolerance and version
//! that it was computed with. The SVG is written here: the plotting libraries at hand round coordinates
//! to whole pixels and have no dashed curves, and a picture of lines and letters needs neither.

mod data;
mod layout;
mod region;
mod sample;
mod svg;

pub use data::{csv, json};
pub use svg::svg;

use serde::Serialize;

use crate::flow::Problem;
use crate::oscillator::{Parameters, State};
use crate::scene::{Point, Window};
use crate::session::Session;
use crate::view::dots::Dash;
use crate::view::look::Role;
use crate::view::picture::{self, Item, Line, Picture};

/// What plots show, as data.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The name of the scene.
    pub figure: String,
    /// What the scene is called.
    pub title: String,
    /// Name and version of the program.
    pub program: String,
    /// Parameters of the present motion; curves with others name them.
    pub parameters: Parameters,
    /// Where the motion starts.
    pub initial: State,
    /// End time of the motion.
    pub until: f64,
    /// How motions are integrated.
    pub method: String,
    /// Relative error of a step.
    pub tolerance: f64,
    /// One for each plot.
    pub panels: Vec<Panel>,
}

/// A plot, as data.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// What it is called.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Lines, from back to front.
    pub curves: Vec<Curve>,
    /// Shaded areas.
    pub areas: Vec<Area>,
    /// Points with a meaning.
    pub marks: Vec<Mark>,
    /// The part of the world on show.
    #[serde(skip)]
    pub window: Window,
    /// Texts beside points.
    #[serde(skip)]
    pub captions: Vec<(Point, String, Role)>,
    /// Lines to be read against.
    #[serde(skip)]
    pub guides: Vec<Vec<Point>>,
    /// Rectangles that are filled: two corners, and what they stand for.
    #[serde(skip)]
    pub fills: Vec<(Point, Point, Role)>,
    /// Directions: where, and which way in the world.
    #[serde(skip)]
    pub arrows: Vec<(Point, Point)>,
}

/// An axis: its name, and the values at its ends.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What stands on it.
    pub name: String,
    /// The value at its lower end.
    pub from: f64,
    /// The value at its upper end.
    pub to: f64,
}

/// A line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// What it is, and which values it has of its own.
    pub name: String,
    /// What it stands for.
    pub role: &'static str,
    /// How it is drawn: solid, dashed, dotted, sparse or thick.
    pub style: &'static str,
    /// Its points; `null` interrupts it.
    pub points: Vec<[f64; 2]>,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

/// A shaded area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Area {
    /// What it is.
    pub name: String,
    /// What it stands for.
    pub role: &'static str,
    /// Its edge. Where this is not closed, the area is the side of it that holds the origin.
    pub edge: Vec<[f64; 2]>,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

/// A point with a meaning.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// What it says.
    pub name: &'static str,
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// How it is drawn.
    #[serde(skip)]
    pub mark: picture::Mark,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

impl Figure {
    /// What these plots of a session show.
    #[must_use]
    pub fn of(session: &Session, plots: impl IntoIterator<Item = usize>) -> Self {
        let Problem { parameters, initial, until, method, tolerance, .. } = session.problem;
        Figure {
            figure: session.scene.name.clone(),
            title: session.scene.title.clone(),
            program: format!("hopfscope {}", env!("CARGO_PKG_VERSION")),
            parameters,
            initial,
            until,
            method: method.to_string(),
            tolerance,
            panels: plots.into_iter().map(|plot| Panel::of(&picture::of(session, plot))).collect(),
        }
    }
}

impl Panel {
    /// A picture with every function sampled.
    #[must_use]
    pub fn of(picture: &Picture) -> Self {
        let Picture { title, x, y, window, .. } = picture;
        let axis = |name: &str, span: crate::scene::Span| Axis {
            name: name.to_owned(),
            from: span.from(),
            to: span.to(),
        };
        let mut panel = Panel {
            title: title.to_string(),
            x: axis(x, window.x),
            y: axis(y, window.y),
            curves: Vec::new(),
            areas: Vec::new(),
            marks: Vec::new(),
            window: *window,
            captions: Vec::new(),
            guides: Vec::new(),
            fills: Vec::new(),
            arrows: Vec::new(),
        };
        for item in &picture.items {
            panel.add(item);
        }
        panel
    }

    fn add(&mut self, item: &Item) {
        let Window { x, y } = self.window;
        match item {
            Item::Curve(line, points) => self.line(line, points.clone()),
            Item::Graph(line, value) => self.line(line, sample::graph(value, self.window)),
            Item::Upright(line, at) => {
                self.line(line, [y.from(), y.to()].map(|y| Point { x: *at, y }).to_vec());
            }
            Item::Bar(line, from, to) => {
                self.curves.push(Curve { style: "thick", ..curve(line, &[*from, *to]) });
            }
            Item::Shade(line, edge) => self.area(line, edge),
            Item::Columns(line, from, to) => {
                self.area(line, &rectangle([*from, *to], [y.from(), y.to()]));
            }
            Item::Rows(line, from, to) => {
                self.area(line, &rectangle([x.from(), x.to()], [*from, *to]));
            }
            Item::Arrows(_, flow) => {
                self.arrows.extend(sample::lattice(self.window).map(|at| (at, flow(at))));
            }
            Item::Mark(mark, at, role) => self.mark(*mark, *at, *role),
            Item::Marks(mark, points, role) => {
                for at in points {
                    self.mark(*mark, *at, *role);
                }
            }
            Item::Caption { at, long, role, .. } => {
                self.captions.push((*at, long.to_string(), *role));
            }
            Item::Texture(at) => self.fills.extend(sample::fills(at, self.window)),
            Item::Cross(_) => {}
        }
    }

    /// A line with a name is data, one without is there to be read against.
    fn line(&mut self, line: &Line, points: Vec<Point>) {
        if line.name.is_empty() {
            self.guides.push(points);
        } else {
            self.curves.push(curve(line, &points));
        }
    }

    fn area(&mut self, line: &Line, edge: &[Point]) {
        self.areas.push(Area {
            name: line.name.to_string(),
            role: line.role.name(),
            edge: pairs(edge),
            pen: line.role,
        });
    }

    fn mark(&mut self, mark: picture::Mark, at: Point, pen: Role) {
        self.marks.push(Mark { name: mark.name(), x: at.x, y: at.y, mark, pen });
    }
}

fn curve(line: &Line, points: &[Point]) -> Curve {
    let style = match line.dash {
        Dash::Solid => "solid",
        Dash::Dashed => "dashed",
        Dash::Dotted => "dotted",
        Dash::Sparse => "sparse",
    };
    let name = line.name.to_string();
    Curve { name, role: line.role.name(), style, points: pairs(points), pen: line.role }
}

fn pairs(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| [point.x, point.y]).collect()
}

fn rectangle([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> Vec<Point> {
    let corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)];
    corners.map(|(x, y)| Point { x, y }).to_vec()
}
