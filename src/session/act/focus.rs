//! Commands that move the focus between panes.

use crate::session::state::{Pane, Session};

/// Gives the focus to another pane.
pub fn focus(session: &mut Session, by: isize) {
    // If a plot is enlarged, the next plot takes its space.
    let panes = session.plots.len() + 1;
    let at = match session.focus {
        Pane::Parameters => 0,
        Pane::Plot(index) => index + 1,
    };
    let next = at.checked_add_signed(by).unwrap_or(panes - 1) % panes;
    focus_on(session, next.checked_sub(1).map_or(Pane::Parameters, Pane::Plot));
}

pub(in crate::session) fn focus_on(session: &mut Session, pane: Pane) {
    session.focus = pane;
    if let Pane::Plot(index) = pane {
        session.plot = index;
    }
}

/// Gives one plot the space of all, or lets all share it again.
pub fn enlarge(session: &mut Session) {
    session.enlarged = !session.enlarged;
}
