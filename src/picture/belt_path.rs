//! The path of the machine on show through a chart of two parameters, while its belt runs slower and faster.
//!
//! The speed of the belt moves all four parameters; a chart shows two of them. What else the chart draws
//! holds at the present values of the other two: where the path runs far from the present point, borders move.

use super::items::{Item, LineStyle, Marks, Picture};
use super::role::{Dash, Mark, Role};
use crate::model::{Knob, Parameters, State};
use crate::scene::machine::path::Station;
use crate::scene::{Point, Running};
use crate::session::Session;
use crate::words::quantity::with_unit;

/// Distance between marks, as a fraction of the window: room for a speed with its unit.
const APART: (f64, f64) = (0.16, 0.07);

/// Distance from the present point below which a mark would lie in its cross.
const CLEAR: f64 = 0.03;

/// What the path stands for, and the marks on it.
const PEN: Role = Role::Velocity;

/// Draws the path over two parameters, if the scene is of a machine.
pub fn draw(picture: &mut Picture, session: &Session, right: Knob, up: Knob) {
    let Some(running) = session.running() else { return };
    let at = |parameters: &Parameters| {
        let value = |symbol: Knob| symbol.get(parameters, &State { q: 0.0, v: 0.0 });
        Point { x: value(right), y: value(up) }
    };
    let place = |(_, parameters): Station| parameters.as_ref().map_or(Point::NOWHERE, at);
    let line = LineStyle::new("over the speed of the belt", PEN, Dash::Dotted);
    let line = line.briefly("path of the belt");
    picture.items.push(Item::Path(line, running.path().into_iter().map(place).collect()));
    let here = at(&session.problem.parameters);
    milestones(picture, &running, here, place);
    let present = at(&running.reduced.parameters);
    let text = with_unit(running.speed, 4, "m/s");
    if present != here {
        // Off the belt: where its speed would have the parameters.
        picture.items.push(milestone(present, running.speed, Role::Current));
    }
    picture.caption(present, text, Role::Current);
}

/// Marks round speeds with their numbers, as far apart as these are wide.
fn milestones(
    picture: &mut Picture,
    running: &Running,
    here: Point,
    place: impl Fn(Station) -> Point,
) {
    let window = picture.window;
    let distance = |one: Point, other: Point| {
        let x = (one.x - other.x).abs() / window.x.width();
        (x, (one.y - other.y).abs() / window.y.width())
    };
    let mut kept: Vec<Point> = Vec::new();
    for station in running.milestones() {
        let (speed, at) = (station.0, place(station));
        let far = |other: &Point| {
            let (x, y) = distance(at, *other);
            x >= APART.0 || y >= APART.1
        };
        let (x, y) = distance(at, here);
        if window.contains(at) && kept.iter().all(far) && x.max(y) >= CLEAR {
            kept.push(at);
            picture.items.push(milestone(at, speed, PEN));
            picture.caption(at, with_unit(speed, 1, "m/s"), PEN);
        }
    }
}

/// The mark of a speed.
fn milestone(at: Point, speed: f64, role: Role) -> Item<'static> {
    let name = format!("v0 = {speed} m/s").into();
    Item::Marks(Marks { name, ..Marks::new(Mark::Turn, role, vec![at]) })
}
