//! A picture as data: every function sampled, everything once, and each curve with its parameters.

use std::collections::BTreeMap;

use super::lines::{graph, lattice};
use super::{Area, Axis, FigureCurve, MarkedPoint, Panel, areas::polygons};
use crate::model::{Knob, State};
use crate::picture::{Dash, Item, LineStyle, Marks, Picture, Scale, VariantTag};
use crate::scene::{Point, Span, Window, rectangle};

/// The parameters that hold all along a curve.
type Held = BTreeMap<&'static str, f64>;

impl Panel {
    /// What a picture shows, with every function sampled and everything once.
    pub fn of(picture: &Picture) -> Self {
        let Picture { title, x, y, scales, window, .. } = picture;
        let axis = |name: &str, scale: Scale, span: Span| Axis {
            name: scale.of_numbers(name),
            from: span.from(),
            to: span.to(),
        };
        let mut panel = Panel {
            title: title.to_string(),
            x: axis(x, scales[0], window.x),
            y: axis(y, scales[1], window.y),
            names: [scales[0].title(x).to_owned(), scales[1].title(y).to_owned()],
            scales: *scales,
            curves: Vec::new(),
            areas: Vec::new(),
            marks: Vec::new(),
            map: picture.map.clone(),
            window: *window,
            captions: Vec::new(),
            nothing: None,
            guides: Vec::new(),
            arrows: Vec::new(),
        };
        for item in &picture.items {
            panel.add(picture, item);
        }
        for item in &picture.items {
            // Along a path other parameters vary than those on the axes, and it lies over the rest.
            if let Item::Path(line, points) = item {
                panel.curves.extend(curve(line, points, Held::new()));
            }
        }
        panel
    }

    fn add(&mut self, picture: &Picture, item: &Item) {
        let window @ Window { x, y } = self.window;
        let mut add = |line: &LineStyle, points: &[Point]| {
            if line.name.is_empty() {
                // A line without a name is not data.
                self.guides.push(points.to_vec());
            } else if let Some(curve) = curve(line, points, held(picture, line.variant.as_ref())) {
                self.curve(curve);
            }
        };
        match item {
            Item::Path(..) => {}
            Item::Curve(line, points) => add(line, points),
            Item::Graph(line, value) => add(line, &graph(value, window)),
            Item::Upright(line, at) => {
                add(line, &[y.from(), y.to()].map(|y| Point { x: *at, y }));
            }
            Item::Bar(line, from, to) => {
                let curve = curve(line, &[*from, *to], held(picture, line.variant.as_ref()));
                if let Some(curve) = curve {
                    self.curve(FigureCurve { style: Dash::Thick, ..curve });
                }
            }
            Item::Shade(line, edge) => self.area(picture, line, edge),
            Item::Beyond(line, edge) => self.area(picture, line, &beyond(edge, picture.window)),
            Item::Columns(line, from, to) => {
                self.area(picture, line, &rectangle([*from, *to], [y.from(), y.to()]));
            }
            Item::Rows(line, from, to) => {
                self.area(picture, line, &rectangle([x.from(), x.to()], [*from, *to]));
            }
            Item::Texture(at) => {
                for (fill, corners) in polygons(at, self.window) {
                    self.area(
                        picture,
                        &LineStyle::new(fill.name, fill.role, Dash::Solid),
                        &corners,
                    );
                }
            }
            Item::Arrows(_, flow) => {
                self.arrows.extend(lattice(self.window).map(|at| (at, flow(at))));
            }
            Item::Marks(marks) => self.marks(marks),
            // What a screen writes beside a curve stands in the legend.
            Item::Caption(caption) if caption.long.is_empty() => {}
            Item::Caption(caption) => self.captions.push(caption.clone()),
        }
    }

    /// Adds a curve; of several variants that have it in common it is kept once.
    fn curve(&mut self, curve: FigureCurve) {
        let same = |other: &&mut FigureCurve| {
            (other.role, other.style, &other.kind) == (curve.role, curve.style, &curve.kind)
                && other.points == curve.points
        };
        match self.curves.iter_mut().find(same) {
            Some(known) => {
                join(&known.kind, &mut known.name, &mut known.parameters, &curve.parameters);
            }
            None => self.curves.push(curve),
        }
    }

    /// Adds an area in the same way.
    fn area(&mut self, picture: &Picture, line: &LineStyle, edge: &[Point]) {
        let area = Area {
            name: line.full_name().into_owned(),
            role: line.role,
            parameters: held(picture, line.variant.as_ref()),
            edge: pairs(edge),
            kind: line.name.to_string(),
        };
        let same = |other: &&mut Area| other.kind == area.kind && other.edge == area.edge;
        match self.areas.iter_mut().find(same) {
            Some(known) => {
                join(&known.kind, &mut known.name, &mut known.parameters, &area.parameters);
            }
            None => self.areas.push(area),
        }
    }

    fn marks(&mut self, marks: &Marks) {
        let &Marks { mark, role, at_edge, .. } = marks;
        for at in &marks.at {
            let name = marks.name.clone();
            let mark = MarkedPoint { name, x: at.x, y: at.y, at_edge, mark, role };
            if !self.marks.contains(&mark) {
                self.marks.push(mark);
            }
        }
    }
}

/// Around the window and then along a closed curve within: what lies between.
fn beyond(edge: &[Point], window: Window) -> Vec<Point> {
    let Window { x, y } = window;
    let reach = |ends: [f64; 2], inner: fn(&Point) -> f64| {
        let all = edge.iter().map(inner).chain(ends);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], it| [a.min(it), b.max(it)])
    };
    let across = reach([x.from(), x.to()], |at| at.x);
    let corners = rectangle(across, reach([y.from(), y.to()], |at| at.y));
    corners.into_iter().chain(edge.iter().copied()).chain([corners[0]]).collect()
}

/// A line as data. One point is not a line: a motion at rest has its mark.
fn curve(line: &LineStyle, points: &[Point], parameters: Held) -> Option<FigureCurve> {
    let finite = points.iter().filter(|point| point.x.is_finite() && point.y.is_finite());
    (finite.count() > 1).then(|| FigureCurve {
        name: line.full_name().into_owned(),
        role: line.role,
        style: line.dash,
        parameters,
        points: pairs(points),
        kind: line.name.to_string(),
    })
}

/// The parameters of a variant, or of the first where something belongs to all, except for those on the axes.
fn held(picture: &Picture, variant: Option<&VariantTag>) -> Held {
    let index = variant.map_or(0, |variant| variant.index);
    let Some(parameters) = picture.variants.get(index) else { return Held::new() };
    let value = |symbol: Knob| symbol.get(parameters, &State { q: 0.0, v: 0.0 });
    Knob::PARAMETERS
        .into_iter()
        .filter(|symbol| !picture.varied.contains(symbol))
        .map(|symbol| (symbol.spec().name, value(symbol)))
        .collect()
}

/// Takes in the same thing of another variant: what is left is what they have in common.
fn join(kind: &str, name: &mut String, parameters: &mut Held, others: &Held) {
    kind.clone_into(name);
    parameters.retain(|symbol, value| others.get(symbol) == Some(value));
}

fn pairs(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|point| (*point).into()).collect()
}
