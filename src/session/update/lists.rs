//! Lists over the panes: help, scenes, layers, views; moving, searching, choosing.

use std::sync::Arc;

use super::desk::show;
use super::general::{open_scene, toggle};
use super::palette::PaletteRow;
use super::{inform, refuse};
use crate::scene::{LAYERS, LayerSpec, Scene, VIEWS, ViewSpec, find, library};
use crate::session::command::{COMMANDS, Command};
use crate::session::line::LINES;
use crate::session::message::Effect;
use crate::session::overlay::{List, Listed, Overlay};
use crate::session::state::Session;
use crate::study::claims::{Claim, Examined, Verdict, claims};

/// Rows that the page keys move.
pub const PAGE: isize = 10;

impl Session {
    /// The commands that the help lists, in the order of the tables.
    #[must_use]
    pub fn help_rows(&self, list: &List) -> Vec<PaletteRow> {
        let keys = COMMANDS.iter().filter(|command| list.matches(&self.words(command)));
        let lines = LINES.iter().filter(|line| list.matches(&[line.name, line.doc]));
        keys.map(PaletteRow::Command).chain(lines.map(PaletteRow::Line)).collect()
    }

    /// The words by which a command is found: its name, what it does, its keys.
    #[must_use]
    pub fn words(&self, command: &Command) -> Vec<String> {
        let places = self.keymap.places(command);
        let keys = places.iter().flat_map(|(_, keys)| keys).map(ToString::to_string);
        [command.name.to_owned(), command.doc.to_owned()].into_iter().chain(keys).collect()
    }

    /// The scenes that the picker lists.
    #[must_use]
    pub fn scene_rows(&self, list: &List) -> Vec<&'static Arc<Scene>> {
        library().iter().filter(|scene| list.matches(&[&scene.name, &scene.title])).collect()
    }

    /// The layers that the layer list shows.
    #[must_use]
    pub fn layer_rows(&self, list: &List) -> Vec<&'static LayerSpec> {
        LAYERS.iter().filter(|row| list.matches(&[row.name, row.meaning])).collect()
    }

    /// The views that the picker lists.
    #[must_use]
    pub fn view_rows(&self, list: &List) -> Vec<&'static ViewSpec> {
        VIEWS.iter().filter(|row| list.matches(&[row.name, row.title, row.meaning])).collect()
    }

    /// The claims that the page of the paper lists, each with what became of it, if that is known.
    #[must_use]
    pub fn claim_rows(&self, list: &List) -> Vec<(&'static Claim, Option<&Examined>)> {
        let examined = self.examined();
        let rows = claims().enumerate().map(|(index, claim)| (claim, examined.get(index)));
        let matches = |(claim, examined): &(&'static Claim, Option<&Examined>)| {
            let verdict = examined.and_then(Examined::verdict).map_or("", Verdict::name);
            list.matches(&[claim.equation, claim.section, claim.statement, verdict])
        };
        rows.filter(matches).collect()
    }

    /// How many rows the open list has.
    fn list_length(&self) -> usize {
        match &self.overlay {
            Some(Overlay::List(Listed::Help, list)) => self.help_rows(list).len(),
            Some(Overlay::List(Listed::Scenes, list)) => self.scene_rows(list).len(),
            Some(Overlay::List(Listed::Layers, list)) => self.layer_rows(list).len(),
            Some(Overlay::List(Listed::Views, list)) => self.view_rows(list).len(),
            Some(Overlay::List(Listed::Paper, list)) => self.claim_rows(list).len(),
            Some(Overlay::List(Listed::Palette, list)) => self.palette_rows(list).len(),
            Some(Overlay::List(Listed::Cost, list)) => self.cost_rows(list).len(),
            Some(Overlay::Entry(_) | Overlay::Prompt(_) | Overlay::Scan(_) | Overlay::Offer(_))
            | None => 0,
        }
    }

    fn list_mut(&mut self) -> Option<&mut List> {
        self.overlay.as_mut().and_then(Overlay::list_mut)
    }
}

/// Opens the help.
pub fn open_help(session: &mut Session) -> Vec<Effect> {
    session.overlay = Some(Overlay::List(Listed::Help, List::default()));
    Vec::new()
}

/// Opens the scene picker, with the present scene selected.
pub fn open_scenes(session: &mut Session) -> Vec<Effect> {
    let present = library().iter().position(|scene| scene.name == session.scene.name);
    let list = List { selected: present.unwrap_or(0), ..List::default() };
    session.overlay = Some(Overlay::List(Listed::Scenes, list));
    Vec::new()
}

