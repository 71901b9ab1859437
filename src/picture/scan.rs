//! A scan: a curve over one parameter, or a map over two.

use super::{Dash, LineStyle, Mark, Marks, Picture, Role, Scale, ScanMap, map::with_unit, units};
use crate::scan::{Spacing, Sweep};
use crate::scene::Point;
use crate::session::{ScanOnShow, Session};

/// What the numbers along both axes stand for.
pub fn scales(scanned: &ScanOnShow) -> [Scale; 2] {
    let over = scanned.scan.over();
    [0, 1].map(|axis| match over.get(axis) {
        Some(Sweep { spacing: Spacing::Logarithmic, from, .. }) => {
            Scale::Logarithmic(if *from < 0.0 { "-" } else { "" })
        }
        _ => Scale::Even,
    })
}

/// The curve over one parameter, or the map over two.
pub fn draw(picture: &mut Picture, session: &Session) {
    let Some(scanned) = &session.scanned else { return };
    picture.varied = scanned.scan.over().iter().map(|sweep| sweep.symbol).collect();
    let labels: Vec<String> = picture.varied.iter().map(|knob| units::label(*knob)).collect();
    let upward = labels.get(1).cloned().unwrap_or_else(|| with_unit(scanned));
    picture.axes(labels[0].clone(), upward.clone());
    // The lines below the plot say what stands at the cursor.
    (picture.cursor, picture.reading) = (scanned.place(scanned.at), None);
    picture.map = ScanMap::of(scanned);
    if picture.map.is_some() {
        picture.add_to_title(&with_unit(scanned));
    } else {
        curve(picture, scanned, upward);
    }
}

/// The measured number over one parameter; where there is none the curve has a gap.
fn curve(picture: &mut Picture, scanned: &ScanOnShow, name: String) {
    let place = |index| scanned.place(index).unwrap_or(Point::NOWHERE);
    let (all, words) = (0..scanned.rows.len(), scanned.plots_words());
    // Words, and points without neighbours, make no curve.
    let known = |index: usize| scanned.height(index).is_some();
    let joined = |index: usize| (index > 0 && known(index - 1)) || known(index + 1);
    let alone = all.clone().filter(|index| words || (known(*index) && !joined(*index)));
    let marks = Marks::new(Mark::Stable, Role::Trajectory, alone.map(place)).called(name.clone());
    if !words {
        picture.curve(LineStyle::new(name, Role::Trajectory, Dash::Solid), all.map(place));
    }
    picture.marks(marks);
}
