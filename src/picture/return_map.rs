//! The return map: the next turning point on the same side, over a turning point.
//!
//! Where the map crosses the diagonal it has a cycle; where it enters the shaded band the motion comes
//! to rest. The turning points of the motion climb and descend between map and diagonal as a cobweb.

use super::phase_plane::{self, sticking_set};
use super::{
    Item, LineStyle, Mark, Marks, Picture, Role, Scale, cycle_mark, cycle_name, cycle_role,
    units::said,
};
use crate::flow::{Motion, Outcome};
use crate::scene::Layer;
use crate::session::{Session, motion::turning_points};

pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    picture.axes("q", "next q");
    picture.reading = picture.cursor.map(|at| {
        let read = |name, value, span| said(Scale::Even, name, value, span);
        let window = picture.window;
        format!("{} {}", read("q", at.x, window.x), read("next", at.y, window.y))
    });
    let shows = |layer| session.layers.contains(&layer);
    let r = session.problem.parameters.r;

    if shows(Layer::Map) && r > 0.0 {
        let rest = || LineStyle::from("at rest there");
        picture.items.extend([Item::Rows(rest(), -r, r), Item::Columns(rest(), -r, r)]);
    }
    picture.graph("diagonal", Some);
    if shows(Layer::Map)
        && let Some(found) = session.return_map(index)
    {
        for side in &found.sides {
            let points = side.iter().map(|turn| [turn.from, turn.to.unwrap_or(f64::NAN)]);
            picture.curve("next turning point", points);
        }
        // A mass at rest there stays there.
        let held = found.parameters.r;
        picture.curve(sticking_set(held), [-held, held].map(|q| [q, q]));
    }
    if shows(Layer::Cobweb) {
        cobweb(picture, session);
    }
    if shows(Layer::FixedPoints) {
        let cycles = session.cycles().filter(|_| !session.draws_whole());
        for cycle in cycles.into_iter().flat_map(|found| &found.cycles) {
            let (mark, role) = (cycle_mark(cycle.stable), cycle_role(cycle.stable));
            let turning = [cycle.q_min, cycle.q_max].map(|q| [q, q]);
            let brief = cycle_name(cycle.stable);
            picture.marks(Marks { brief, ..Marks::new(mark, role, turning) });
        }
    }
}

/// The turning points of the motion, each side for itself: up or down to the map, across to the diagonal.
fn cobweb(picture: &mut Picture, session: &Session) {
    // The map is that of the cubic expansion.
    if !session.draws_whole() {
        // The present one over the others.
        for (place, motion) in session.motions().into_iter().rev() {
            turns(picture, motion, &phase_plane::motion(session, place));
        }
    }
}

/// Those of one motion, drawn like it.
fn turns(picture: &mut Picture, motion: &Motion, like: &LineStyle) {
    let points = turning_points(motion);
    let rest = match motion.outcome {
        Outcome::Captured { q, .. } => Some(q),
        _ => None,
    };
    for side in 0..2 {
        let mut turns: Vec<f64> = points.iter().skip(side).step_by(2).copied().collect();
        // The side on which the motion does not come to rest gets that point too.
        if let Some(rest) = rest.filter(|rest| turns.last().is_some_and(|last| last != rest)) {
            turns.push(rest);
        }
        let steps = turns.windows(2).flat_map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            [[from, to], [to, to]]
        });
        let first = turns.first().map(|q| [*q, *q]);
        let line = LineStyle::new(format!("{}, turn by turn", like.name), like.role, like.dash);
        let brief = if like.role == Role::Beside {
            "other motions"
        } else {
            "motion"
        };
        picture.curve(line.briefly(brief), first.into_iter().chain(steps));
        if let Some(start) = first {
            picture.mark(Mark::Start, start, like.role);
        }
    }
    if let Some(q) = rest {
        picture.mark(Mark::Rest, [q, q], like.role);
    }
}
