//! Lists over the panes: opening, moving and searching.

use std::collections::BTreeMap;

use crate::scene::letters;
use crate::session::act::general::toggle;
use crate::session::act::run::{ENTER, run_where_it_belongs};
use crate::session::{Command, Key, List, ListKind, Overlay, Session};

/// Opens a list, with the present scene or the view of the plot in use selected.
pub fn open(session: &mut Session, kind: ListKind) {
    let list = List::default();
    let selected = match kind {
        ListKind::Scenes => {
            let mut scenes = session.scene_rows(&list).into_iter();
            scenes.position(|scene| scene.name == session.scene.name)
        }
        ListKind::Views => Some(session.view_in_use() as usize),
        _ => None,
    };
    let list = List { selected: selected.unwrap_or(0), ..list };
    session.overlay = Some(Overlay::List(kind, list));
}

/// Tries on copies what the list of everything could run: when it opens, and when an answer has come.
pub fn follow(session: &mut Session, answered: bool) {
    if let Some(Overlay::List(ListKind::Palette, list)) = &session.overlay
        && (answered || list.refused.is_empty())
    {
        let refused = refused(session);
        with(session, |list| list.refused = refused);
    }
}

/// The commands of keys that would be refused, with what they would say. One that would wait for an answer is not known to
/// be refused.
fn refused(session: &Session) -> BTreeMap<&'static str, String> {
    let base = Session { overlay: None, preview: None, notice: None, ..session.clone() };
    let waits = |command: &&Command| base.awaited_by_command(command).is_some();
    let tried = base.listed_commands().filter(|command| !waits(command));
    let said = |command: &'static Command| {
        let mut copy = base.clone();
        run_where_it_belongs(&mut copy, command, ENTER);
        let notice = copy.notice.filter(|notice| notice.error)?;
        Some((command.name, notice.text))
    };
    tried.filter_map(said).collect()
}

/// Opens the list of everything, to be searched.
pub fn search_everything(session: &mut Session, search: String) {
    open(session, ListKind::Palette);
    with(session, |list| (list.search, list.searching) = (search, true));
}

/// Opens the page of help; from there, the list of everything.
pub fn help(session: &mut Session) {
    match session.overlay.take() {
        Some(Overlay::Help(_)) => open(session, ListKind::Palette),
        below => session.overlay = Some(Overlay::Help(below.map(Box::new))),
    }
}

/// Closes what is open; below the page of help may be a list.
pub fn close(session: &mut Session) {
    if let Some(Overlay::Help(below)) = session.overlay.take() {
        session.overlay = below.map(|below| *below);
    }
}

/// Switches the layer with this letter in the view of the plot in use.
pub fn toggle_letter(session: &mut Session, key: Key) {
    let view = session.view_in_use();
    let Some((_, layer)) = letters(view).find(|(letter, _)| key.typed() == Some(*letter)) else {
        let title = view.spec().title;
        return session.refuse(format!("{} is not a layer of the {title}", key.said()));
    };
    if let Some(Overlay::List(ListKind::Layers, list)) = &session.overlay {
        let place = session.layer_rows(list).iter().position(|row| row.layer == layer);
        with(session, |list| list.selected = place.unwrap_or(list.selected));
    }
    toggle(session, layer);
}

/// Moves the selection of the open list, within its rows.
pub fn move_by(session: &mut Session, by: isize) {
    let Some(Overlay::List(kind, list)) = &session.overlay else { return };
    let last = session.rows_of(*kind, list).len().saturating_sub(1);
    with(session, |list| list.selected = list.selected.saturating_add_signed(by).min(last));
}

/// Changes the open list, if there is one.
pub fn with(session: &mut Session, change: impl FnOnce(&mut List)) {
    if let Some(Overlay::List(_, list)) = &mut session.overlay {
        change(list);
    }
}

/// Changes the text of the search.
pub fn search_with(session: &mut Session, change: impl FnOnce(&mut String)) {
    with(session, |list| {
        change(&mut list.search);
        list.selected = 0;
    });
}
