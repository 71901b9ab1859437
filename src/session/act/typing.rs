//! Typing into the open line, whether it is for a value, a command or a search.

use crate::session::state::input::Input;
use crate::session::state::overlay::Overlay;
use crate::session::state::session::Session;
use crate::words::printable::is_printable;

/// Applies an edit to the open line, and drops what was said about its old text.
pub fn with(session: &mut Session, act: impl FnOnce(&mut Input)) {
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
}

/// Types a text into the open line, if there is one; what is not printable is dropped.
pub fn insert(session: &mut Session, text: &str) {
    let mut visible = text.chars().filter(|char| is_printable(*char));
    if let Some(list) = session.overlay.as_mut().and_then(Overlay::list_mut) {
        list.search.extend(visible);
        list.selected = 0;
    } else {
        with(session, |input| visible.by_ref().for_each(|char| input.insert(char)));
    }
}
