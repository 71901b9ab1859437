//! The palette: every command by its words, run where it belongs.

use super::{prompt, refuse};
use crate::session::command::{COMMANDS, Command};
use crate::session::key::Key;
use crate::session::keymap::Context;
use crate::session::line::{LINES, LineCommand};
use crate::session::message::Effect;
use crate::session::overlay::{List, Listed, Overlay};
use crate::session::plot::Pane;
use crate::session::state::Session;
use crate::session::update::general::focus_on;

/// A row of the palette.
#[derive(Clone, Copy, Debug)]
pub enum PaletteRow {
    /// A command of the keys.
    Command(&'static Command),
    /// A command that takes words.
    Line(&'static LineCommand),
}

impl PaletteRow {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            PaletteRow::Command(command) => command.name,
            PaletteRow::Line(line) => line.name,
        }
    }
}

impl Session {
    /// What the palette lists: everything that can be done where no line or list is open, the commands
    /// first whose name contains what is searched for.
    #[must_use]
    pub fn palette_rows(&self, list: &List) -> Vec<PaletteRow> {
        let commands = COMMANDS
            .iter()
            .filter(|command| command.keys.iter().any(|(context, _)| !context.is_overlay()))
            .filter(|command| list.matches(&self.words(command)))
            .map(PaletteRow::Command);
        let lines =
            LINES.iter().filter(|line| list.matches(&[line.name, line.doc])).map(PaletteRow::Line);
        let mut rows: Vec<PaletteRow> = commands.chain(lines).collect();
        rows.sort_by_key(|row| rank(*row, &list.search.to_lowercase()));
        rows
    }
}

/// How far down a row stands that has the searched words: those come first that are called so.
fn rank(row: PaletteRow, search: &str) -> usize {
    let doc = match row {
        PaletteRow::Command(command) => command.doc,
        PaletteRow::Line(line) => line.doc,
    };
    let (name, search) = (row.name(), search.trim());
    let tests = [
        name == search,
        name.starts_with(search),
        name.contains(search),
        doc.to_lowercase().contains(search),
    ];
    tests.iter().position(|test| *test).unwrap_or(tests.len())
}

/// Opens the palette; what is typed searches it.
pub fn open(session: &mut Session) -> Vec<Effect> {
    let list = List { searching: true, ..List::default() };
    session.overlay = Some(Overlay::List(Listed::Palette, list));
    Vec::new()
}

/// Runs the selected command; one that takes words gets a line to type them.
pub fn choose(session: &mut Session, key: Key) -> Vec<Effect> {
    let Some(Overlay::List(Listed::Palette, list)) = &session.overlay else { return Vec::new() };
    match session.palette_rows(list).get(list.selected) {
        None => Vec::new(),
        Some(PaletteRow::Command(command)) => {
            session.overlay = None;
            run(session, command, key)
        }
        Some(PaletteRow::Line(line)) => prompt::open_with(session, format!("{} ", line.name)),
    }
}

/// Runs a command where it belongs: here, or in the pane that has it, which gets the focus.
pub fn run(session: &mut Session, command: &Command, key: Key) -> Vec<Effect> {
    match place(session, command) {
        Ok(Some(pane)) => focus_on(session, pane),
        Ok(None) => {}
        Err(place) => {
            refuse(session, format!("{} belongs to what is not here: {place}", command.name));
            return Vec::new();
        }
    }
    (command.run)(session, key)
}

/// The pane in which a command belongs, where that is not the one in focus; or what is not here.
pub(in crate::session) fn place(
    session: &Session,
    command: &Command,
) -> Result<Option<Pane>, &'static str> {
    let here = session.contexts();
    let places: Vec<Context> = command.keys.iter().map(|(context, _)| *context).collect();
    if places.iter().any(|place| here.contains(place)) {
        return Ok(None);
    }
    let pane = places.iter().copied().find_map(|place| pane(session, place));
    match (pane, places.first()) {
        (None, Some(place)) if places.iter().all(|place| lacks(session, *place)) => {
            Err(place.title())
        }
        (pane, _) => Ok(pane),
    }
}

/// The pane in which the keys of a context apply.
fn pane(session: &Session, context: Context) -> Option<Pane> {
    match context {
        Context::Parameters => Some(Pane::Parameters),
        Context::Plots => Some(Pane::Plot(session.plot)),
        _ => {
            let view = context.view()?;
            let shows = |index: &usize| session.plots[*index].view == view;
            session.on_show().find(shows).map(Pane::Plot)
        }
    }
}

/// Whether a context needs something that is not there: an open line or list, a held branch, a view.
fn lacks(session: &Session, context: Context) -> bool {
    context.is_overlay()
        || context == Context::Walk
        || (context.view().is_some() && pane(session, context).is_none())
}
