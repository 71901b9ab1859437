//! The palette, a list of everything that has a name, and where commands can be run.

use std::sync::Arc;

use crate::paper::{Claim, claims};
use crate::scene::machine::library::machines;
use crate::scene::{LAYERS, LayerSpec, Machine, Scene, VIEWS, ViewSpec, library};
use crate::session::message::key::Key;
use crate::session::read::search;
use crate::session::state::context::contexts;
use crate::session::state::{Command, Context, LineCommand, List, Pane, Session};

#[derive(Clone, Copy, Debug)]
pub enum PaletteRow {
    /// A command of a key.
    Command(&'static Command),
    /// A command that takes words.
    Line(&'static LineCommand),
    /// A scene, to open.
    Scene(&'static Arc<Scene>),
    /// A view, to show in the plot in use.
    View(&'static ViewSpec),
    /// A layer, to switch.
    Layer(&'static LayerSpec),
    /// A built-in machine, to open.
    Machine(&'static Machine),
    /// A claim of the paper, to show in its scene.
    Claim(&'static Claim),
}

impl PaletteRow {
    pub fn name(self) -> &'static str {
        match self {
            PaletteRow::Command(command) => command.name,
            PaletteRow::Line(line) => line.name,
            PaletteRow::Scene(scene) => &scene.name,
            PaletteRow::View(view) => view.name,
            PaletteRow::Layer(layer) => layer.name,
            PaletteRow::Machine(machine) => &machine.name,
            PaletteRow::Claim(claim) => claim.equation,
        }
    }

    /// Explanation in one line.
    pub fn meaning(self) -> &'static str {
        match self {
            PaletteRow::Command(command) => command.doc,
            PaletteRow::Line(line) => line.doc,
            PaletteRow::Scene(scene) => &scene.title,
            PaletteRow::View(view) => view.meaning,
            PaletteRow::Layer(layer) => layer.meaning,
            PaletteRow::Machine(machine) => &machine.title,
            PaletteRow::Claim(claim) => claim.statement,
        }
    }

    /// All of its names.
    fn names(self) -> Vec<&'static str> {
        let own = match self {
            PaletteRow::View(view) => view.title,
            PaletteRow::Claim(claim) => claim.section,
            PaletteRow::Scene(scene) => scene.also.as_deref().unwrap_or_default(),
            PaletteRow::Command(_)
            | PaletteRow::Line(_)
            | PaletteRow::Layer(_)
            | PaletteRow::Machine(_) => "",
        };
        let other = search::aliases(self.name()).iter().copied();
        [self.name(), own].into_iter().filter(|name| !name.is_empty()).chain(other).collect()
    }
}

impl Session {
    /// All rows that contain all searched words. Without a search, the commands of the pane in focus come
    /// first. Commands that work only inside a list or a line, or with a digit, are left out.
    pub fn palette_rows(&self, list: &List) -> Vec<PaletteRow> {
        let outside = |command: &&Command| home(command).is_some() && !takes_digit(command);
        let commands = self.keymap.commands().filter(outside).map(PaletteRow::Command);
        let lines = self.keymap.lines().map(PaletteRow::Line);
        let scenes = library().iter().map(PaletteRow::Scene);
        let views = VIEWS.iter().map(PaletteRow::View);
        let layers = LAYERS.iter().map(PaletteRow::Layer);
        let claims = claims().map(PaletteRow::Claim);
        let machines = machines().iter().map(PaletteRow::Machine);
        let all = commands.chain(lines).chain(scenes).chain(views).chain(layers);
        let all = all.chain(machines).chain(claims);
        let mut rows: Vec<_> = all.filter(|row| list.matches(&self.words(*row))).collect();
        if list.search.trim().is_empty() {
            rows.sort_by_key(|row| self.distance(*row));
        } else {
            let is_key = |row: &PaletteRow| self.keys(*row).contains(&list.search);
            let rank = |row: &PaletteRow| search::rank(&list.search, &row.names(), row.meaning());
            rows.sort_by_cached_key(|row| if is_key(row) { 0 } else { rank(row) });
        }
        rows
    }

    /// The heading under which a row stands.
    pub fn heading(&self, row: PaletteRow) -> &'static str {
        match row {
            PaletteRow::Command(command) => self.place_of(command).map_or("", Context::title),
            PaletteRow::Line(_) => "Typed after a colon",
            PaletteRow::Scene(_) => "Scenes",
            PaletteRow::View(_) => "Views of a plot",
            PaletteRow::Layer(_) => "Layers",
            PaletteRow::Machine(_) => "Machines",
            PaletteRow::Claim(_) => "Claims of the paper",
        }
    }

    /// The distance of a row's context from the pane in focus.
    fn distance(&self, row: PaletteRow) -> usize {
        let PaletteRow::Command(command) = row else { return usize::MAX };
        let Some(place) = self.place_of(command) else { return usize::MAX };
        let near = self.contexts_below().iter().position(|context| *context == place);
        let far = || contexts().position(|row| row.context == place).unwrap_or(0);
        near.unwrap_or_else(|| self.contexts_below().len() + far())
    }

    /// The context in which a command is run: that of the pane in focus if it has keys there.
    pub fn place_of(&self, command: &Command) -> Option<Context> {
        let mut here = self.contexts_below().iter();
        let has_keys = |context: &&Context| command.keys.iter().any(|(at, _)| at == *context);
        here.find(has_keys).copied().or(home(command))
    }

    /// The words by which a row is found: its names, its explanation and its keys.
    fn words(&self, row: PaletteRow) -> Vec<String> {
        let texts = row.names().into_iter().chain([row.meaning()]).map(str::to_owned);
        texts.chain(self.keys(row)).collect()
    }

    /// The keys that run a row.
    fn keys(&self, row: PaletteRow) -> Vec<String> {
        let PaletteRow::Command(command) = row else { return Vec::new() };
        let places = self.keymap.places(command);
        places.iter().flat_map(|(_, keys)| keys).map(ToString::to_string).collect()
    }
}

/// Whether a command depends on the digit that runs it.
fn takes_digit(command: &Command) -> bool {
    command.keys.iter().any(|(_, keys)| keys.contains(&"1"))
}

/// The first context outside of lists and lines in which a command has default keys; commands that switch
/// layers have none.
fn home(command: &Command) -> Option<Context> {
    let outside = |(context, keys): &&(Context, &[&str])| !context.is_overlay() && !keys.is_empty();
    command.keys.iter().find(outside).map(|(context, _)| *context)
}

/// The pane in which a command applies, if that is not the one in focus. Fails with the context that is
/// missing.
pub(in crate::session) fn place(
    session: &Session,
    command: &Command,
) -> Result<Option<Pane>, Context> {
    let here = session.contexts();
    let places: Vec<Context> = command.keys.iter().map(|(context, _)| *context).collect();
    if places.iter().any(|place| here.contains(place)) {
        return Ok(None);
    }
    let pane = places.iter().copied().find_map(|place| pane(session, place));
    match (pane, places.first()) {
        (None, Some(place)) if places.iter().all(|place| lacks(session, *place)) => Err(*place),
        (pane, _) => Ok(pane),
    }
}

/// The command of a key in a plot that is on show but not in focus, otherwise that in a view that no plot
/// shows; `None` if something is open, which keeps its keys.
pub(in crate::session) fn elsewhere(session: &Session, key: Key) -> Option<&'static Command> {
    if session.overlay.is_some() {
        return None;
    }
    let views = VIEWS.iter().map(|row| Context::View(row.view));
    let found = views.filter_map(|context| {
        let command = session.keymap.command(&[context], key)?;
        Some((pane(session, context).is_none(), command))
    });
    found.min_by_key(|(absent, _)| *absent).map(|(_, command)| command)
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

/// Whether a context needs something that is missing: an open line or list, a held branch, or a view.
fn lacks(session: &Session, context: Context) -> bool {
    context.is_overlay()
        || context == Context::Walk
        || (context.view().is_some() && pane(session, context).is_none())
}
