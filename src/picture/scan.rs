//! A scan: a curve over one parameter, or a map over two.

use super::items::{LineStyle, Picture};
use super::map::{ScanMap, measured};
use super::role::{Dash, Role};
use super::ticks::Scale;
use crate::scan::sweep::{Spacing, Sweep};
use crate::scene::Point;
use crate::session::Session;
use crate::session::scan::ScanOnShow;

/// The names of both axes.
pub fn names(scanned: &ScanOnShow) -> (&'static str, &'static str) {
    let over = scanned.scan.over();
    let name = |sweep: &Sweep| sweep.symbol.spec().name;
    (name(&over[0]), over.get(1).map_or_else(|| measured(scanned), name))
}

/// What the numbers along both axes stand for.
pub fn scales(scanned: &ScanOnShow) -> [Scale; 2] {
    let over = scanned.scan.over();
    [0, 1].map(|axis| match over.get(axis) {
        Some(Sweep { spacing: Spacing::Logarithmic, from, .. }) if *from < 0.0 => {
            Scale::NegativeLogarithmic
        }
        Some(Sweep { spacing: Spacing::Logarithmic, .. }) => Scale::Logarithmic,
        _ => Scale::Even,
    })
}

/// The curve over one parameter, or the map over two.
pub fn draw(picture: &mut Picture, session: &Session) {
    let Some(scanned) = &session.scanned else { return };
    let (x, y) = names(scanned);
    picture.axes(x, y);
    picture.varied = scanned.scan.over().iter().map(|sweep| sweep.symbol).collect();
    picture.map = ScanMap::of(scanned);
    if let Some(ScanMap { name, .. }) = picture.map.clone() {
        picture.add_to_title(&name);
    } else {
        let line = LineStyle::new(y, Role::Trajectory, Dash::Solid);
        let points = 0..scanned.rows.len();
        picture.curve(line, points.map(|index| scanned.place(index).unwrap_or(Point::NOWHERE)));
    }
}
