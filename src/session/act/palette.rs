//! The palette: everything that has a name, run where it applies.

use crate::session::act::screen_setup::show_from_list;
use crate::session::act::{lists, prompt};
use crate::session::read::palette::PaletteRow;
use crate::session::state::{Listed, NextCommand, Overlay, Session};

/// The selected row, to be run. A command that takes words opens the line for typing them. The list of costs,
/// in which nothing can be run, closes.
pub fn choose(session: &mut Session) -> Result<Option<NextCommand>, String> {
    let Some(Overlay::List(Listed::Palette, list)) = &session.overlay else {
        session.overlay = None;
        return Ok(None);
    };
    let rows = session.palette_rows(list);
    let Some(row) = rows.get(list.selected) else { return Ok(None) };
    session.overlay = None;
    Ok(Some(match row {
        PaletteRow::Command(command) => NextCommand::Command(command),
        PaletteRow::Line(line) => {
            prompt::open_with(session, format!("{} ", line.name));
            return Ok(None);
        }
        PaletteRow::Scene(scene) => NextCommand::Line(format!("scene {}", scene.name)),
        PaletteRow::View(row) => return show_from_list(session, row.view).map(|()| None),
        PaletteRow::Layer(layer) => NextCommand::Line(format!("layer {}", layer.name)),
        PaletteRow::Machine(machine) => NextCommand::Line(format!("belt {}", machine.name)),
        PaletteRow::Claim(claim) => return lists::show_claim(session, claim).map(|()| None),
    }))
}
