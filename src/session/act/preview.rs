//! The scene that is selected in the list of scenes, as it would open: a session of its own beside the list. It has the answers
//! of the session; what it lacks of these is asked after all that is on show.

use std::sync::Arc;

use crate::session::act::answers;
use crate::session::{ListKind, Overlay, Session};

/// Columns of a screen on which there is room for it.
const WIDE: u16 = 100;

/// Opens the selected scene beside the list, with the answers that there are; `None` where there is no list or no room.
pub fn of(session: &Session) -> Option<Box<Session>> {
    let overlay = session.overlay.as_ref().filter(|_| session.size.width >= WIDE);
    let Some(Overlay::List(ListKind::Scenes, list)) = overlay else { return None };
    let scene = *session.scene_rows(list).get(list.selected)?;
    let Session { display, size, .. } = *session;
    let mut preview = Session { display, ..Session::new(Arc::clone(scene), size) };
    (preview.keymap, preview.answers) = (Arc::clone(&session.keymap), session.answers.clone());
    preview.answers.ask(preview.asks());
    answers::resolve(&mut preview);
    preview.keep_course();
    Some(Box::new(preview))
}
