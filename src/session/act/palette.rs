//! The palette: everything that has a name, run where it applies.

use crate::session::act::screen_setup::show_from_list;
use crate::session::act::{lists, prompt};
use crate::session::effect::Effect;
use crate::session::read::palette::PaletteRow;
use crate::session::state::command::Chosen;
use crate::session::state::overlay::{List, Listed, Overlay};
use crate::session::state::session::Session;

/// Opens the palette, with the search active if `searching`.
pub fn open(session: &mut Session, searching: bool) -> Vec<Effect> {
    let list = List { searching, ..List::default() };
    session.overlay = Some(Overlay::List(Listed::Palette, list));
    Vec::new()
}

/// The selected row, to be run. A command that takes words opens the line for typing them. The list of costs,
/// in which nothing can be run, closes.
pub fn choose(session: &mut Session) -> Option<Chosen> {
    let Some(Overlay::List(Listed::Palette, list)) = &session.overlay else {
        session.overlay = None;
        return None;
    };
    let row = *session.palette_rows(list).get(list.selected)?;
    session.overlay = None;
    match row {
        PaletteRow::Command(command) => return Some(Chosen::Command(command)),
        PaletteRow::Line(line) => {
            prompt::open_with(session, format!("{} ", line.name));
        }
        PaletteRow::Scene(scene) => return Some(Chosen::Line(format!("scene {}", scene.name))),
        PaletteRow::View(row) => {
            show_from_list(session, row.view);
        }
        PaletteRow::Layer(layer) => return Some(Chosen::Line(format!("layer {}", layer.name))),
        PaletteRow::Machine(machine) => {
            return Some(Chosen::Line(format!("belt {}", machine.name)));
        }
        PaletteRow::Claim(claim) => lists::show_claim(session, claim),
    }
    None
}
