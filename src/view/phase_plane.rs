//! The phase plane: where motions go, where they rest, and what separates those that do.
//!
//! Layers from back to front: directions of the flow, shading of the basin, borders of the capture bands,
//! the point left for a mark, the line `v = 0`, the Lyapunov circle, the motion, cycles, the sticking set, markers, cursor. Formulas show the present
//! parameters; what had to be computed shows the last answer, and the title says if it is old.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::Dash;
use super::look::{Look, Role};
use super::pane::Heading;
use super::plot::{Names, Plot, reading};
use crate::closed_form::lyapunov;
use crate::flow::Outcome;
use crate::oscillator::{HalfPlane, Side, State};
use crate::scene::{Layer, Point, View};
use crate::session::{self, Pane, Session};

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let names = Names { title: View::Phase.spec().title, x: "q", y: "v" };
    let mut heading = Heading::of(session, Pane::Plot(index));
    heading.reading = cursor.map(|cursor| {
        let (q, v) = reading(cursor, window);
        format!("q {q} v {v}")
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);

    if shows(Layer::Field) {
        plot.arrows(Role::Field, |point| flow(session, point));
    }
    if shows(Layer::Basin) {
        basin(&mut plot, session);
    }
    if shows(Layer::Bands) {
        for border in session.borders(index).iter().flat_map(|found| &found.curves) {
            plot.curve(border.iter().map(point), Role::Bands, Dash::Dotted);
        }
    }
    if shows(Layer::Ghost) {
        ghost(&mut plot, session);
    }
    plot.function(Role::Axis, Dash::Sparse, |_| Some(0.0));
    if shows(Layer::Lyapunov) {
        circle(&mut plot, session);
    }
    if shows(Layer::Trajectory) {
        trajectory(&mut plot, session);
    }
    if shows(Layer::Cycles) {
        cycles(&mut plot, session);
    }
    if shows(Layer::Balance) {
        for found in session.balance().iter().flat_map(|balance| &balance.balanced) {
            plot.curve(found.curve.iter().map(point), Role::Harmonic, Dash::Dotted);
        }
    }
    if shows(Layer::Sticking) {
        let r = session.problem.parameters.r;
        plot.bar(Point { x: -r, y: 0.0 }, Point { x: r, y: 0.0 }, Role::Sticking);
    }
    if shows(Layer::Trajectory) {
        ends(&mut plot, session, look);
    }
    if let Some(cursor) = cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

fn point(state: &State) -> Point {
    Point { x: state.q, y: state.v }
}

/// Direction of the flow (equation 8); on `v = 0` it is that of the upper side.
fn flow(session: &Session, Point { x: q, y: v }: Point) -> Point {
    let parameters = &session.problem.parameters;
    let side = if v < 0.0 { Side::Lower } else { Side::Upper };
    let field = HalfPlane::new(parameters, side);
    let (position, speed) = (side.position(q, parameters.r), side.sign() * v);
    Point { x: v, y: side.sign() * field.acceleration(position, speed) }
}

/// The shaded basin of the sticking set, if it has an edge.
fn basin(plot: &mut Plot, session: &Session) {
    let Some(picture) = session.cycles().and_then(|found| found.picture.as_ref()) else { return };
    let edge: Vec<Point> = picture.edge.iter().map(point).collect();
    if !edge.is_empty() {
        plot.shade(&edge, Role::Basin);
        plot.curve(edge, Role::Unstable, Dash::Dashed);
    }
}

fn circle(plot: &mut Plot, session: &Session) {
    /// Corners of the polygon that stands for the circle.
    const CORNERS: u16 = 180;
    if let Some(radius) = lyapunov::radius(&session.problem.parameters) {
        let corners = (0..=CORNERS).map(|corner| {
            let (sin, cos) =
                (std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
            Point { x: radius * cos, y: radius * sin }
        });
        plot.curve(corners, Role::Lyapunov, Dash::Dotted);
    }
}

fn trajectory(plot: &mut Plot, session: &Session) {
    if let Some(found) = session.trajectory() {
        let samples = found.samples.iter().map(|sample| Point { x: sample.q, y: sample.v });
        plot.curve(samples, Role::Trajectory, Dash::Solid);
    }
}

fn cycles(plot: &mut Plot, session: &Session) {
    let Some(found) = session.cycles() else { return };
    let curves = found.picture.iter().flat_map(|picture| &picture.curves);
    for (cycle, curve) in found.cycles.iter().zip(curves) {
        let (role, dash) = stability(cycle.stable);
        plot.curve(curve.iter().map(point), role, dash);
    }
}

/// Motion and cycles of the point that was left for a mark.
fn ghost(plot: &mut Plot, session: &Session) {
    let Some(left) = &session.marks.left else { return };
    if let Some(found) = left.trajectory() {
        let samples = found.samples.iter().map(|sample| Point { x: sample.q, y: sample.v });
        plot.curve(samples, Role::Ghost, Dash::Dotted);
    }
    let picture = left.cycles().and_then(|found| found.picture.as_ref());
    for curve in picture.iter().flat_map(|picture| &picture.curves) {
        plot.curve(curve.iter().map(point), Role::Ghost, Dash::Dashed);
    }
}

/// How stable and unstable cycles are drawn, here and in the diagram.
#[must_use]
pub fn stability(stable: bool) -> (Role, Dash) {
    if stable { (Role::Stable, Dash::Solid) } else { (Role::Unstable, Dash::Dashed) }
}

/// Where the motion starts, and where it is in the end.
fn ends(plot: &mut Plot, session: &Session, look: &Look) {
    let symbols = look.symbols();
    if let Some(found) = session.trajectory() {
        match found.outcome {
            Outcome::Captured { q, .. } => {
                plot.mark(Point { x: q, y: 0.0 }, symbols.rest, Role::Trajectory);
            }
            Outcome::Moving { q, v, .. } => {
                plot.mark(Point { x: q, y: v }, symbols.head, Role::Trajectory);
            }
            Outcome::Escaped { .. } | Outcome::GaveUp { .. } => {}
        }
    }
    plot.mark(point(&session.problem.initial), symbols.start, Role::Trajectory);
}
