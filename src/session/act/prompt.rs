//! Typing into the open line; the command line, and the palette, where everything that has a name is run.

use std::sync::Arc;

use crate::numerics::cycled;
use crate::paper::Claim;
use crate::scene::{LayerSpec, find};
use crate::session::act::general::toggle;
use crate::session::act::history::open_scene;
use crate::session::act::lists;
use crate::session::act::run::{ENTER, run_line, run_where_it_belongs};
use crate::session::act::screen_setup::show_from_list;
use crate::session::act::values::{belt, set_row};
use crate::session::read::completion::completion;
use crate::session::{
    Completion, Done, Explanation, Input, List, ListKind, Overlay, PaletteRow, Prompt, Session,
    called,
};
use crate::words::printable::is_printable;

/// Maximum number of remembered lines.
const REMEMBERED: usize = 200;

/// Opens the line with an initial text.
pub fn open(session: &mut Session, text: impl Into<String>) {
    session.overlay = Some(Overlay::Prompt(Prompt::new(text)));
}

/// Sets the typed value, or runs the typed command; where that is refused, the line stays open with the reason. An empty
/// command closes. A line that begins with no command is searched for in the palette, which stays open if something is
/// found.
pub fn accept(session: &mut Session) {
    let Some(Overlay::Prompt(prompt)) = session.overlay.clone() else { return };
    let text = prompt.input.text().trim().to_owned();
    session.overlay = None;
    if prompt.row.is_none() && is_searched(session, &text) {
        return lists::search_everything(session, text);
    }
    let done = match prompt.row {
        Some(row) => set_row(session, row.name(), &text),
        None if text.is_empty() => Ok(()),
        None => {
            remember(session, &text);
            run_line(session, &text)
        }
    };
    if let Err(why) = done {
        let refused = Prompt { refused: Some(why), completion: None, back: 0, ..prompt };
        session.overlay = Some(Overlay::Prompt(refused));
    }
}

/// Whether a line begins with no command, but with something that the list of everything finds.
fn is_searched(session: &Session, text: &str) -> bool {
    let (name, _) = called(text);
    let known = session.keymap.named(name).is_some() || session.keymap.line(name).is_some();
    let list = List { search: text.to_owned(), ..List::default() };
    !name.is_empty() && !known && !session.palette_rows(&list).is_empty()
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
    let Session { overlay: Some(Overlay::Prompt(prompt)), lines, .. } = session else { return };
    let back = prompt.back.saturating_add_signed(by).min(lines.len());
    if back == prompt.back {
        return;
    }
    if prompt.back == 0 {
        prompt.draft = prompt.input.text();
    }
    let draft = std::mem::take(&mut prompt.draft);
    let text = if back == 0 {
        &draft
    } else {
        &lines[lines.len() - back]
    };
    *prompt = Prompt { back, ..Prompt::new(text) };
    prompt.draft = draft;
}

/// Completes the word before the caret; pressed again, shows the next candidate.
pub fn complete(session: &mut Session, by: isize) {
    let Some(Overlay::Prompt(prompt)) = &session.overlay else { return };
    let found = match &prompt.completion {
        Some(shown) => {
            Some(Completion { at: cycled(shown.at, by, shown.words.len()), ..shown.clone() })
        }
        None => completion(session, &prompt.input.before),
    };
    let Some(Overlay::Prompt(prompt)) = &mut session.overlay else { return };
    let Some(completion) = found else {
        prompt.refused = Some("nothing to complete here".to_owned());
        return;
    };
    let Completion { stem, words, at } = &completion;
    let Input { before, after } = &mut prompt.input;
    *before = format!("{stem}{}", words[*at]);
    // A blank follows the only candidate, unless something must follow it directly.
    let only = words.len() == 1;
    if only && !before.ends_with('=') && !after.starts_with(' ') {
        before.push(' ');
    }
    (prompt.refused, prompt.completion) = (None, (!only).then_some(completion));
}

/// Applies an edit to the open line, and drops what was said about its old text.
pub fn with(session: &mut Session, act: impl FnOnce(&mut Input)) {
    if let Some(Overlay::Prompt(prompt)) = &mut session.overlay {
        (prompt.refused, prompt.completion) = (None, None);
        act(&mut prompt.input);
    }
}

/// Types a text into the open line, if there is one; what is not printable is dropped.
pub fn insert(session: &mut Session, text: &str) {
    let visible = text.chars().filter(|char| is_printable(*char));
    lists::search_with(session, |search| search.extend(visible.clone()));
    with(session, |input| input.before.extend(visible));
}

/// Ends the search and keeps the rows found; in a picker, picks the selected one at once.
pub fn search_done(session: &mut Session) -> Done {
    lists::with(session, |list| list.searching = false);
    match session.overlay {
        Some(Overlay::List(ListKind::Scenes | ListKind::Views, _)) => choose(session),
        _ => Ok(()),
    }
}

/// Runs the selected row of the open list. The list closes, except that of the
/// layers. A command that takes words opens the line for typing them. In the list of costs, nothing can be run.
pub fn choose(session: &mut Session) -> Done {
    let Some(Overlay::List(kind, list)) = &session.overlay else { return Ok(()) };
    let kind = *kind;
    let row = session.rows_of(kind, list).get(list.selected).copied().flatten();
    if kind == ListKind::Cost || (row.is_some() && kind != ListKind::Layers) {
        session.overlay = None;
    }
    match row {
        Some(PaletteRow::Command(line)) if line.words().is_some() => {
            open(session, format!("{} ", line.name));
        }
        Some(PaletteRow::Command(command)) => run_where_it_belongs(session, command, ENTER),
        Some(PaletteRow::Scene(scene)) => open_scene(session, Arc::clone(scene)),
        Some(PaletteRow::View(row)) => show_from_list(session, row.view)?,
        Some(PaletteRow::Layer(layer)) if kind == ListKind::Palette => show_layer(session, layer)?,
        Some(PaletteRow::Layer(layer)) => toggle(session, layer.layer),
        Some(PaletteRow::Machine(machine)) => belt(session, &machine.name)?,
        Some(PaletteRow::Claim(claim)) => show_claim(session, claim)?,
        Some(PaletteRow::Entry(entry)) => {
            let shown = Explanation { entry: Some(entry), ..Explanation::default() };
            session.overlay = Some(Overlay::Explanation(shown));
        }
        None => {}
    }
    Ok(())
}

/// Switches a layer; where no plot shows its view, shows that with the layer on.
fn show_layer(session: &mut Session, layer: &LayerSpec) -> Done {
    if !session.on_show().any(|plot| session.plots[plot].view == layer.view) {
        show_from_list(session, layer.view)?;
        session.layers.remove(&layer.layer);
    }
    toggle(session, layer.layer);
    Ok(())
}

/// Opens the scene that shows a claim.
fn show_claim(session: &mut Session, claim: &Claim) -> Done {
    let Claim { equation, statement, .. } = claim;
    let scene = claim.scene.and_then(|name| find(name).ok());
    let scene = scene.ok_or_else(|| format!("no scene shows {equation}: it is a formula alone"))?;
    open_scene(session, scene);
    session.inform(format!("{equation}: {statement}"));
    Ok(())
}
