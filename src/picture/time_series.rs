//! The motion over time: displacement, velocity, force of dry friction, energy.
//!
//! Displacement and energy change smoothly through the turning points, where the force of friction
//! jumps from one end of `[-r, r]` to the other; at rest it balances the spring.

use super::phase_plane;
use super::{Dash, LineStyle, Mark, Marks, Picture, Role, Scale, fit::mark_dropped, units::said};
use crate::fit::Signal;
use crate::flow::{Motion, Outcome, Sample};
use crate::model::{State, energy};
use crate::scene::{Layer, Point};
use crate::session::{Session, motion::friction_force};

/// A quantity over time: its layer, its letter, its name, and how it is read from a state.
type Quantity = (Layer, &'static str, &'static str, fn(State) -> f64);

const QUANTITIES: [Quantity; 3] = [
    (Layer::Energy, "V", "energy V", energy),
    (Layer::Velocity, "v", "velocity v", |state| state.v),
    (Layer::Position, "q", "displacement q", |state| state.q),
];

pub fn draw(picture: &mut Picture, session: &Session) {
    let (window, [time, upward]) = (picture.window, picture.scales);
    let shows = |layer| session.layers.contains(&layer);
    let shown = || quantities_on_show(session).rev();
    let friction = shows(Layer::Friction).then_some("f");
    let letters: Vec<&str> = shown().map(|(_, letter, ..)| letter).chain(friction).collect();
    picture.axes("tau", letters.join(" "));
    picture.reading = picture.cursor.map(|Point { x: tau, .. }| {
        let time = said(time, "tau", tau, window.x);
        let Some(state) = session.state_at(tau) else { return time };
        shown().fold(time, |line, (_, letter, .., read)| {
            format!("{line} {}", said(upward, letter, read(state), window.y))
        })
    });
    picture.level(LineStyle::guide(), 0.0);
    if shows(Layer::Record) {
        record(picture, session);
    }
    for (place, beside) in session.motions().into_iter().filter(|(place, _)| *place > 0) {
        quantities(picture, session, beside, place);
    }
    // In the whole model the belt holds the mass too: the force of the guide alone is not known.
    let whole = session.draws_whole();
    let force = session.trajectory().filter(|_| shows(Layer::Friction) && !whole);
    let force = force.map(|motion| friction_force(motion, motion.problem.until));
    let until = session.drawn_until().map_or(f64::INFINITY, |head| head.tau);
    if let Some(force) = &force {
        let so_far = force.iter().copied().take_while(|(tau, _)| *tau <= until);
        let now = force_at(force, until).map(|now| (until, now));
        picture.curve("friction force f", so_far.chain(now.filter(|_| until.is_finite())));
        if let Some(first) = force.first() {
            picture.caption(*first, "f", Role::Sticking);
        }
    }
    if let Some(motion) = session.trajectory() {
        quantities(picture, session, motion, 0);
        if shows(Layer::Events) {
            events(picture, motion, until);
        }
    }
    if let Some(head) = session.head() {
        picture.upright(LineStyle::new("", Role::Cursor, Dash::Sparse), head.tau);
        for (.., read) in quantities_on_show(session) {
            picture.mark(Mark::Head, at(&head, read), Role::Cursor);
        }
        if let Some(y) = force.and_then(|force| force_at(&force, head.tau)) {
            picture.mark(Mark::Head, [head.tau, y], Role::Cursor);
        }
    }
}

fn quantities_on_show(session: &Session) -> impl DoubleEndedIterator<Item = Quantity> {
    QUANTITIES.into_iter().filter(|(layer, ..)| session.layers.contains(layer))
}

/// What was measured. An acceleration is none of the quantities on show.
fn record(picture: &mut Picture, session: &Session) {
    let Some(fitted) = session.fitted() else { return };
    let signal = fitted.record.signal;
    let (layer, name) = match signal {
        Signal::Displacement => (Layer::Position, "record"),
        Signal::Velocity => (Layer::Velocity, "record of v"),
        Signal::Acceleration => return,
    };
    if !session.layers.contains(&layer) {
        return;
    }
    let samples = fitted.points.iter();
    let all =
        samples.filter_map(|it| Some((Point { x: it.tau, y: it.shown(signal)? }, it.dropped)));
    picture.curve(name, all.clone().filter(|(_, why)| why.is_none()).map(|(at, _)| at));
    mark_dropped(picture, all.filter_map(|(at, why)| Some((at, why?))));
}

