//! The mouse, for those who want it: a click starts a motion or moves a cursor, and the wheel zooms.

use crate::session::act::focus::focus_on;
use crate::session::act::general::flip;
use crate::session::act::{lists, plots};
use crate::session::effect::{Done, Effect};
use crate::session::message::pointer::{Gesture, Pointed, PointerTarget};
use crate::session::state::{Pane, Session};

/// Number of rows by which a notch of the wheel moves a list.
const NOTCH: isize = 3;

/// Turns the mouse on or off.
pub fn toggle(session: &mut Session) {
    let on = "mouse on: click to start or point, turn the wheel to zoom, hold shift to select text";
    flip(session, |it| &mut it.mouse, [on, "mouse off: the terminal selects text"]);
    session.effects.push(Effect::Mouse(session.display.mouse));
}

/// Handles an action of the mouse. Over an overlay, the wheel moves its list and clicks are ignored.
pub fn pointed(session: &mut Session, Pointed { gesture, place }: Pointed) -> Done {
    if session.overlay.is_some() {
        match gesture {
            Gesture::Click => {}
            Gesture::Nearer => lists::move_by(session, -NOTCH),
            Gesture::Farther => lists::move_by(session, NOTCH),
        }
        return Ok(());
    }
    match place {
        PointerTarget::Row(index) => {
            if let (Gesture::Click, Some(row)) = (gesture, session.rows().get(index)) {
                session.selected = *row;
                session.focus = Pane::Parameters;
            }
        }
        PointerTarget::Plot(index, _) if !session.on_show().contains(&index) => {}
        PointerTarget::Plot(index, point) => {
            focus_on(session, Pane::Plot(index));
            match gesture {
                Gesture::Click => return plots::point_at(session, point),
                Gesture::Nearer => plots::zoom_about(session, |_| point, true),
                Gesture::Farther => plots::zoom_about(session, |_| point, false),
            }
        }
    }
    Ok(())
}
