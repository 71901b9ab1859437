//! Marks: points of the parameters to come back to, and the point for comparison.
//!
//! Coming back recomputes nothing, because answers are stored by their questions. The point that was left is
//! drawn dimmed behind the other one.

use crate::scene::Layer;
use crate::session::act::notice::inform;
use crate::session::act::parameters::put;
use crate::session::effect::Done;
use crate::session::read::numbers::difference;
use crate::session::read::wants::COMPARED;
use crate::session::state::{Bookmark, Session};

/// Marks the present point.
pub(in crate::session) fn set(session: &mut Session, name: char) {
    session.marks.places.insert(name, present(session));
    let key = session.keymap.key_of("go-to-mark");
    let back = key.map(|key| format!("; {key}{name} comes back")).unwrap_or_default();
    inform(session, format!("mark {name} is here{back}"));
}

pub(in crate::session) fn go_to(session: &mut Session, name: char) -> Done {
    let mark = session.marks.places.get(&name).cloned();
    go(session, &mark.ok_or_else(|| format!("there is no mark {name}"))?);
    Ok(())
}

/// Goes to the point that was left last.
pub(in crate::session) fn go_back(session: &mut Session) -> Done {
    let mark = session.marks.left.clone();
    go(session, &mark.ok_or("no mark has been visited yet")?);
    Ok(())
}

/// Goes to a point, as a change that can be undone, and keeps the point that is left for comparison.
fn go(session: &mut Session, mark: &Bookmark) {
    let here = present(session);
    if mark.setup == here.setup {
        return inform(session, "here already");
    }
    let moved = difference(&here.setup, &mark.setup);
    put(session, &mark.setup);
    session.marks.left = Some(here);
    session.layers.insert(Layer::Ghost);
    inform(session, moved);
}

fn present(session: &Session) -> Bookmark {
    let asked = COMPARED.into_iter().filter_map(|topic| session.request(topic, session.plot));
    Bookmark { setup: session.setup(), asked: asked.collect() }
}
