//! Pieces of the pictures of a fit.

use crate::fit::{Extent, PlotPoint};
use crate::picture::items::{LineStyle, Picture};
use crate::picture::role::{Dash, Role};
use crate::scene::{Point, Span, Window};

/// A curve before it stands in a picture.
pub type StyledPoints = (LineStyle, Vec<Point>);

pub fn at(x: f64, y: f64) -> Point {
    Point { x, y }
}

pub fn points(places: &[PlotPoint]) -> Vec<Point> {
    places.iter().copied().map(Point::from).collect()
}

/// What is worth seeing; `None` if it has no extent.
pub fn window([left, right, low, high]: Extent) -> Option<Window> {
    Some(Window { x: Span::new(left, right).ok()?, y: Span::new(low, high).ok()? })
}

/// A curve through these points.
pub fn curve(name: &'static str, role: Role, dash: Dash, points: Vec<Point>) -> StyledPoints {
    (LineStyle::new(name, role, dash), points)
}

/// A picture of these curves; where no window is given, of one that holds them all with some room. `None` if
/// they have no extent.
pub fn picture(
    title: &'static str,
    (x, y): (String, String),
    curves: Vec<StyledPoints>,
    within: Option<Window>,
) -> Option<Picture<'static>> {
    let around = |place: fn(&Point) -> f64| {
        let points = curves.iter().flat_map(|(_, points)| points);
        let span = Span::covering(points.map(place).filter(|it| it.is_finite()))?;
        Some(span.scaled(span.center(), 1.06))
    };
    let window = match within {
        Some(window) => window,
        None => Window { x: around(|point| point.x)?, y: around(|point| point.y)? },
    };
    let mut picture = Picture::new(title, x, y, window);
    for (line, points) in curves {
        picture.curve(line, points);
    }
    Some(picture)
}

/// `name [unit]`.
pub fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name} [{unit}]") }
}
