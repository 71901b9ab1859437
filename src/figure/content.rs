//! A figure as data: every function sampled, everything once, and each curve with its parameters.

use std::collections::BTreeMap;

use serde::{Serialize, Serializer};

use super::areas::polygons;
use super::lines::{graph, kept, lattice, missed};
use crate::model::{Knob, Parameters, State};
use crate::picture::{
    self, Caption, Dash, Fill, Item, LineStyle, Mark, Marks, Picture, Role, Scale, ScanMap,
};
use crate::report::Document;
use crate::scene::{Point, Sheet, Span, Window, rectangle};
use crate::words::provenance::Provenance;

/// What plots show, as data.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// The name of the scene.
    pub figure: String,
    /// What the scene is called.
    pub title: String,
    /// Name and version of the program.
    pub program: &'static str,
    /// What wrote the figure: program, version, revision and command line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub provenance: Option<Provenance>,
    /// What the numbers are measured in.
    pub units: String,
    /// Parameters of the present motion; curves have their own.
    pub parameters: Parameters,
    /// The numbers of the machine that is drawn, in SI units.
    #[serde(skip)]
    pub machine: Option<String>,
    /// Where the motion starts.
    pub initial: State,
    /// End time of the motion.
    pub until: f64,
    /// How motions are integrated.
    pub method: String,
    /// Relative error of a step.
    pub tolerance: f64,
    /// How it is printed.
    #[serde(skip)]
    pub sheet: Sheet,
    /// One for each plot.
    pub panels: Vec<Panel>,
}

/// A plot, as data.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Panel {
    /// What it is called.
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// Lines, from back to front.
    pub curves: Vec<Outline>,
    #[serde(serialize_with = "with_edges")]
    pub areas: Vec<Outline>,
    /// Points with a meaning.
    pub marks: Vec<MarkedPoint>,
    /// What is behind all lines, where the plot is a map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<ScanMap>,
    /// What stands beside the axes: where they are logarithmic, the quantities themselves.
    #[serde(skip)]
    pub names: [String; 2],
    /// What the numbers along both axes stand for.
    #[serde(skip)]
    pub scales: [Scale; 2],
    /// The part of the world on show.
    #[serde(skip)]
    pub window: Window,
    #[serde(skip)]
    pub captions: Vec<Caption>,
    /// What the plot needs, where it can show nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nothing: Option<String>,
    /// Lines to be read against.
    #[serde(skip)]
    pub guides: Vec<Vec<[f64; 2]>>,
    /// Directions: where, and which way in the world.
    #[serde(skip)]
    pub arrows: Vec<(Point, Point)>,
}

/// An axis: its name, and the values at its ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Axis {
    /// What stands on it.
    pub name: String,
    /// The value at its lower end.
    pub from: f64,
    /// The value at its upper end.
    pub to: f64,
}

/// A line, or the edge of an area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outline {
    /// What it is, and which values it has of its own.
    pub name: String,
    pub role: Role,
    /// How a line is drawn; `None` for an area.
    pub style: Option<Dash>,
    /// The parameters that hold all along it; those on an axis of the panel are left out.
    pub parameters: Held,
    /// Its points; `null` interrupts a line. An area whose edge is not closed is the side of it that holds the origin.
    pub points: Vec<[f64; 2]>,
    /// What it is, whichever variant it belongs to.
    #[serde(skip)]
    pub kind: String,
    /// Whether its name stands beside it, or anybody recognizes it.
    #[serde(skip)]
    pub captioned: bool,
}

/// Areas in a document, which have an edge in place of points.
fn with_edges<S: Serializer>(areas: &[Outline], serializer: S) -> Result<S::Ok, S::Error> {
    let area = |Outline { name, role, parameters, points, .. }: &Outline| {
        let named = Document::of("name", name).with("role", role);
        named.with("parameters", parameters).with("edge", points)
    };
    serializer.collect_seq(areas.iter().map(area))
}

/// A point with a meaning.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MarkedPoint {
    pub name: picture::Text,
    #[serde(flatten)]
    pub at: Point,
    /// Whether an arrow at the edge of the plot stands for it if it lies above or below.
    #[serde(skip)]
    pub at_edge: bool,
    /// How it is drawn.
    #[serde(skip)]
    pub mark: Mark,
    #[serde(skip)]
    pub role: Role,
}

/// The parameters that hold all along a curve.
pub type Held = BTreeMap<&'static str, f64>;

impl Panel {
    /// What a picture shows, with every function sampled and everything once.
    pub fn of(picture: &Picture) -> Self {
        let Picture { title, x, y, scales, window, .. } = picture;
        let axis = |name: &str, scale: Scale, span: Span| Axis {
            name: scale.of_numbers(name),
            from: span.from(),
            to: span.to(),
        };
        let captions = picture.captions.iter();
        let mut panel = Panel {
            title: title.to_string(),
            x: axis(x, scales[0], window.x),
            y: axis(y, scales[1], window.y),
            names: [scales[0].title(x).to_owned(), scales[1].title(y).to_owned()],
            scales: *scales,
            map: picture.map.clone(),
            window: *window,
            // What a screen writes beside a curve stands in the legend.
            captions: captions.filter(|caption| !caption.long.is_empty()).cloned().collect(),
            ..Panel::default()
        };
        for item in &picture.items {
            panel.add(picture, item);
        }
        panel
    }