/// The quantities of the motion in this place among those on show, the present one the first.
fn quantities(picture: &mut Picture, session: &Session, motion: &Motion, place: usize) {
    let LineStyle { name: of, role: beside, .. } = phase_plane::motion(session, place);
    for (layer, mut letter, mut name, read) in quantities_on_show(session) {
        let points: Vec<Point> =
            session.seen(place, motion).map(|sample| at(&sample, read)).collect();
        let Some(first) = points.first().copied() else { continue };
        let end = points.iter().rfind(|at| picture.window.contains(**at)).copied();
        // A displacement in metres has its own letter.
        let metres = layer == Layer::Position && matches!(picture.scales[1], Scale::Times { .. });
        if metres {
            (letter, name) = ("x", "displacement x");
        }
        let mut line = LineStyle::from(name);
        if place > 0 {
            let name = format!("{}, {of}", line.name);
            line = LineStyle::new(name, beside, line.dash).briefly("other motions");
        }
        let role = line.role;
        picture.curve(line, points);
        let mut stuck = LineStyle::from("sticks");
        if place > 0 {
            stuck = LineStyle { role, ..stuck.captioned() };
        }
        for stretch in session.sticking(place, motion) {
            picture.curve(stuck.clone(), stretch.map(|end| at(&end, read)));
        }
        let number = session.tag(place);
        if let Some((number, end)) = number.clone().zip(end) {
            picture.caption(end, number, role);
        }
        let number = number.filter(|_| place > 0);
        picture.caption(first, number.unwrap_or(letter.to_owned()), role);
    }
}

/// The force at a time on its polyline; where it jumps, the force after the jump.
fn force_at(force: &[(f64, f64)], tau: f64) -> Option<f64> {
    let after = force.partition_point(|(at, _)| *at <= tau);
    let (before, next) = (force.get(after.checked_sub(1)?)?, force.get(after));
    let rise = |next: &(f64, f64)| (tau - before.0) / (next.0 - before.0) * (next.1 - before.1);
    Some(before.1 + next.map_or(0.0, rise))
}

/// A quantity at a moment of the motion.
fn at(sample: &Sample, read: fn(State) -> f64) -> Point {
    Point { x: sample.tau, y: read(sample.state()) }
}

/// The turning points up to a moment, where they stand apart, and how the motion ends if that is not later.
fn events(picture: &mut Picture, motion: &Motion, until: f64) {
    let turns = motion.crossings.iter().take_while(|turn| turn.tau <= until);
    let turns = turns.map(|turn| [turn.tau, turn.q]);
    let marks = Marks::new(Mark::Turn, Role::Trajectory, turns);
    picture.marks(Marks { sparse: true, ..marks });
    if until.is_finite() {
        return;
    }
    match motion.outcome {
        Outcome::Captured { tau, q } => picture.mark(Mark::Rest, [tau, q], Role::Trajectory),
        Outcome::Moving { tau, q, .. } => picture.mark(Mark::Head, [tau, q], Role::Trajectory),
        Outcome::Escaped { tau } => picture.upright("escapes", tau),
        Outcome::GaveUp { .. } => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_is_read_between_its_corners_and_after_its_jumps() {
        let force = [(0.0, 0.5), (2.0, 0.5), (2.0, -0.5), (3.0, -0.5), (3.0, 0.1), (9.0, 0.1)];
        for (tau, expected) in [(0.0, 0.5), (1.9, 0.5), (2.0, -0.5), (3.0, 0.1), (9.0, 0.1)] {
            assert_eq!(force_at(&force, tau), Some(expected), "{tau}");
        }
        assert_eq!(force_at(&[(1.0, 0.2), (3.0, 0.6)], 2.0), Some(0.4));
        assert_eq!((force_at(&force, -1.0), force_at(&[], 1.0)), (None, None));
    }
}
