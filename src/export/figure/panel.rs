//! A plot of a session as data: its picture with every function sampled, and whose parameters each
//! curve has.

use std::collections::BTreeMap;

use super::{Area, Axis, Caption, Curve, Mark, Panel, filled, sample};
use crate::oscillator::Symbol;
use crate::scene::{Point, View, Window};
use crate::session::{Plot, Session, Shown};
use crate::view::dots::Dash;
use crate::view::look::Role;
use crate::view::picture::{self, Item, Line, Picture, common};
use crate::view::ticks::Scale;

impl Panel {
    /// What a plot of a session shows, with every function sampled and everything once.
    #[must_use]
    pub fn of(session: &Session, plot: usize) -> Self {
        let picture = picture::of(session, plot);
        let Picture { title, x, y, scales, window, .. } = &picture;
        let axis = |name: &str, scale: Scale, span: crate::scene::Span| Axis {
            name: scale.of_numbers(name),
            from: span.from(),
            to: span.to(),
        };
        let mut panel = Panel {
            title: title.to_string(),
            x: axis(x, scales[0], window.x),
            y: axis(y, scales[1], window.y),
            names: [x.to_string(), y.to_string()],
            scales: *scales,
            curves: Vec::new(),
            areas: Vec::new(),
            marks: Vec::new(),
            window: *window,
            captions: Vec::new(),
            guides: Vec::new(),
            arrows: Vec::new(),
        };
        for item in &picture.items {
            panel.add(item);
        }
        panel.attribute(&session.shown(plot), &varied(session, plot));
        for item in &picture.items {
            if let Item::Path(line, points) = item {
                panel.line(line, points.clone());
            }
        }
        panel
    }

    /// Gives each curve and area its parameters, and keeps one of those that are the same for several
    /// variants.
    fn attribute(&mut self, shown: &[Shown], varied: &[Symbol]) {
        let mut curves: Vec<Curve> = Vec::new();
        for mut curve in std::mem::take(&mut self.curves) {
            let parameters = parameters_of(&curve.name, shown, varied);
            let same = |other: &&mut Curve| {
                (other.pen, other.style) == (curve.pen, curve.style)
                    && common(&other.name) == common(&curve.name)
                    && other.points == curve.points
            };
            if let Some(first) = curves.iter_mut().find(same) {
                join(&mut first.name, &mut first.parameters, &parameters);
            } else {
                curve.parameters = parameters;
                curves.push(curve);
            }
        }
        self.curves = curves;
        let mut areas: Vec<Area> = Vec::new();
        for mut area in std::mem::take(&mut self.areas) {
            let parameters = parameters_of(&area.name, shown, varied);
            let same = |other: &&mut Area| {
                common(&other.name) == common(&area.name) && other.edge == area.edge
            };
            if let Some(first) = areas.iter_mut().find(same) {
                join(&mut first.name, &mut first.parameters, &parameters);
            } else {
                area.parameters = parameters;
                areas.push(area);
            }
        }
        self.areas = areas;
        let mut marks: Vec<Mark> = Vec::new();
        for mark in std::mem::take(&mut self.marks) {
            if !marks.contains(&mark) {
                marks.push(mark);
            }
        }
        self.marks = marks;
    }

    fn add(&mut self, item: &Item) {
        let Window { x, y } = self.window;
        match item {
            // A path has no parameters in common with what the panel shows, and comes on top of it.
            Item::Path(..) | Item::Cross(_) => {}
            Item::Curve(line, points) => self.line(line, points.clone()),
            Item::Graph(line, value) => self.line(line, sample::graph(value, self.window)),
            Item::Upright(line, at) => {
                self.line(line, [y.from(), y.to()].map(|y| Point { x: *at, y }).to_vec());
            }
            Item::Bar(line, from, to) => {
                self.curves.push(Curve { style: "thick", ..curve(line, &[*from, *to]) });
            }
            Item::Shade(line, edge) => self.area(&line.name, line.role, edge),
            Item::Columns(line, from, to) => {
                let columns = rectangle([*from, *to], [y.from(), y.to()]);
                self.area(&line.name, line.role, &columns);
            }
            Item::Rows(line, from, to) => {
                let rows = rectangle([x.from(), x.to()], [*from, *to]);
                self.area(&line.name, line.role, &rows);
            }
            Item::Arrows(_, flow) => {
                self.arrows.extend(sample::lattice(self.window).map(|at| (at, flow(at))));
            }
            Item::Mark(mark, at, role) => self.mark(*mark, *at, *role),
            Item::Milestone(at, name, role) => {
                self.mark(picture::Mark::Turn, *at, *role);
                if let Some(mark) = self.marks.last_mut() {
                    mark.name = name.clone().into();
                }
            }
            Item::Marks(mark, points, role) => {
                for at in points {
                    self.mark(*mark, *at, *role);
                }
            }
            Item::Caption { at, or_at, long, short, role } => self.captions.push(Caption {
                at: *at,
                or_at: or_at.clone(),
                text: long.to_string(),
                short: short.to_string(),
                role: *role,
            }),
            Item::Texture(at) => {
                for (fill, corners) in filled::polygons(at, self.window) {
                    self.area(fill.name, fill.role, &corners);
                }
            }
        }
    }

