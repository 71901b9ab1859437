//! The mass on its belt (Fig. 1), where the motion has it at the moment that is played.
//!
//! Along the horizontal axis everything is in the units of the motion: the mass is at its displacement
//! from static equilibrium, the marks of the belt move with its speed. The vertical axis has no meaning.

use super::{Dash, LineStyle, Picture, Role};
use crate::flow::Sample;
use crate::scene::{Layer, Point, Span, rectangle};
use crate::session::Session;
use crate::words::{Notation, with_unit};

/// Heights of the surfaces of the belt, from below.
const BELT: (f64, f64) = (0.12, 0.26);

/// Heights of the mass, which lies on the belt.
const MASS: [f64; 2] = [BELT.1, 0.86];

/// Height of the axis of the spring.
const SPRING: f64 = 0.74;

/// Height of the axis of the damper.
const DAMPER: f64 = 0.48;

/// Height of the bar of the sticking set.
const REST: f64 = 0.03;

/// Half the height of spring and damper.
const HALF: f64 = 0.06;

const COILS: u32 = 9;

/// Width of the mass, as a fraction of the window.
const WIDTH: f64 = 0.14;

/// Ends of the cylinder of the damper, and its piston at rest, as fractions of the way from the wall to the
/// mass at rest.
const CYLINDER: (f64, f64) = (0.15, 0.75);
const PISTON: f64 = 0.45;

/// Marks on each surface of the belt.
const MARKS: u16 = 8;

/// Gap between the marks of the belt, as a fraction of the window.
const GAP: f64 = 1.0 / 8.0;

/// Length of the arrow of the belt's friction at rest, as a fraction of the window.
const ARROW: f64 = 0.16;

/// Its greatest length, whatever the friction.
const LONGEST: f64 = 0.5;

pub fn draw(picture: &mut Picture, session: &Session) {
    picture.axes("q", "");
    // Before the motion is played, its start.
    let moment = session.head().or_else(|| session.trajectory()?.at(0.0));
    // The cursor points to a position only.
    let pointed = picture.cursor.map(|Point { x: q, .. }| Sample { tau: 0.0, q, v: 0.0 });
    picture.reading = pointed.or(moment).map(|moment| reading(session, &moment));
    if session.layers.contains(&Layer::Mass)
        && let Some(moment) = moment
    {
        machine(picture, session, &moment);
    }
}

/// The moment in numbers, physical ones where the scene is of a machine.
fn reading(session: &Session, moment: &Sample) -> String {
    let Sample { tau, q, v } = *moment;
    let notation = Notation(session.running().map(|running| running.reduced.units));
    let (time, place) = (notation.name("tau", "t"), notation.name("q", "x"));
    let (tau, q, v) = (notation.time(tau, 3), notation.length(q, 3), notation.velocity(v, 3));
    format!("{time} {tau}  {place} {q}  v {v}")
}

fn machine(picture: &mut Picture, session: &Session, moment: &Sample) {
    let across = picture.window.x;
    let (wall, width) = (across.from(), across.width());
    let sticking = session.running().map(|running| running.reduced.sticking_velocity);
    belt(picture, across, sticking.unwrap_or(0.0) * moment.tau);
    let half = 0.5 * WIDTH * width;
    let (left, right) = (moment.q - half, moment.q + half);
    let r = session.problem.parameters.r;
    picture.curve("where the mass may rest", [[-r, REST], [r, REST]]);
    picture.curve("spring", spring(wall, left));
    for piece in damper(wall, -half, left) {
        picture.curve("damper", piece);
    }
    picture.curve("mass", rectangle([left, right], MASS));
    picture.caption([moment.q, f64::midpoint(MASS[0], MASS[1])], "m", Role::Trajectory);
    let rides = |ride: &[Sample; 2]| (ride[0].tau..=ride[1].tau).contains(&moment.tau);
    if let Some(ride) = session.trajectory().and_then(|motion| motion.rides().find(rides)) {
        let line = LineStyle::new("sticks to the belt", Role::Current, Dash::Thick);
        picture.curve(line.captioned(), [[left, BELT.1], [right, BELT.1]]);
        let below = [ride[0].q.max(across.from()), f64::midpoint(BELT.0, BELT.1)];
        picture.caption(below, "sticks", Role::Current);
    }
    arrow(picture, session, moment);
}

/// The pull of the belt on the mass: an arrow above it, moved and shortened where it would leave the window.
fn arrow(picture: &mut Picture, session: &Session, moment: &Sample) {
    let Some(running) = session.running() else { return };
    let Some(pull) = running.pull(moment.v) else { return };
    let (across, y) = (picture.window.x, MASS[1] + HALF);
    let longest = LONGEST * across.width();
    let way = (pull * ARROW * across.width()).clamp(-longest, longest);
    let edge = 0.5 * (across.width() - way.abs());
    let middle = moment.q.clamp(across.center() - edge, across.center() + edge);
    let (tail, tip) = (middle - 0.5 * way, middle + 0.5 * way);
    let barb = tip - (0.15 * ARROW * across.width()).copysign(way);
    let points = [(tail, y), (tip, y), (barb, y + 0.5 * HALF), (tip, y), (barb, y - 0.5 * HALF)];
    picture.curve("friction of the belt", points);
    let text = with_unit(pull * running.reduced.units.force, 3, "N");
    picture.caption([tail, y], text, Role::Special);
}

/// The belt, its marks moved by `way` to the right above and to the left below.
fn belt(picture: &mut Picture, across: Span, way: f64) {
    let (low, high) = BELT;
    for y in [low, high] {
        picture.curve("belt", [[across.from(), y], [across.to(), y]]);
    }
    let gap = GAP * across.width();
    let tick = 0.35 * (high - low);
    for (way, from, to) in [(way, high, high - tick), (-way, low, low + tick)] {
        let first = across.from() + way.rem_euclid(gap);
        for number in 0..MARKS {
            let x = first + f64::from(number) * gap;
            picture.curve("mark of the belt", [[x, from], [x, to]]);
        }
    }
}

/// The zigzag of a spring between two places.
fn spring(from: f64, to: f64) -> Vec<Point> {
    let coils = f64::from(COILS);
    let at = |part: f64, y: f64| Point { x: from + part * (to - from), y };
    let teeth = (0..COILS).map(|tooth| {
        let side = if tooth % 2 == 0 { HALF } else { -HALF };
        at((f64::from(tooth) + 1.0) / (coils + 1.0), SPRING + side)
    });
    std::iter::once(at(0.0, SPRING)).chain(teeth).chain([at(1.0, SPRING)]).collect()
}

/// The cylinder of a damper at the wall, and the rod with its piston at the mass, whose left side is at
/// `mass` and without motion at `rest`.
fn damper(wall: f64, rest: f64, mass: f64) -> [Vec<Point>; 3] {
    let at = |x: f64, y: f64| Point { x, y: DAMPER + y };
    // A window that begins beyond the mass shows no wall.
    let gap = (rest - wall).max(0.0);
    let (start, end) = (wall + CYLINDER.0 * gap, wall + CYLINDER.1 * gap);
    let piston = (wall + PISTON * gap + mass - rest).clamp(start, end);
    [
        vec![at(wall, 0.0), at(start, 0.0)],
        vec![at(end, HALF), at(start, HALF), at(start, -HALF), at(end, -HALF)],
        vec![at(piston, 0.8 * HALF), at(piston, -0.8 * HALF), at(piston, 0.0), at(mass, 0.0)],
    ]
}
