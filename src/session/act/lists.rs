//! Lists over the panes: moving, searching, and choosing rows.

use std::sync::Arc;

use crate::paper::Claim;
use crate::scene::{find, letters};
use crate::session::act::general::toggle;
use crate::session::act::history::open_scene;
use crate::session::act::notice::{inform, refuse};
use crate::session::act::screen_setup::show_from_list;
use crate::session::effect::Done;
use crate::session::message::key::Key;
use crate::session::state::{List, Listed, Overlay, Session};

/// Number of rows that the page keys move by.
pub const PAGE: isize = 10;

/// Opens a list, with the present scene or the view of the plot in use selected.
pub fn open(session: &mut Session, listed: Listed) {
    let list = List::default();
    let rows = |list: &List| session.scene_rows(list).into_iter();
    let selected = match listed {
        Listed::Scenes => rows(&list).position(|scene| scene.name == session.scene.name),
        Listed::Views => Some(session.view_in_use() as usize),
        _ => None,
    };
    let list = List { selected: selected.unwrap_or(0), ..list };
    session.overlay = Some(Overlay::List(listed, list));
}

/// Switches the layer with this letter in the view of the plot in use.
pub fn toggle_letter(session: &mut Session, key: Key) {
    let view = session.view_in_use();
    let Some((_, layer)) = letters(view).find(|(letter, _)| key.typed() == Some(*letter)) else {
        let text = format!("{} is not a layer of the {}", key.said(), view.spec().title);
        return refuse(session, text);
    };
    if let Some(Overlay::List(Listed::Layers, list)) = &session.overlay {
        let place = session.layer_rows(list).iter().position(|row| row.layer == layer);
        if let (Some(place), Some(list)) = (place, session.list_mut()) {
            list.selected = place;
        }
    }
    toggle(session, layer);
}

/// Opens the scene that shows a claim.
pub fn show_claim(session: &mut Session, claim: &Claim) -> Done {
    session.overlay = None;
    let scene = claim.scene.and_then(|name| find(name).ok());
    let scene =
        scene.ok_or_else(|| format!("no scene shows {}: it is a formula alone", claim.equation))?;
    open_scene(session, scene);
    inform(session, format!("{}: {}", claim.equation, claim.statement));
    Ok(())
}

/// Moves the selection of the open list, within its rows.
pub fn move_by(session: &mut Session, by: isize) {
    let last = session.list_length().saturating_sub(1);
    if let Some(list) = session.list_mut() {
        list.selected = list.selected.saturating_add_signed(by).min(last);
    }
}

/// Directs typed characters to the search.
pub fn search(session: &mut Session) {
    if let Some(list) = session.list_mut() {
        list.searching = true;
    }
}

/// Ends the search and keeps the rows found; in a picker, picks the selected one at once.
pub fn search_done(session: &mut Session) -> Done {
    if let Some(list) = session.list_mut() {
        list.searching = false;
    }
    match session.overlay {
        Some(Overlay::List(Listed::Scenes | Listed::Views, _)) => choose(session),
        _ => Ok(()),
    }
}

/// Ends the search and shows all rows.
pub fn search_drop(session: &mut Session) {
    if let Some(list) = session.list_mut() {
        *list = List::default();
    }
}

/// Changes the text of the search.
pub fn search_with(session: &mut Session, change: impl FnOnce(&mut String)) {
    if let Some(list) = session.list_mut() {
        change(&mut list.search);
        list.selected = 0;
    }
}

/// Opens the selected scene, switches the selected layer, or shows the selected view.
pub fn choose(session: &mut Session) -> Done {
    match &session.overlay {
        Some(Overlay::List(Listed::Scenes, list)) => {
            if let Some(scene) = session.scene_rows(list).get(list.selected) {
                session.overlay = None;
                open_scene(session, Arc::clone(scene));
            }
        }
        Some(Overlay::List(Listed::Layers, list)) => {
            if let Some(row) = session.layer_rows(list).get(list.selected) {
                toggle(session, row.layer);
            }
        }
        Some(Overlay::List(Listed::Views, list)) => {
            if let Some(row) = session.view_rows(list).get(list.selected) {
                session.overlay = None;
                return show_from_list(session, row.view);
            }
        }
        Some(Overlay::List(Listed::Paper, list)) => {
            if let Some((claim, _)) = session.claim_rows(list).get(list.selected) {
                return show_claim(session, claim);
            }
        }
        _ => {}
    }
    Ok(())
}