    fn add(&mut self, picture: &Picture, item: &Item) {
        let window @ Window { x, y } = self.window;
        let mut add = |line: &LineStyle, points: &[Point]| {
            if line.name.is_empty() {
                // A line without a name is not data.
                self.guides.push(pairs(points));
            } else if points.iter().filter(|it| it.x.is_finite() && it.y.is_finite()).count() > 1 {
                // One point is not a line: a motion at rest has its mark.
                include(&mut self.curves, outline(picture, line, Some(line.dash), points));
            }
        };
        match item {
            Item::Curve(line, points) => add(line, points),
            Item::Graph(line, value) => add(line, &graph(value, window)),
            Item::Upright(line, at) => add(line, &y.ends().map(|y| Point { x: *at, y })),
            Item::Shade(line, edge) => self.area(picture, line, edge),
            Item::Beyond(line, edge) => self.area(picture, line, &beyond(edge, window)),
            Item::Columns(line, from, to) => {
                self.area(picture, line, &rectangle([*from, *to], y.ends()));
            }
            Item::Rows(line, from, to) => {
                self.area(picture, line, &rectangle(x.ends(), [*from, *to]));
            }
            Item::Texture(at) => {
                for (Fill { role, name }, corners) in polygons(at, window) {
                    let line = LineStyle::new(name, role, Dash::Solid);
                    self.area(picture, &line, &corners);
                }
            }
            Item::Arrows(flow) => {
                self.arrows.extend(lattice(window).map(|at| (at, flow(at))));
            }
            Item::Marks(marks) => self.marks(marks),
        }
    }

    fn area(&mut self, picture: &Picture, line: &LineStyle, edge: &[Point]) {
        include(&mut self.areas, outline(picture, line, None, edge));
    }

    fn marks(&mut self, marks: &Marks) {
        let &Marks { mark, role, at_edge, .. } = marks;
        for &at in &marks.at {
            let mark = MarkedPoint { name: marks.name.clone(), at, at_edge, mark, role };
            if !self.marks.contains(&mark) {
                self.marks.push(mark);
            }
        }
    }
}

/// Around the window and then along a closed curve within: what lies between.
fn beyond(edge: &[Point], window: Window) -> Vec<Point> {
    let Window { x, y } = window;
    let reach = |span: Span, inner: fn(&Point) -> f64| {
        let all = edge.iter().map(inner).chain(span.ends());
        Span::covering(all).unwrap_or(span).ends()
    };
    let corners = rectangle(reach(x, |at| at.x), reach(y, |at| at.y));
    corners.into_iter().chain(edge.iter().copied()).chain([corners[0]]).collect()
}

/// A line, or the edge of an area, as data.
fn outline(picture: &Picture, line: &LineStyle, style: Option<Dash>, points: &[Point]) -> Outline {
    Outline {
        name: line.full_name().into_owned(),
        role: line.role,
        style,
        parameters: held(picture, line),
        points: pairs(points),
        kind: line.name.to_string(),
        captioned: line.brief.as_deref() == Some(""),
    }
}

/// Adds an outline; of several variants that have it in common it is kept once, with what holds for all of them.
fn include(all: &mut Vec<Outline>, new: Outline) {
    let alike = |it: &Outline| (it.role, it.style) == (new.role, new.style) && it.kind == new.kind;
    match all.iter_mut().find(|it| alike(it) && it.points == new.points) {
        Some(known) => {
            known.kind.clone_into(&mut known.name);
            let others = &new.parameters;
            known.parameters.retain(|symbol, value| others.get(symbol) == Some(value));
        }
        None => all.push(new),
    }
}

/// The parameters of the variant of a line, or of the first where it belongs to all, except for those that vary along it.
fn held(picture: &Picture, line: &LineStyle) -> Held {
    let index = line.variant.as_ref().map_or(0, |variant| variant.index);
    let parameters = picture.variants.get(index).filter(|_| !line.varies);
    let Some(parameters) = parameters else { return Held::new() };
    Knob::PARAMETERS
        .into_iter()
        .filter(|symbol| !picture.varied.contains(symbol))
        .map(|symbol| (symbol.spec().name, parameters.value(symbol)))
        .collect()
}

fn pairs(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| (*point).into()).collect()
}

impl Panel {
    /// The largest distance between a curve and its chords within the window, in pixels; an estimate.
    pub fn chord(&self) -> f64 {
        let lines = self.curves.iter().chain(&self.areas);
        lines.map(|line| missed(&line.points, self.window)).fold(0.0, f64::max)
    }
}

impl Figure {
    /// Keeps only one of `times` points outside the windows, so that files stay small.
    pub fn thinned(mut self, times: usize) -> Self {
        if times > 1 {
            for panel in &mut self.panels {
                let window = panel.window;
                for line in panel.curves.iter_mut().chain(&mut panel.areas) {
                    line.points = kept(&line.points, window, times);
                }
            }
        }
        self
    }
}
