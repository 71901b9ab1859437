//! The motion over time: displacement, velocity, force of dry friction, energy.
//!
//! Displacement and energy change smoothly through the turning points, where the force of friction
//! jumps from one end of `[-r, r]` to the other; at rest it is what the spring asks for.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::Dash;
use super::look::{Look, Role};
use super::number::resolved;
use super::pane::Heading;
use super::plot::{CELLS, Names, Plot};
use crate::flow::{Outcome, Trajectory};
use crate::oscillator::State;
use crate::oscillator::energy::energy;
use crate::scene::{Layer, Point, View};
use crate::session::motion::friction_force;
use crate::session::{self, Pane, Session};

/// A quantity over time: its layer, its letter, how it is drawn, and how it is read from a state.
type Quantity = (Layer, &'static str, Role, Dash, fn(State) -> f64);

/// The smooth quantities.
const QUANTITIES: [Quantity; 3] = [
    (Layer::Energy, "V", Role::Energy, Dash::Dotted, energy),
    (Layer::Velocity, "v", Role::Velocity, Dash::Dashed, |state| state.v),
    (Layer::Position, "q", Role::Trajectory, Dash::Solid, |state| state.q),
];

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let shows = |layer| session.layers.contains(&layer);
    let shown = || QUANTITIES.iter().rev().filter(|(layer, ..)| shows(*layer));
    let friction = shows(Layer::Friction).then_some("f");
    let letters: Vec<&str> = shown().map(|(_, letter, ..)| *letter).chain(friction).collect();
    let names = Names { title: View::TimeSeries.spec().title, x: "tau", y: &letters.join(" ") };
    let mut heading = Heading::of(session, Pane::Plot(index));
    heading.reading = cursor.map(|Point { x: tau, .. }| {
        let time = format!("tau {}", resolved(tau, window.x.width() / CELLS));
        let value = |value: f64| resolved(value, window.y.width() / CELLS);
        let Some(state) = session.state_at(tau) else { return time };
        shown().fold(time, |line, (_, letter, .., read)| {
            format!("{line} {letter} {}", value(read(state)))
        })
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    plot.function(Role::Axis, Dash::Sparse, |_| Some(0.0));
    if let Some(motion) = session.trajectory() {
        let end = motion.problem.until;
        if shows(Layer::Friction) {
            let force = friction_force(motion, end);
            let first = force.first().copied();
            let points = force.into_iter().map(|(x, y)| Point { x, y });
            plot.curve(points, Role::Sticking, Dash::Solid);
            label(&mut plot, first, "f", Role::Sticking);
        }
        for (layer, letter, role, dash, read) in QUANTITIES {
            if shows(layer) {
                plot.curve(curve(motion, end, read), role, dash);
                let first = motion.samples.first();
                let first = first.map(|s| (s.tau, read(State { q: s.q, v: s.v })));
                label(&mut plot, first, letter, role);
            }
        }
        if shows(Layer::Events) {
            events(&mut plot, motion, look);
        }
    }
    if let Some(cursor) = cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

/// A quantity along a motion, and on while it rests.
fn curve(motion: &Trajectory, end: f64, read: fn(State) -> f64) -> Vec<Point> {
    let mut points: Vec<Point> = motion
        .samples
        .iter()
        .map(|sample| Point { x: sample.tau, y: read(State { q: sample.q, v: sample.v }) })
        .collect();
    if let Outcome::Captured { tau, q } = motion.outcome {
        let y = read(State { q, v: 0.0 });
        points.extend([Point { x: tau, y }, Point { x: end, y }]);
    }
    points
}

/// The letter of a curve, where it begins.
fn label(plot: &mut Plot, first: Option<(f64, f64)>, letter: &str, role: Role) {
    if let Some((x, y)) = first {
        plot.caption(Point { x, y }, letter, role);
    }
}

/// The turning points, where they stand apart, and how the motion ends.
fn events(plot: &mut Plot, motion: &Trajectory, look: &Look) {
    /// Columns between marks.
    const APART: usize = 4;
    let symbols = look.symbols();
    if motion.crossings.len() * APART <= usize::from(plot.inner().width) {
        for crossing in &motion.crossings {
            let point = Point { x: crossing.tau, y: crossing.q };
            plot.mark(point, symbols.start, Role::Trajectory);
        }
    }
    match motion.outcome {
        Outcome::Captured { tau, q } => {
            plot.mark(Point { x: tau, y: q }, symbols.rest, Role::Trajectory);
        }
        Outcome::Moving { tau, q, .. } => {
            plot.mark(Point { x: tau, y: q }, symbols.head, Role::Trajectory);
        }
        Outcome::Escaped { tau } => plot.upright(tau, Role::Unstable, Dash::Sparse),
        Outcome::GaveUp { .. } => {}
    }
}
