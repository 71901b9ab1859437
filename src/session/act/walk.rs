//! Walking along the branch: a point is held, moved, and used as the start of the motion.

use crate::model::State;
use crate::numerics::{hypot, shortest};
use crate::scene::{Axes, Layer, Point, Topic, View};
use crate::session::act::parameters::change;
use crate::session::act::scan;
use crate::session::read::walk::BranchPath;
use crate::session::{BranchStop, Done, Pane, Plot, Session};

/// Begins a walk on a branch, a boundary or a level curve: at the cursor if there is one, otherwise at the present value.
pub fn take_hold(session: &mut Session) -> Done {
    let stop = first(session).map_err(|why| session.with_keys(why))?;
    session.held = Some(stop);
    Ok(())
}

fn first(session: &Session) -> Result<BranchStop, &'static str> {
    let index = session.plot;
    let Plot { view, axes: Axes { abscissa, .. }, window, cursor, .. } = &session.plots[index];
    let is_diagram = *view == View::Diagram;
    if is_diagram && !session.shows_in(Layer::Branch, index) {
        return Err("the branch is not shown: {layers} lists the layers");
    }
    let way = session.path(index);
    if is_diagram && (way.is_empty() || !session.is_fresh(Topic::Branch, index)) {
        return Err("the branch is not known: its computation gave up");
    }
    let values = session.numbers_over(index).into_iter().map(|knob| session.value(knob));
    let present = <[f64; 2]>::try_from(values.collect::<Vec<_>>());
    let present = present.ok().map(|values| session.on_axes(index, values));
    let found = if let Some(at) = cursor.or(present) {
        way.nearest(|stop| {
            let of = session.height(index, stop.variant);
            let height = stop.cycle.map_or(window.y.to(), |cycle| of.of(stop.value, &cycle));
            let flat = Point { x: stop.value, y: height };
            let place = stop.up.map_or(flat, |up| session.on_axes(index, [stop.value, up]));
            let across = window.x.fraction(place.x) - window.x.fraction(at.x);
            hypot(across, window.y.fraction(place.y) - window.y.fraction(at.y))
        })
    } else {
        // The branch of the present motion, if the plot shows that, too.
        let shown = session.shown(index);
        let present = shown.iter().position(|shown| shown.problem == session.problem);
        let own = session.branches(index).into_iter();
        let own = own.filter(|(variant, _)| Some(*variant) == present);
        let own = BranchPath::along(&own.collect::<Vec<_>>());
        let value = session.value(*abscissa);
        own.start(value).or_else(|| way.start(value))
    };
    found.ok_or(if is_diagram {
        "there is no cycle in this diagram to take hold of"
    } else {
        "no boundary and no level curve to take hold of: {prompt}level impulse=0.2 draws one"
    })
}

/// Moves `count` points along the held piece of the branch.
pub fn go(session: &mut Session, count: isize) {
    if !moved(session, |way, held| way.further(held, count)) {
        let text = "the branch ends here; {walk-to-next} leads to the next special point or end";
        session.inform_of_keys(text);
    }
}

/// Moves to the next special point or end of a piece.
pub fn go_to_landmark(session: &mut Session, onward: bool) {
    moved(session, |way, held| way.landmark(held, onward));
}

/// Holds another point; returns whether it differs.
fn moved(
    session: &mut Session,
    choose: impl Fn(&BranchPath, &BranchStop) -> Option<BranchStop>,
) -> bool {
    let Some(held) = session.held else { return false };
    let found = choose(&session.path(session.plot), &held).unwrap_or(held);
    session.held = Some(found);
    found != held
}

/// Sets the parameter to the value at the held point and starts the motion on its cycle, as one change. On the
/// branch of a variant, this also sets the values that the variant holds.
pub fn take(session: &mut Session) -> Done {
    let Some(held) = session.held else { return Ok(()) };
    if let Some(up) = held.up {
        let taken = session.numbers_over(session.plot).into_iter().zip([held.value, up]);
        return scan::take_values(session, &taken.collect::<Vec<_>>());
    }
    let abscissa = session.plots[session.plot].axes.abscissa;
    let value = abscissa.check(held.value)?;
    let shown = session.shown(session.plot);
    let Some(shown) = shown.get(held.variant) else { return Ok(()) };
    let mut problem = shown.problem;
    problem.set(abscissa, value);
    // A cycle at infinity has no start on it: the present start stays.
    if let Some(cycle) = held.cycle {
        problem.initial = State { q: cycle.q_max, v: 0.0 };
    }
    change(session, problem);
    let start = held.cycle.map_or("", |_| ", and the motion starts on its cycle");
    let label = &shown.variant.label;
    let also = if label.is_empty() { "" } else { ", " };
    session.inform(format!("{abscissa} = {}{also}{label}{start}", shortest(value)));
    Ok(())
}

/// Keeps the held point when the branch is computed again, and ends the walk when there is no branch any more.
pub fn keep_hold(session: &mut Session) {
    let Some(held) = session.held else { return };
    let index = session.plot;
    let way = session.path(index);
    session.held = if session.focus != Pane::Plot(index) || way.is_empty() {
        None
    } else if session.is_path_fresh(index) {
        way.again(&held)
    } else {
        Some(held)
    };
}
