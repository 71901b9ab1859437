//! What accuracy costs: the error of every method over its evaluations, both as powers of ten.
//!
//! Each method is a curve through its tolerances, steps or widths, with its name at the finest; the best
//! choices stand out, and so does the row that is nearest to the method in use.

use super::{Dash, LineStyle, Mark, Marks, Picture, Role};
use crate::accuracy::{Trade, TradePoint};
use crate::flow::{METHODS, Method, MethodSpec};
use crate::scene::Layer;
use crate::session::Session;
use crate::words::{count, significant};

pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    picture.axes("evaluations", "error");
    picture.reading = session.row_under_cursor(index).map(words);
    let Some(found) = session.trade() else { return };
    if session.layers.contains(&Layer::Rows) {
        for spec in METHODS.iter() {
            method(picture, found, spec);
        }
    }
    if session.layers.contains(&Layer::Front) {
        let is_best = |row: &&TradePoint| found.is_best(row, TradePoint::evaluations);
        let at = found.rows.iter().filter(is_best).filter_map(TradePoint::place);
        let marks = Marks::new(Mark::Stable, Role::Special, at);
        picture.marks(Marks { brief: "best choices", ..marks });
    }
    if let Some(at) = found.nearest_to(&session.problem).and_then(TradePoint::place) {
        picture.mark(Mark::Head, at, Role::Cursor);
        picture.caption(at, "now", Role::Cursor);
    }
}

/// A method: its rows, and its name at the finest of them.
fn method(picture: &mut Picture, found: &Trade, spec: &MethodSpec) {
    let (role, dash) = if spec.events {
        (Role::Trajectory, Dash::Solid)
    } else {
        (Role::Beside, Dash::Dotted)
    };
    let own = found.rows.iter().filter(|row| row.problem.method == spec.method);
    let points: Vec<_> = own.filter_map(TradePoint::place).collect();
    // Where auto chooses a method, the curve of that method covers its own.
    if let Some(finest) = points.last().filter(|_| spec.method != Method::Auto) {
        picture.caption(*finest, spec.name, role);
    }
    picture.curve(LineStyle::new(spec.name, role, dash).captioned(), points.iter().copied());
    picture.marks(Marks::new(Mark::Turn, role, points));
}

/// The row under the cursor, in words.
fn words(row: &TradePoint) -> String {
    let error = row.error().map_or_else(String::new, |error| significant(error, 2));
    let (method, evaluations) = (row.problem.method, count(row.cost.evaluations));
    format!("{method} {:e}: error {error}, {evaluations} ev", row.problem.setting())
}
