//! Level curves, each with its column and value beside it.

use super::{Dash, LineStyle, Picture, Role};
use crate::scene::Point;
use crate::session::Session;

/// Draws the level curves of a plot over two numbers, and the point of a walk.
pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    for (target, curves) in session.level_curves(index) {
        let name = target.to_string();
        let line = || LineStyle::new(name.clone(), Role::Asymptote, Dash::Solid).captioned();
        for curve in curves {
            let points: Vec<Point> =
                curve.into_iter().map(|values| session.on_axes(index, values)).collect();
            picture.name_curve(&points, &name, &name, Role::Asymptote);
            picture.curve(line(), points);
        }
    }
    let held = session.held.filter(|_| session.plot == index);
    let held = held.and_then(|held| Some(session.on_axes(index, [held.value, held.up?])));
    picture.cursor = held.or(picture.cursor);
}
