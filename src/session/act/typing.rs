//! Typing into the line that is open, whichever it is: a value, a command, a search.

use crate::session::effect::Effect;
use crate::session::state::input::Input;
use crate::session::state::overlay::Overlay;
use crate::session::state::session::Session;

/// Does something to the open line. What was said about its old text no longer holds.
pub fn with(session: &mut Session, act: impl FnOnce(&mut Input)) -> Vec<Effect> {
    match &mut session.overlay {
        Some(Overlay::Entry(entry)) => {
            entry.refused = None;
            act(&mut entry.input);
        }
        Some(Overlay::Prompt(prompt)) => {
            (prompt.refused, prompt.completion) = (None, None);
            act(&mut prompt.input);
        }
        Some(Overlay::Scan(form)) => {
            form.refused = None;
            act(form.input_mut());
        }
        _ => {}
    }
    Vec::new()
}

/// Types into the line that is open, if one is; characters that cannot be shown are dropped.
pub fn insert(session: &mut Session, text: &str) {
    let mut visible = text.chars().filter(|char| !char.is_control());
    if let Some(list) = session.overlay.as_mut().and_then(Overlay::list_mut) {
        list.search.extend(visible);
        list.selected = 0;
    } else {
        with(session, |input| visible.by_ref().for_each(|char| input.insert(char)));
    }
}
