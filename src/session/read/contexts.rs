//! The contexts that hold at present, the keys that matter in them, and the palette, a list of everything that has a
//! name, with the place where each can be run.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::paper::{Claim, claims};
use crate::scene::machine::library::machines;
use crate::scene::{LAYERS, LayerSpec, Machine, Scene, VIEWS, ViewSpec, library};
use crate::session::read::lists::{aliases, rank};
use crate::session::state::context::{chain, contexts};
use crate::session::{
    Command, Context, Key, List, Listed, Overlay, Pane, Pending, Session, SessionCaption,
};

impl Session {
    /// The contexts that hold at present, the most specific first: one of
    /// [`chains`](crate::session::state::context::chains).
    pub fn contexts(&self) -> &'static [Context] {
        let pending = self.pending.map(Pending::context);
        pending.map_or_else(|| self.contexts_at_rest(), chain)
    }

    /// The contexts that hold when nothing is pending.
    pub(crate) fn contexts_at_rest(&self) -> &'static [Context] {
        let first = match &self.overlay {
            None => return self.contexts_below(),
            Some(Overlay::List(Listed::Palette, list)) if list.searching => Context::Palette,
            Some(Overlay::List(_, list)) if list.searching => Context::Search,
            Some(Overlay::List(Listed::Palette | Listed::Cost, _)) => Context::Help,
            Some(Overlay::List(Listed::Scenes, _)) => Context::Scenes,
            Some(Overlay::List(Listed::Layers, _)) => Context::Layers,
            Some(Overlay::List(Listed::Views, _)) => Context::Views,
            Some(Overlay::List(Listed::Paper, _)) => Context::Paper,
            Some(Overlay::List(Listed::Interrupted, _)) => Context::Interrupted,
            Some(Overlay::Entry(_)) => Context::Entry,
            Some(Overlay::Prompt(_)) => Context::Prompt,
            Some(Overlay::Offer(_)) => Context::Offer,
        };
        chain(first)
    }

    /// The contexts that hold when nothing is open.
    pub(crate) fn contexts_below(&self) -> &'static [Context] {
        chain(match self.focused() {
            _ if self.held.is_some() => Context::Walk,
            Some(plot) => Context::View(plot.view),
            None => Context::Parameters,
        })
    }

    /// Whether a key has its usual effect while the caption of a tour is shown: the caption names its command,
    /// or an overlay that such a key has opened takes it.
    pub fn tries(&self, key: Key) -> bool {
        let SessionCaption::Tour(text, _) = &self.caption else { return false };
        let named = |command: &Command| text.contains(&format!("{{{}}}", command.name));
        self.overlay.is_some()
            || self.pending.is_some()
            || self.keymap.command(self.contexts(), key).is_some_and(named)
    }

    /// Whether a key runs a command or is typed in the present contexts.
    pub(crate) fn means(&self, key: Key) -> bool {
        let contexts = self.contexts();
        self.keymap.command(contexts, key).is_some() || contexts[0].takes_text()
    }

    /// The keys that matter at present, with a word for each, for the footer.
    pub fn hints(&self) -> Vec<Hint> {
        let mut hints: Vec<Hint> = Vec::new();
        let mut shown = BTreeSet::new();
        for context in self.contexts() {
            for command in self.keymap.commands().filter(|command| !command.hint.is_empty()) {
                let Some(key) = self.keymap.keys_in(*context, command).next() else { continue };
                // A finished scan cannot be paused.
                let over = command.name == "scan-pause" && self.scan_request().is_none();
                if over || !shown.insert(command.name) {
                    continue;
                }
                match hints.iter_mut().find(|hint| hint.text == command.hint) {
                    Some(hint) => hint.keys.push(key),
                    None => hints.push(Hint { keys: vec![key], text: command.hint }),
                }
            }
        }
        hints
    }
}

/// An entry of the footer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The keys of the commands that share the word.
    pub keys: Vec<Key>,
    pub text: &'static str,
}

#[derive(Clone, Copy, Debug)]
pub enum PaletteRow {
    /// A command of a key.
    Command(&'static Command),
    /// A command that takes words.
    Line(&'static Command),
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
    /// Its name, its other name if it has one, its explanation in one line, and the heading under which it stands,
    /// unless that depends on the pane in focus.
    fn texts(self) -> [&'static str; 4] {
        match self {
            PaletteRow::Command(command) => [command.name, "", command.doc, ""],
            PaletteRow::Line(line) => [line.name, "", line.doc, "Typed after a colon"],
            PaletteRow::Scene(scene) => {
                let other = scene.also.as_deref().unwrap_or_default();
                [&scene.name, other, &scene.title, "Scenes"]
            }
            PaletteRow::View(view) => [view.name, view.title, view.meaning, "Views of a plot"],
            PaletteRow::Layer(layer) => [layer.name, "", layer.meaning, "Layers"],
            PaletteRow::Machine(machine) => [&machine.name, "", &machine.title, "Machines"],
            PaletteRow::Claim(claim) => {
                [claim.equation, claim.section, claim.statement, "Claims of the paper"]
            }
        }
    }

    pub fn name(self) -> &'static str {
        self.texts()[0]
    }

    /// Explanation in one line.
    pub fn meaning(self) -> &'static str {
        self.texts()[2]
    }

    /// All of its names.
    fn names(self) -> Vec<&'static str> {
        let [name, other, ..] = self.texts();
        let own = [name, other].into_iter().filter(|name| !name.is_empty());
        own.chain(aliases(name).iter().copied()).collect()
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
            let rank = |row: &PaletteRow| rank(&list.search, &row.names(), row.meaning());
            rows.sort_by_cached_key(|row| if is_key(row) { 0 } else { rank(row) });
        }
        rows
    }

    /// The selected row of a list, if it can be run.
    pub(crate) fn selected_row(&self, listed: Listed, list: &List) -> Option<PaletteRow> {
        let at = list.selected;
        Some(match listed {
            Listed::Scenes => PaletteRow::Scene(self.scene_rows(list).get(at)?),
            Listed::Layers => PaletteRow::Layer(self.layer_rows(list).get(at)?),
            Listed::Views => PaletteRow::View(self.view_rows(list).get(at)?),
            Listed::Paper => PaletteRow::Claim(self.claim_rows(list).get(at)?.0),
            Listed::Palette => *self.palette_rows(list).get(at)?,
            Listed::Cost | Listed::Interrupted => return None,
        })
    }

    /// The heading under which a row stands.
    pub fn heading(&self, row: PaletteRow) -> &'static str {
        let PaletteRow::Command(command) = row else { return row.texts()[3] };
        self.place_of(command).map_or("", Context::title)
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
pub(crate) fn place(session: &Session, command: &Command) -> Result<Option<Pane>, Context> {
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
pub(crate) fn elsewhere(session: &Session, key: Key) -> Option<&'static Command> {
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
