//! The palette: one list of everything that has a name, and where a command can be run.

use std::sync::Arc;

use crate::scene::{LAYERS, LayerSpec, Scene, VIEWS, ViewSpec, library};
use crate::session::message::key::Key;
use crate::session::state::command::{Command, LineCommand};
use crate::session::state::context::{Context, contexts};
use crate::session::state::overlay::List;
use crate::session::state::plot::Pane;
use crate::session::state::session::Session;
use crate::study::claims::{Claim, claims};

#[derive(Clone, Copy, Debug)]
pub enum PaletteRow {
    /// A command of the keys.
    Command(&'static Command),
    /// A command that takes words.
    Line(&'static LineCommand),
    /// A scene, to be opened.
    Scene(&'static Arc<Scene>),
    /// A view, to be shown in the plot in use.
    View(&'static ViewSpec),
    /// A layer, to be switched.
    Layer(&'static LayerSpec),
    /// A claim of the paper, to be shown by its scene.
    Claim(&'static Claim),
}

/// Other words for what stands in the palette, by the name that it has there.
pub(in crate::session) const ALIASES: &[(&str, &str)] = &[
    ("walk-to-next", "fold special point limit jump"),
    ("walk", "branch continuation follow"),
    ("save-figure", "export picture svg png print"),
    ("figure", "export picture svg png print data"),
    ("save-scan", "export data csv"),
    ("scan-form", "sweep grid batch"),
    ("scan", "sweep grid batch"),
    ("play-motion", "animate animation movie time"),
    ("start-inside", "kick stable capture"),
    ("start-outside", "kick unstable escape"),
    ("edit", "change value number"),
    ("undo", "back revert"),
    ("tol", "tolerance accuracy precision"),
    ("coarser", "accuracy fast draft"),
    ("finer", "accuracy precise exact"),
    ("next-method", "integrator solver"),
    ("method", "integrator solver"),
    ("costs", "performance time evaluations telemetry"),
    ("views", "window plot kind"),
    ("add-plot", "split window"),
    ("remove-plot", "close window"),
    ("enlarge", "zoom maximize full"),
    ("equal", "aspect circle square isometric"),
    ("copy-number", "yank clipboard value"),
    ("copy-row", "yank clipboard values"),
    ("theme", "colour dark light contrast"),
    ("color", "colour depth"),
    ("glyphs", "braille ascii characters"),
    ("write", "save session"),
    ("open", "load session restore"),
    ("quit", "exit leave close"),
    ("diagram", "branch continuation amplitude"),
    ("cycles", "orbit"),
];

impl PaletteRow {
    pub fn name(self) -> &'static str {
        match self {
            PaletteRow::Command(command) => command.name,
            PaletteRow::Line(line) => line.name,
            PaletteRow::Scene(scene) => &scene.name,
            PaletteRow::View(view) => view.name,
            PaletteRow::Layer(layer) => layer.name,
            PaletteRow::Claim(claim) => claim.equation,
        }
    }

    /// What it does or shows, in one line.
    pub fn meaning(self) -> &'static str {
        match self {
            PaletteRow::Command(command) => command.doc,
            PaletteRow::Line(line) => line.doc,
            PaletteRow::Scene(scene) => &scene.title,
            PaletteRow::View(view) => view.meaning,
            PaletteRow::Layer(layer) => layer.meaning,
            PaletteRow::Claim(claim) => claim.statement,
        }
    }

    /// Other words by which it is found.
    fn aliases(self) -> &'static str {
        let other = ALIASES.iter().find(|(name, _)| *name == self.name());
        match self {
            PaletteRow::View(view) => view.title,
            PaletteRow::Claim(claim) => claim.section,
            PaletteRow::Scene(scene) => scene.also.as_deref().unwrap_or_default(),
            _ => other.map_or("", |(_, words)| words),
        }
    }
}

impl Session {
    /// Every row that has all the words searched for; without a search, what belongs to the pane in focus
    /// comes first, and what works only inside a list or a line is left out.
    pub fn palette_rows(&self, list: &List) -> Vec<PaletteRow> {
        let outside = |command: &&Command| home(command).is_some();
        let commands = self.keymap.commands().filter(outside).map(PaletteRow::Command);
        let lines = self.keymap.lines().map(PaletteRow::Line);
        let scenes = library().iter().map(PaletteRow::Scene);
        let views = VIEWS.iter().map(PaletteRow::View);
        let layers = LAYERS.iter().map(PaletteRow::Layer);
        let claims = claims().map(PaletteRow::Claim);
        let all = commands.chain(lines).chain(scenes).chain(views).chain(layers).chain(claims);
        let mut rows: Vec<_> = all.filter(|row| list.matches(&self.words(*row))).collect();
        let search = list.search.trim().to_lowercase();
        if search.is_empty() {
            rows.sort_by_key(|row| self.distance(*row));
        } else {
            rows.sort_by_key(|row| rank(*row, &search));
        }
        rows
    }

    /// The heading under which a row stands.
    pub fn heading(&self, row: PaletteRow) -> &'static str {
        match row {
            PaletteRow::Command(command) => self.place_of(command).map_or("", Context::title),
            PaletteRow::Line(_) => "Behind a colon",
            PaletteRow::Scene(_) => "Scenes",
            PaletteRow::View(_) => "Views of a plot",
            PaletteRow::Layer(_) => "Layers",
            PaletteRow::Claim(_) => "Claims of the paper",
        }
    }

    /// How far a row is from the pane in focus.
    fn distance(&self, row: PaletteRow) -> usize {
        let PaletteRow::Command(command) = row else { return usize::MAX };
        let Some(place) = self.place_of(command) else { return usize::MAX };
        let near = self.contexts_below().iter().position(|context| *context == place);
        let far = || contexts().position(|row| row.context == place).unwrap_or(0);
        near.unwrap_or_else(|| self.contexts_below().len() + far())
    }

    /// Where a command is run: in the pane in focus if it has keys there.
    pub fn place_of(&self, command: &Command) -> Option<Context> {
        let mut here = self.contexts_below().iter();
        let has_keys = |context: &&Context| command.keys.iter().any(|(at, _)| at == *context);
        here.find(has_keys).copied().or(home(command))
    }

    /// The words by which a row is found: its name, what it does, its keys.
    fn words(&self, row: PaletteRow) -> Vec<String> {
        let keys = match row {
            PaletteRow::Command(command) => self.keymap.places(command),
            _ => Vec::new(),
        };
        let keys = keys.iter().flat_map(|(_, keys)| keys).map(ToString::to_string);
        let texts = [row.name(), row.meaning(), row.aliases()].map(str::to_owned);
        texts.into_iter().chain(keys).collect()
    }
}

/// The first context outside of lists and lines in which a command has keys of its own: the commands that
/// switch layers have none.
fn home(command: &Command) -> Option<Context> {
    let outside = |(context, keys): &&(Context, &[&str])| !context.is_overlay() && !keys.is_empty();
    command.keys.iter().find(outside).map(|(context, _)| *context)
}

/// How far down a row stands that has the searched words: those come first that are called so.
fn rank(row: PaletteRow, search: &str) -> usize {
    let name = row.name();
    let as_name = [search.replace(' ', "-"), search.replace(' ', "")];
    let tests = [
        as_name.iter().any(|search| name == search),
        as_name.iter().any(|search| name.starts_with(search)),
        as_name.iter().any(|search| name.contains(search)),
        row.aliases().contains(search),
        row.meaning().to_lowercase().contains(search),
    ];
    tests.iter().position(|test| *test).unwrap_or(tests.len())
}

/// The pane in which a command belongs, where that is not the one in focus; or what is not here.
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

/// The command that a key has in a plot that is on show but not in focus; else one of a view that no plot
/// shows. What is open keeps its keys.
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

/// Whether a context needs something that is not there: an open line or list, a held branch, a view.
fn lacks(session: &Session, context: Context) -> bool {
    context.is_overlay()
        || context == Context::Walk
        || (context.view().is_some() && pane(session, context).is_none())
}