    /// A line with a name is data, one without is there to be read against.
    fn line(&mut self, line: &Line, points: Vec<Point>) {
        let finite = points.iter().filter(|point| point.x.is_finite() && point.y.is_finite());
        if line.name.is_empty() {
            self.guides.push(points);
        } else if finite.count() > 1 {
            // One point is no line: a motion at rest has its mark.
            self.curves.push(curve(line, &points));
        }
    }

    fn area(&mut self, name: &str, pen: Role, edge: &[Point]) {
        let (name, parameters) = (name.to_owned(), BTreeMap::new());
        self.areas.push(Area { name, role: pen.name(), parameters, edge: pairs(edge), pen });
    }

    fn mark(&mut self, mark: picture::Mark, at: Point, pen: Role) {
        self.marks.push(Mark { name: mark.name().into(), x: at.x, y: at.y, mark, pen });
    }
}

fn curve(line: &Line, points: &[Point]) -> Curve {
    let style = match line.dash {
        Dash::Solid => "solid",
        Dash::Dashed => "dashed",
        Dash::Dotted => "dotted",
        Dash::Sparse => "sparse",
    };
    let (name, parameters) = (line.name.to_string(), BTreeMap::new());
    let (role, pen) = (line.role.name(), line.role);
    Curve { name, role, style, parameters, points: pairs(points), pen }
}

/// The parameters on the axes of a plot, which vary along its curves.
fn varied(session: &Session, plot: usize) -> Vec<Symbol> {
    let Plot { view, axes, .. } = &session.plots[plot];
    match view {
        View::Diagram => vec![axes.abscissa],
        View::Eigenvalues => vec![Symbol::D],
        View::Regimes => vec![axes.abscissa, axes.against],
        View::Scan => {
            let scanned = session.scanned.iter().flat_map(|scanned| scanned.scan.over());
            scanned.map(|sweep| sweep.symbol).collect()
        }
        View::Phase
        | View::TimeSeries
        | View::EnergyLedger
        | View::ReturnMap
        | View::Trade
        | View::Belt
        | View::EnergyRate => Vec::new(),
    }
}

/// The parameters of what has this name: those of the variant that stands behind it.
fn parameters_of(name: &str, shown: &[Shown], varied: &[Symbol]) -> BTreeMap<&'static str, f64> {
    let own = |shown: &&Shown| {
        name.strip_suffix(shown.label.as_str()).is_some_and(|before| before.ends_with(", "))
    };
    let variant = shown.iter().filter(own).max_by_key(|shown| shown.label.len());
    let Some(Shown { problem, .. }) = variant.or(shown.first()) else { return BTreeMap::new() };
    [Symbol::D, Symbol::D2, Symbol::D3, Symbol::R]
        .into_iter()
        .filter(|symbol| !varied.contains(symbol))
        .map(|symbol| (symbol.spec().name, symbol.get(&problem.parameters, &problem.initial)))
        .collect()
}

/// Takes the same thing of another variant in: what is left is what they have in common.
fn join(
    name: &mut String,
    parameters: &mut BTreeMap<&'static str, f64>,
    others: &BTreeMap<&'static str, f64>,
) {
    name.truncate(common(name).len());
    parameters.retain(|symbol, value| others.get(symbol) == Some(value));
}

fn pairs(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| [point.x, point.y]).collect()
}

fn rectangle([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> Vec<Point> {
    let corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)];
    corners.map(|(x, y)| Point { x, y }).to_vec()
}
