//! Typing into the open line, whether it is for a value, a command or a search.

use crate::session::act::lists::search_with;
use crate::session::state::{Input, Overlay, Session};
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
    let visible = text.chars().filter(|char| is_printable(*char));
    search_with(session, |search| search.extend(visible.clone()));
    with(session, |input| visible.for_each(|char| input.insert(char)));
}
