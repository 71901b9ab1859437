//! Walking along the branch: a point is held, moved along, and taken into the phase plane.

use super::parameters::change;
use super::{inform, refuse, told};
use crate::oscillator::State;
use crate::scene::{Axes, Layer, Slot};
use crate::session::message::Effect;
use crate::session::plot::{Pane, Plot};
use crate::session::state::Session;
use crate::session::step::shortest;
use crate::session::walk::{Stop, Way};

/// Points that a far move takes.
pub const FAR: isize = 10;

/// Takes hold of the branch: at the cursor of the diagram if there is one, else at today's value.
pub fn take_hold(session: &mut Session) -> Vec<Effect> {
    match first(session) {
        Ok(stop) => session.held = Some(stop),
        Err(why) => refuse(session, why),
    }
    Vec::new()
}

fn first(session: &Session) -> Result<Stop, &'static str> {
    let index = session.plot;
    if !session.shows_in(Layer::Branch, index) {
        return Err("the branch is not shown: n shows it");
    }
    let branch = session.branch(index).filter(|_| !session.is_stale(Slot::Branch, index));
    let branch = branch.ok_or("the branch is not computed yet")?;
    let way = Way::along(branch);
    let Plot { axes: Axes { abscissa, ordinate, .. }, window, cursor, .. } = &session.plots[index];
    let found = match cursor {
        Some(cursor) => way.nearest(|stop| {
            let height = stop.cycle.map_or(window.y.to(), |cycle| ordinate.of(&cycle));
            let across = window.x.fraction(stop.value) - window.x.fraction(cursor.x);
            across.hypot(window.y.fraction(height) - window.y.fraction(cursor.y))
        }),
        None => way.start(session.value(*abscissa)),
    };
    found.ok_or("there is no cycle in this diagram to take hold of")
}

/// Goes `count` points along the piece of the branch that is held.
pub fn go(session: &mut Session, count: isize) -> Vec<Effect> {
    let further = |way: &Way, held: &Stop| way.further(held, count);
    if !moved(session, further) {
        let text = "the branch ends here; {walk-to-next} goes on to the next special point or end";
        inform(session, told(session, text));
    }
    Vec::new()
}

/// Goes to the next special point or end of a piece.
pub fn go_to_landmark(session: &mut Session, onward: bool) -> Vec<Effect> {
    moved(session, |way, held| way.landmark(held, onward));
    Vec::new()
}

/// Holds another point; returns whether it is another.
fn moved(session: &mut Session, choose: impl Fn(&Way, &Stop) -> Option<Stop>) -> bool {
    let Some((branch, held)) = session.branch(session.plot).zip(session.held) else { return false };
    let found = choose(&Way::along(branch), &held).unwrap_or(held);
    session.held = Some(found);
    found != held
}

/// Gives the parameter the value of the point, and starts the motion on its cycle, as one change.
pub fn take(session: &mut Session) -> Vec<Effect> {
    let Some(held) = session.held else { return Vec::new() };
    let abscissa = session.plots[session.plot].axes.abscissa;
    let spec = abscissa.spec();
    let value = match spec.check(held.value) {
        Ok(value) => value,
        Err(refused) => {
            refuse(session, refused.to_string());
            return Vec::new();
        }
    };
    let mut problem = session.problem;
    abscissa.set(&mut problem.parameters, &mut problem.initial, value);
    // Where the cycle has gone to infinity there is no start on it: the old one stays.
    if let Some(cycle) = held.cycle {
        problem.initial = State { q: cycle.q_max, v: 0.0 };
    }
    change(session, problem);
    let start = held.cycle.map(|_| ", and the motion starts on its cycle").unwrap_or_default();
    inform(session, format!("{} = {}{start}", spec.name, shortest(value)));
    Vec::new()
}

/// Lets go of the branch.
pub fn let_go(session: &mut Session) -> Vec<Effect> {
    session.held = None;
    Vec::new()
}

/// Keeps hold of a point of the branch on show when that is computed anew, and of none when there is no
/// branch any more.
pub(super) fn keep_hold(session: &mut Session) {
    let Some(held) = session.held else { return };
    let index = session.plot;
    let on_show = session.focus == Pane::Plot(index) && session.shows_in(Layer::Branch, index);
    session.held = match session.branch(index) {
        Some(branch) if on_show && session.is_stale(Slot::Branch, index) => {
            Some(held).filter(|_| !branch.pieces.is_empty())
        }
        Some(branch) if on_show => Way::along(branch).again(&held),
        _ => None,
    };
}
