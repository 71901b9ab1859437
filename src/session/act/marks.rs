//! Marks: points of the parameters to come back to, and the one that is compared with.
//!
//! A mark keeps the answers that were there when its point was left. Coming back they are today's again,
//! and nothing is computed twice; the point that was left is drawn dim behind the other one.

use std::sync::Arc;

use crate::scene::{Layer, Slot};
use crate::session::act::notice::{inform, refuse};
use crate::session::act::parameters::put;
use crate::session::effect::Effect;
use crate::session::read::numbers::difference;
use crate::session::state::marks::Mark;
use crate::session::state::session::Session;

/// Marks the present point.
pub(in crate::session) fn set(session: &mut Session, name: char) -> Vec<Effect> {
    session.marks.places.insert(name, present(session));
    let key = session.keymap.key_of("go-to-mark");
    let back = key.map(|key| format!("; {key}{name} comes back")).unwrap_or_default();
    inform(session, format!("mark {name} is here{back}"));
    Vec::new()
}

/// Goes to a mark.
pub(in crate::session) fn go_to(session: &mut Session, name: char) -> Vec<Effect> {
    match session.marks.places.get(&name).cloned() {
        Some(mark) => go(session, &mark),
        None => refuse(session, format!("there is no mark {name}")),
    }
    Vec::new()
}

/// Goes to the point that was left last.
pub(in crate::session) fn go_back(session: &mut Session) -> Vec<Effect> {
    match session.marks.left.clone() {
        Some(mark) => go(session, &mark),
        None => refuse(session, "no mark has been gone to yet"),
    }
    Vec::new()
}

/// Goes to a point, as a change that can be undone, and keeps what is known about the one that is left.
fn go(session: &mut Session, mark: &Mark) {
    let here = present(session);
    for known in session.marks.places.values_mut().filter(|known| known.stand == here.stand) {
        known.answers.clone_from(&here.answers);
    }
    if mark.stand == here.stand {
        inform(session, "here already");
        return;
    }
    inform(session, difference(&here.stand, &mark.stand));
    put(session, mark.stand);
    for (slot, answered) in &mark.answers {
        if session.request(*slot, session.plot).as_ref() == Some(&answered.request) {
            session.answers.insert(*slot, Arc::clone(answered));
        }
    }
    session.marks.left = Some(here);
    session.layers.insert(Layer::Ghost);
}

/// The present point.
fn present(session: &Session) -> Mark {
    let todays = |slot: &Slot| !session.is_stale(*slot, session.plot);
    let answers = session.answers.iter().filter(|(slot, _)| todays(slot));
    let answers = answers.map(|(slot, answered)| (*slot, Arc::clone(answered))).collect();
    Mark { stand: session.stand(), answers }
}
