//! The cycles of a machine over the speed of its belt, each kind drawn in its own way: slip in lines, solid
//! where it is stable and dashed where it is not, stick-slip in thick ones, overtaking dotted; and where a
//! stable state ends, the jump to the one that is left.

use super::items::{Item, Line, Picture};
use super::reading::reading;
use super::role::{Dash, Role};
use crate::machine::Cycle;
use crate::machine::special::{Kind, Special};
use crate::question::speeds::{Speed, Speeds};
use crate::scene::{Layer, Point, View};
use crate::session::{self, Session};
use crate::words::quantity::with_unit;

/// A kind of cycle: what it is called, how it is drawn, and which cycles are of it.
type Row = (&'static str, Role, Option<Dash>, fn(&Cycle) -> bool);

/// All kinds; those without a dash are drawn thick.
const KINDS: [Row; 5] = [
    ("stable slip cycle", Role::Stable, Some(Dash::Solid), |it| {
        it.stable && !it.sticks && !it.overtakes
    }),
    ("unstable slip cycle", Role::Unstable, Some(Dash::Dashed), |it| {
        !it.stable && !it.sticks && !it.overtakes
    }),
    ("stick-slip cycle", Role::Stable, None, |it| it.sticks),
    ("stable overtaking cycle", Role::Velocity, Some(Dash::Dotted), |it| {
        it.stable && it.overtakes && !it.sticks
    }),
    ("unstable overtaking cycle", Role::Unstable, Some(Dash::Sparse), |it| {
        !it.stable && it.overtakes && !it.sticks
    }),
];

/// What the plot with this index shows.
#[must_use]
pub fn picture(session: &Session, index: usize) -> Picture<'_> {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let title = View::Speeds.spec().title;
    let mut picture = Picture::new(format!("{title}, whole model"), "v0 m/s", "x_max m", window);
    picture.reading = cursor.map(|cursor| {
        let (speed, x) = reading(cursor, window);
        format!("v0 {speed} x_max {x}")
    });
    if let Some(running) = session.running() {
        picture.upright(Line::new("present speed", Role::Current, Dash::Sparse), running.speed);
    }
    if session.layers.contains(&Layer::Speeds)
        && let Some(found) = session.speeds(index)
    {
        for row in KINDS {
            cycles(&mut picture, &found.points, row);
        }
        rest(&mut picture, &found.points);
        for special in &found.special {
            changes(&mut picture, found, special);
        }
    }
    picture.cross(cursor);
    picture
}

/// The cycles of a kind: the smallest of it at all speeds are one curve, the next ones another.
fn cycles(picture: &mut Picture, points: &[Speed], (name, role, dash, is): Row) {
    let most = points.iter().map(|at| at.cycles.iter().filter(|it| is(it)).count()).max();
    for rank in 0..most.unwrap_or(0) {
        let place = |at: &Speed| {
            let cycle = at.cycles.iter().filter(|it| is(it)).nth(rank);
            Point { x: at.v0, y: cycle.map_or(f64::NAN, |cycle| cycle.x.1) }
        };
        let places: Vec<Point> = points.iter().map(place).collect();
        match dash {
            Some(dash) => picture.curve(Line::new(name, role, dash), places),
            None => {
                for pair in places.windows(2).filter(|pair| (pair[0].y + pair[1].y).is_finite()) {
                    picture.bar(Line::new(name, role, Dash::Solid), pair[0], pair[1]);
                }
            }
        }
    }
}

/// Rest, where it is stable, and how far its basin goes where the motion that touches the belt borders it.
fn rest(picture: &mut Picture, points: &[Speed]) {
    let stable =
        points.iter().map(|at| Point { x: at.v0, y: if at.rests { 0.0 } else { f64::NAN } });
    picture.curve(Line::new("rest", Role::Sticking, Dash::Solid), stable.collect::<Vec<_>>());
    let touching = points.iter().map(|at| Point { x: at.v0, y: at.touching.unwrap_or(f64::NAN) });
    let line = Line::new("touches the belt", Role::Special, Dash::Dotted);
    picture.curve(line, touching.collect::<Vec<_>>());
}

/// A change, by its letter, and the jump from the state that ends there to the one that is left.
fn changes(picture: &mut Picture, found: &Speeds, special: &Special) {
    let (letter, ends) = match special.kind {
        Kind::Hopf => ("H", None),
        Kind::Grazing => ("G", None),
        Kind::Annihilation => ("A", special.x_max),
        Kind::Overtaking => ("O", None),
        Kind::Unsticking => ("U", None),
        Kind::Fold => ("F", special.x_max),
    };
    let at = special.value;
    // Where rest ends it goes up to the smallest stable cycle of the nearest speed.
    let near = found.points.iter().filter(|point| !point.rests);
    let near = near.min_by(|one, other| (one.v0 - at).abs().total_cmp(&(other.v0 - at).abs()));
    let smallest = near.and_then(|point| point.cycles.iter().find(|cycle| cycle.stable));
    let up = smallest.filter(|_| special.kind == Kind::Hopf).map(|cycle| (0.0, cycle.x.1));
    if let Some((from, to)) = ends.map(|x| (x, 0.0)).or(up) {
        let line = Line::new("jump", Role::Warning, Dash::Dotted);
        picture.curve(line, [from, to].map(|y| Point { x: at, y }));
    }
    picture.items.push(Item::Caption {
        at: Point { x: at, y: special.x_max.unwrap_or(0.0) },
        or_at: Vec::new(),
        long: format!("{letter} {}", with_unit(at, 4, "m/s")).into(),
        short: letter.into(),
        role: Role::Special,
    });
}
