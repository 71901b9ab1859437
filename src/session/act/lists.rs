//! Lists over the panes: opening, moving and searching.

use crate::scene::letters;
use crate::session::act::general::toggle;
use crate::session::{Key, List, ListKind, Overlay, Session};

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
