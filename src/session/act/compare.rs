//! Marks, and the comparison of two points of the parameters: the present one and that which is pinned, or that which was
//! left last for a mark.
//!
//! Going from one to the other recomputes nothing, because answers are stored by their questions.

use std::sync::Arc;

use crate::scene::{Layer, Scene};
use crate::session::act::parameters::put;
use crate::session::read::completion::difference;
use crate::session::{Done, EarlierState, Letter, Session, Setup, Size};

/// Marks the present point.
pub fn set_mark(session: &mut Session, name: char) {
    session.marks.places.insert(name, session.setup());
    let key = session.keymap.key_of("go-to-mark");
    let back = key.map(|key| format!("; {key}{name} comes back")).unwrap_or_default();
    session.inform(format!("mark {name} is here{back}"));
}

/// Goes to a mark.
pub fn go_to_mark(session: &mut Session, name: char) -> Done {
    let mark = session.marks.places.get(&name).cloned();
    go(session, mark.ok_or_else(|| format!("there is no mark {name}"))?);
    Ok(())
}

/// Goes to the point that was left last, or to the pinned one.
pub fn go_back(session: &mut Session) -> Done {
    if session.marks.pinned.is_some() {
        return swap(session);
    }
    let mark = session.marks.left.clone();
    go(session, mark.ok_or("no mark has been visited yet")?);
    Ok(())
}

/// Goes to a point, as a change that can be undone, and keeps the point that is left for comparison, unless another one
/// is pinned.
fn go(session: &mut Session, mark: Setup) {
    let here = session.setup();
    if mark == here {
        return session.inform("here already");
    }
    let moved = difference(&here, &mark);
    put(session, mark);
    if session.marks.pinned.is_none() {
        session.marks.left = Some(here);
        session.layers.insert(Layer::Ghost);
    }
    session.inform(moved);
}

/// Pins the present point as A; what the keys change from now on is B.
pub fn pin(session: &mut Session) {
    (session.marks.left, session.marks.pinned) = (Some(session.setup()), Some(Letter::A));
    session.inform_of_keys("A is pinned, keys change B; {swap} swaps, {drop-cursor} lets go of A");
}

/// Goes to the pinned point, as one change, and pins the one that is left.
pub fn swap(session: &mut Session) -> Done {
    let (Some(pinned), Some(there)) = (session.marks.pinned, session.marks.left.clone()) else {
        return Err(session.with_keys("nothing is pinned: {pin} pins the present state"));
    };
    let here = session.setup();
    let name: &str = pinned.into();
    let moved = format!("{name} is present: {}", difference(&here, &there));
    put(session, there).then_some(()).ok_or("A and B are the same")?;
    if let Some(EarlierState::Setup(before)) = session.history.past.pop() {
        session.history.past.push(EarlierState::Swap(before));
    }
    (session.marks.left, session.marks.pinned) = (Some(here), Some(pinned.other()));
    session.inform(moved);
    Ok(())
}

/// Undoes or redoes an exchange that leads to this setup, if that is the pinned one.
pub fn exchange_back(session: &mut Session, setup: &Setup) {
    let pinned = session.marks.pinned.filter(|_| session.marks.left.as_ref() == Some(setup));
    if let Some(pinned) = pinned {
        (session.marks.left, session.marks.pinned) = (Some(session.setup()), Some(pinned.other()));
    }
}

/// Lets go of the pinned point, if there is one.
pub fn let_go(session: &mut Session) {
    if let Some([_, pinned]) = session.letters() {
        (session.marks.left, session.marks.pinned) = (None, None);
        session.inform(format!("{pinned} is let go"));
    }
}

/// Keeps the pinned point in another scene if that has the same oscillator: numbers of a machine mean nothing elsewhere.
pub fn keep(session: &mut Session, scene: &Scene) {
    let Scene { machine, recording, .. } = &*session.scene;
    if (machine, recording) != (&scene.machine, &scene.recording) {
        let_go(session);
    }
}

/// Makes the session at the point for comparison show the same as this one, or drops it.
pub fn follow(session: &mut Session) {
    let pinned = session.marks.pinned.is_some();
    let on = pinned || session.layers.contains(&Layer::Ghost);
    let Some(mut setup) = session.marks.left.clone().filter(|_| on) else {
        session.other = None;
        return;
    };
    if !pinned {
        setup.others.clear();
    }
    let new = || Box::new(Session::new(Arc::clone(&session.scene), Size::default()));
    let mut other = session.other.take().unwrap_or_else(new);
    if !Arc::ptr_eq(&other.scene, &session.scene) || other.setup() != setup {
        other.scene = Arc::clone(&session.scene);
        other.set_setup(setup);
    }
    other.layers = session.layers_beside();
    other.plots.clone_from(&session.plots);
    // Beside several variants it is one more.
    other.plots.iter_mut().for_each(|plot| plot.family = None);
    (other.plot, other.enlarged, other.playback) =
        (session.plot, session.enlarged, session.playback);
    (other.display, other.marks.pinned) =
        (session.display, session.marks.pinned.map(Letter::other));
    let course = other.answers.course.take();
    other.answers.clone_from(&session.answers);
    other.answers.course = course;
    other.keep_course();
    session.other = Some(other);
}
