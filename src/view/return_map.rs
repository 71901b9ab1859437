//! The return map: the next turning point on the same side, over a turning point.
//!
//! Where the map crosses the diagonal it has a cycle; where it enters the shaded band the motion comes
//! to rest. The turning points of the motion climb and descend between map and diagonal as a cobweb.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::Dash;
use super::look::{Look, Role};
use super::pane::Heading;
use super::plot::{Names, Plot, reading};
use crate::flow::Outcome;
use crate::scene::{Layer, Point, View};
use crate::session::motion::turning_points;
use crate::session::{self, Pane, Session};

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let names = Names { title: View::ReturnMap.spec().title, x: "q", y: "next q" };
    let mut heading = Heading::of(session, Pane::Plot(index));
    heading.reading = cursor.map(|cursor| {
        let (q, next) = reading(cursor, window);
        format!("q {q} next {next}")
    });
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);
    let r = session.problem.parameters.r;

    if shows(Layer::Map) && r > 0.0 {
        plot.shade_where(Role::Basin, |Point { x, y }| y.abs() <= r || x.abs() <= r);
    }
    plot.function(Role::Axis, Dash::Sparse, Some);
    if shows(Layer::Map)
        && let Some(found) = session.return_map(index)
    {
        for side in &found.sides {
            let points =
                side.iter().map(|turn| Point { x: turn.from, y: turn.to.unwrap_or(f64::NAN) });
            plot.curve(points, Role::Map, Dash::Solid);
        }
        // Whoever rests there stays there.
        let held = found.parameters.r;
        plot.bar(Point { x: -held, y: -held }, Point { x: held, y: held }, Role::Sticking);
    }
    if shows(Layer::Cobweb) {
        cobweb(&mut plot, session, look);
    }
    if shows(Layer::FixedPoints) {
        let [stable, unstable] = look.symbols().points;
        for cycle in session.cycles().into_iter().flat_map(|found| &found.cycles) {
            let (symbol, role) =
                if cycle.stable { (stable, Role::Stable) } else { (unstable, Role::Unstable) };
            for turning in [cycle.q_min, cycle.q_max] {
                plot.mark(Point { x: turning, y: turning }, symbol, role);
            }
        }
    }
    if let Some(cursor) = cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

/// The turning points of the motion, each side for itself: up or down to the map, across to the diagonal.
fn cobweb(plot: &mut Plot, session: &Session, look: &Look) {
    let Some(motion) = session.trajectory() else { return };
    let points = turning_points(motion);
    let symbols = look.symbols();
    let rest = match motion.outcome {
        Outcome::Captured { q, .. } => Some(q),
        _ => None,
    };
    for side in 0..2 {
        let mut turns: Vec<f64> = points.iter().skip(side).step_by(2).copied().collect();
        // The side on which the motion does not come to rest learns of it too.
        if let Some(rest) = rest.filter(|rest| turns.last().is_some_and(|last| last != rest)) {
            turns.push(rest);
        }
        let steps = turns.windows(2).flat_map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            [Point { x: from, y: to }, Point { x: to, y: to }]
        });
        let first = turns.first().map(|q| Point { x: *q, y: *q });
        let path: Vec<Point> = first.into_iter().chain(steps).collect();
        plot.curve(path, Role::Trajectory, Dash::Solid);
        if let Some(start) = first {
            plot.mark(start, symbols.start, Role::Trajectory);
        }
    }
    if let Some(q) = rest {
        plot.mark(Point { x: q, y: q }, symbols.rest, Role::Trajectory);
    }
}
