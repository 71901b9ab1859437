//! The command line: opening, completing, remembering and running.

use crate::session::read::completion::completion;
use crate::session::state::command::full_name;
use crate::session::state::{
    Completion, Input, List, Listed, NextCommand, Overlay, Prompt, Session,
};

/// Maximum number of remembered lines.
const REMEMBERED: usize = 200;

/// Opens an empty line.
pub fn open(session: &mut Session) {
    open_with(session, String::new());
}

/// Opens the line with an initial text.
pub fn open_with(session: &mut Session, text: String) {
    session.overlay = Some(Overlay::Prompt(Prompt::new(text)));
}

/// The typed command, to be run. An empty line closes. A line that begins with no command is searched for in
/// the palette, which stays open if something is found.
pub fn accept(session: &mut Session) -> Option<NextCommand> {
    let Some(Overlay::Prompt(prompt)) = &session.overlay else { return None };
    let text = prompt.input.text().trim().to_owned();
    if text.is_empty() {
        session.overlay = None;
        return None;
    }
    if let Some(found) = search(session, &text) {
        session.overlay = Some(Overlay::List(Listed::Palette, found));
        return None;
    }
    remember(session, &text);
    Some(NextCommand::Line(text))
}

/// The palette with a search for a line that begins with no command; `None` if the line begins with a command
/// or nothing is found.
fn search(session: &Session, text: &str) -> Option<List> {
    let name = full_name(text.split_whitespace().next()?);
    if session.keymap.named(name).is_some() || session.keymap.line(name).is_some() {
        return None;
    }
    let list = List { search: text.to_owned(), searching: true, ..List::default() };
    (!session.palette_rows(&list).is_empty()).then_some(list)
}

/// Remembers a line as the newest one, and only once.
fn remember(session: &mut Session, text: &str) {
    session.lines.retain(|line| line != text);
    session.lines.push(text.to_owned());
    let surplus = session.lines.len().saturating_sub(REMEMBERED);
    session.lines.drain(..surplus);
}

/// Shows an older or a newer line; the newest is the one that was being typed.
pub fn recall(session: &mut Session, by: isize) {
    let lines = session.lines.clone();
    let Some(Overlay::Prompt(prompt)) = &mut session.overlay else { return };
    let back = prompt.back.saturating_add_signed(by).min(lines.len());
    if back == prompt.back {
        return;
    }
    if prompt.back == 0 {
        prompt.input.text().clone_into(&mut prompt.draft);
    }
    let text = match back {
        0 => prompt.draft.clone(),
        back => lines[lines.len() - back].clone(),
    };
    let draft = std::mem::take(&mut prompt.draft);
    *prompt = Prompt { back, draft, ..Prompt::new(text) };
}

/// Completes the word before the caret; pressed again, shows the next candidate.
pub fn complete(session: &mut Session, by: isize) {
    let Some(Overlay::Prompt(prompt)) = &session.overlay else { return };
    let found = match &prompt.completion {
        Some(Completion { stem, words, at }) => {
            let next = at.checked_add_signed(by).unwrap_or(words.len() - 1) % words.len();
            Some(Completion { stem: stem.clone(), words: words.clone(), at: next })
        }
        None => completion(session, prompt.input.halves().0),
    };
    let Some(Overlay::Prompt(prompt)) = &mut session.overlay else { return };
    let Some(completion) = found else {
        prompt.refused = Some("nothing to complete here".to_owned());
        return;
    };
    let after = prompt.input.halves().1.to_owned();
    let Completion { stem, words, at } = &completion;
    let mut text = format!("{stem}{}", words[*at]);
    // A blank follows the only candidate, unless something must follow it directly.
    let only = words.len() == 1;
    if only && !text.ends_with('=') && !after.starts_with(' ') {
        text.push(' ');
    }
    prompt.input = Input::new(text);
    for char in after.chars() {
        prompt.input.insert(char);
    }
    prompt.input.move_caret(-isize::try_from(after.chars().count()).unwrap_or(0));
    (prompt.refused, prompt.completion) = (None, (!only).then_some(completion));
}
