//! A scan over one parameter, as a curve. A map of shades over two is drawn by the screen alone.

use super::items::{LineStyle, Picture};
use super::role::{Dash, Role};
use super::ticks::Scale;
use crate::scene::Point;
use crate::session::Session;
use crate::session::scan::Scanned;
use crate::study::scan::{Spacing, Sweep};

/// The name of what is plotted.
pub fn measured(scanned: &Scanned) -> &'static str {
    scanned.scan.measured().get(scanned.column).copied().unwrap_or_default()
}

/// The names of both axes.
pub fn names(scanned: &Scanned) -> (&'static str, &'static str) {
    let over = scanned.scan.over();
    let name = |sweep: &Sweep| sweep.symbol.spec().name;
    (name(&over[0]), over.get(1).map_or_else(|| measured(scanned), name))
}

/// What the numbers along both axes stand for.
pub fn scales(scanned: &Scanned) -> [Scale; 2] {
    let over = scanned.scan.over();
    [0, 1].map(|axis| match over.get(axis) {
        Some(Sweep { spacing: Spacing::Logarithmic, from, .. }) if *from < 0.0 => {
            Scale::NegativeLogarithmic
        }
        Some(Sweep { spacing: Spacing::Logarithmic, .. }) => Scale::Logarithmic,
        _ => Scale::Even,
    })
}

/// The curve over one parameter as data; a map of shades is for the screen, and its rows for files.
pub fn draw(picture: &mut Picture, session: &Session) {
    let Some(scanned) = &session.scanned else { return };
    let (x, y) = names(scanned);
    picture.axes(x, y);
    picture.varied = scanned.scan.over().iter().map(|sweep| sweep.symbol).collect();
    if !scanned.is_grid() {
        let line = LineStyle::new(y, Role::Trajectory, Dash::Solid);
        let points = 0..scanned.rows.len();
        picture.curve(line, points.map(|index| scanned.place(index).unwrap_or(Point::NOWHERE)));
    }
}
