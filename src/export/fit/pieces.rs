//! Pieces of the pictures of a fit: panels, curves and marks from plain points.

use std::collections::BTreeMap;

use crate::export::figure::{Axis, Curve, Mark, Panel};
use crate::scene::{Span, Window};
use crate::view::look::Role;
use crate::view::picture;
use crate::view::ticks::Scale;

/// A panel that holds these points, with some room around them.
pub fn panel(
    title: &str,
    (x, y): (&str, &str),
    curves: Vec<Curve>,
    within: Option<Window>,
) -> Option<Panel> {
    let around = |place: usize| {
        let points = curves.iter().flat_map(|curve| &curve.points);
        let span = Span::covering(points.map(|point| point[place]).filter(|it| it.is_finite()))?;
        Some(span.scaled(span.center(), 1.06))
    };
    let window = match within {
        Some(window) => window,
        None => Window { x: around(0)?, y: around(1)? },
    };
    let axis =
        |name: &str, span: Span| Axis { name: name.into(), from: span.from(), to: span.to() };
    Some(Panel {
        title: title.into(),
        x: axis(x, window.x),
        y: axis(y, window.y),
        curves,
        areas: Vec::new(),
        marks: Vec::new(),
        names: [x.into(), y.into()],
        scales: [Scale::default(); 2],
        window,
        captions: Vec::new(),
        guides: Vec::new(),
        arrows: Vec::new(),
    })
}

/// A line of these points.
pub fn curve(name: &str, pen: Role, style: &'static str, points: Vec<[f64; 2]>) -> Curve {
    Curve { name: name.into(), role: pen.name(), style, parameters: BTreeMap::new(), points, pen }
}

/// `name [unit]`.
pub fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} [{unit}]") }
}

/// A mark at this point.
pub fn mark(name: &'static str, [x, y]: [f64; 2], mark: picture::Mark, pen: Role) -> Mark {
    Mark { name: name.into(), x, y, mark, pen }
}