/// Opens the list of layers, with the first one of the plot in use selected.
pub fn open_layers(session: &mut Session) -> Vec<Effect> {
    let view = session.plots[session.plot].view;
    let first = LAYERS.iter().position(|row| row.view == view);
    let list = List { selected: first.unwrap_or(0), ..List::default() };
    session.overlay = Some(Overlay::List(Listed::Layers, list));
    Vec::new()
}

/// Opens the picker of views, with the present one of the plot in use selected.
pub fn open_views(session: &mut Session) -> Vec<Effect> {
    let selected = session.plots[session.plot].view as usize;
    session.overlay = Some(Overlay::List(Listed::Views, List { selected, ..List::default() }));
    Vec::new()
}

/// Opens the list of what the picture costs.
pub fn open_cost(session: &mut Session) -> Vec<Effect> {
    session.overlay = Some(Overlay::List(Listed::Cost, List::default()));
    Vec::new()
}

/// Opens the page of the paper: its claims, which are examined when this is first asked for.
pub fn open_paper(session: &mut Session) -> Vec<Effect> {
    session.overlay = Some(Overlay::List(Listed::Paper, List::default()));
    Vec::new()
}

/// Opens the scene that shows the selected claim.
fn show_claim(session: &mut Session) -> Vec<Effect> {
    let Some(Overlay::List(Listed::Paper, list)) = &session.overlay else { return Vec::new() };
    let selected = session.claim_rows(list).get(list.selected).map(|(claim, _)| *claim);
    let Some(claim) = selected else { return Vec::new() };
    session.overlay = None;
    match claim.scene.and_then(|name| find(name).ok()) {
        Some(scene) => {
            open_scene(session, scene);
            inform(session, format!("{}: {}", claim.equation, claim.statement));
        }
        None => {
            refuse(session, format!("no scene shows {}: it is a formula alone", claim.equation));
        }
    }
    Vec::new()
}

/// Moves the selection of the open list, as far as there are rows.
pub fn move_by(session: &mut Session, by: isize) -> Vec<Effect> {
    let last = session.list_length().saturating_sub(1);
    if let Some(list) = session.list_mut() {
        list.selected = list.selected.saturating_add_signed(by).min(last);
    }
    Vec::new()
}

/// Lets typed characters go to the search.
pub fn search(session: &mut Session) -> Vec<Effect> {
    if let Some(list) = session.list_mut() {
        list.searching = true;
    }
    Vec::new()
}

/// Ends the search and keeps the rows found; what is to be picked is picked at once.
pub fn search_done(session: &mut Session) -> Vec<Effect> {
    if let Some(list) = session.list_mut() {
        list.searching = false;
    }
    match session.overlay {
        Some(Overlay::List(Listed::Scenes | Listed::Views, _)) => choose(session),
        _ => Vec::new(),
    }
}

/// Ends the search and shows all rows.
pub fn search_drop(session: &mut Session) -> Vec<Effect> {
    if let Some(list) = session.list_mut() {
        *list = List::default();
    }
    Vec::new()
}

/// Deletes the last character of the search.
pub fn search_delete(session: &mut Session) -> Vec<Effect> {
    if let Some(list) = session.list_mut() {
        list.search.pop();
        list.selected = 0;
    }
    Vec::new()
}

/// Clears the search.
pub fn search_clear(session: &mut Session) -> Vec<Effect> {
    if let Some(list) = session.list_mut() {
        list.search.clear();
        list.selected = 0;
    }
    Vec::new()
}

/// Opens the selected scene, switches the selected layer, or shows the selected view.
pub fn choose(session: &mut Session) -> Vec<Effect> {
    match &session.overlay {
        Some(Overlay::List(Listed::Scenes, list)) => {
            if let Some(scene) = session.scene_rows(list).get(list.selected) {
                session.overlay = None;
                open_scene(session, Arc::clone(scene));
            }
        }
        Some(Overlay::List(Listed::Layers, list)) => {
            if let Some(row) = session.layer_rows(list).get(list.selected) {
                return toggle(session, row.layer);
            }
        }
        Some(Overlay::List(Listed::Views, list)) => {
            if let Some(row) = session.view_rows(list).get(list.selected) {
                session.overlay = None;
                return show(session, row.view);
            }
        }
        Some(Overlay::List(Listed::Paper, _)) => return show_claim(session),
        _ => {}
    }
    Vec::new()
}
