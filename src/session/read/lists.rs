//! The rows of the lists over the panes, everything that has a name among them, and the search in them: synonyms, and the
//! order of the rows found.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use crate::numerics::distinct;
use crate::paper::{Claim, ClaimResult, Verdict, claims};
use crate::scene::machine::library::machines;
use crate::scene::{
    GLOSSARY, GlossaryEntry, LAYERS, Layer, LayerSpec, Machine, Scene, SceneGroup, VIEWS, View,
    ViewSpec, library,
};
use crate::session::{
    CONTEXTS, Code, Command, Context, KeptSession, Key, List, ListKind, Session, place,
};

/// The heading of what cannot be run.
const NOT_NOW: &str = "Not now";

#[derive(Clone, Copy, Debug)]
pub enum PaletteRow {
    /// A command of a key, or one that takes words.
    Command(&'static Command),
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
    /// An entry of the glossary, to read.
    Entry(&'static GlossaryEntry),
}

impl PaletteRow {
    /// Its name, its other name if it has one, its explanation in one line, and the heading under which it stands,
    /// unless keys run it: then that depends on the pane in focus.
    fn texts(self) -> [&'static str; 4] {
        match self {
            PaletteRow::Command(command) => [command.name, "", command.doc, "Typed after a colon"],
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
            PaletteRow::Entry(entry) => [entry.name, "", entry.definition, "Glossary"],
        }
    }

    pub fn name(self) -> &'static str {
        self.texts()[0]
    }

    /// Explanation in one line.
    pub fn meaning(self) -> &'static str {
        self.texts()[2]
    }

    /// Whether this is the name of something to be shown. Names of commands are words like others.
    fn is_called(self, name: &str) -> bool {
        let is_shown =
            matches!(self, PaletteRow::Scene(_) | PaletteRow::View(_) | PaletteRow::Layer(_));
        is_shown && plain(self.name()) == plain(name)
    }

    /// All of its names.
    fn names(self) -> Vec<&'static str> {
        let [name, other, ..] = self.texts();
        let synonyms: Vec<&str> = match self {
            PaletteRow::Entry(entry) => entry.words.split(", ").collect(),
            _ => SYNONYMS.get(name).cloned().unwrap_or_default(),
        };
        [name, other].into_iter().filter(|name| !name.is_empty()).chain(synonyms).collect()
    }
}

impl Session {
    /// All rows that contain all searched words. Without a search, the commands of the pane in focus come first, and what
    /// cannot be run is left out; in a search it comes last, and of equal matches what was used last first. One thing
    /// has one row: left out are commands with words where another row does the same, machines that have a scene of their
    /// name, and claims that no scene shows.
    pub fn palette_rows(&self, list: &List) -> Vec<PaletteRow> {
        let lines = self.keymap.lines().filter(|line| line.hint.is_empty());
        let commands = self.listed_commands().chain(lines).map(PaletteRow::Command);
        let scenes = library().iter().map(PaletteRow::Scene);
        let views = VIEWS.iter().map(PaletteRow::View);
        // That of the whole model is a command of a key.
        let layers = LAYERS.iter().filter(|row| row.layer != Layer::Whole).map(PaletteRow::Layer);
        let claims = claims().filter(|claim| claim.scene.is_some()).map(PaletteRow::Claim);
        let alone = |machine: &&Machine| library().iter().all(|it| it.name != machine.name);
        let machines = machines().iter().filter(alone).map(PaletteRow::Machine);
        let entries = GLOSSARY.iter().map(PaletteRow::Entry);
        let all = commands.chain(scenes).chain(views).chain(layers).chain(machines).chain(claims);
        let all = all.chain(entries);
        let searches = !list.search.trim().is_empty();
        let all = all.filter(|row| searches || !self.is_out(list, *row));
        let distance = |row| if searches { 0 } else { self.distance(row) };
        let last = |row: PaletteRow| self.used.iter().position(|name| *name == row.name());
        let order = |row| (distance(row), Reverse(last(row).filter(|_| searches)));
        self.matching(list, all, |row| row, order, |row| self.heading_in(list, row))
    }

    /// The commands of keys that are listed: those that work outside of lists and lines, and without a digit.
    pub(crate) fn listed_commands(&self) -> impl Iterator<Item = &'static Command> {
        let digit = Key::plain(Code::Char('1'));
        self.keymap.commands().filter(move |command| {
            home(command).is_some() && !command.keys.iter().any(|(_, keys)| keys.contains(&digit))
        })
    }

    /// Why a row of the list of everything cannot be run at present, in words that name commands.
    pub fn refused<'a>(&self, list: &'a List, row: PaletteRow) -> Option<&'a str> {
        match row {
            PaletteRow::Command(command) => list.refused.get(command.name).map(String::as_str),
            PaletteRow::View(view) => self.lacks(view.view),
            PaletteRow::Layer(layer) => {
                self.lacks(layer.view).or_else(|| self.not_drawn(layer.layer))
            }
            _ => None,
        }
    }

    /// Whether a row that cannot be run leaves its place. One whose command waits for answers keeps it: where a row stands
    /// must not depend on which answers have come.
    fn is_out(&self, list: &List, row: PaletteRow) -> bool {
        let waits = |command: &Command| !command.needs.is_empty() && place(self, command).is_ok();
        let stays = matches!(row, PaletteRow::Command(command) if waits(command));
        !stays && self.refused(list, row).is_some()
    }

    /// The heading under which a row stands in the list of everything.
    pub fn heading_in(&self, list: &List, row: PaletteRow) -> &'static str {
        let out = self.is_out(list, row).then_some(NOT_NOW);
        out.unwrap_or_else(|| self.heading(row))
    }

    /// The rows that contain all searched words: the best matches first, those alike in this order. The rows of a group stay
    /// together.
    fn matching<T: Copy, Place: Ord>(
        &self,
        list: &List,
        all: impl Iterator<Item = T>,
        row: fn(T) -> PaletteRow,
        order: impl Fn(T) -> Place,
        group: impl Fn(T) -> &'static str,
    ) -> Vec<T> {
        let search = &list.search;
        let rank = |row: PaletteRow| match search.trim() {
            "" => 0,
            _ if self.keys(row).contains(search) || row.is_called(search) => 0,
            _ => 1 + rank(search, &row.names(), row.meaning()),
        };
        let mut found: Vec<T> = all.filter(|it| list.matches(&self.words(row(*it)))).collect();
        found.sort_by_cached_key(|it| (rank(row(*it)), order(*it)));
        let groups = distinct(found.iter().map(|it| group(*it)));
        found.sort_by_cached_key(|it| {
            let group = group(*it);
            (group == NOT_NOW, groups.iter().position(|name| *name == group))
        });
        found
    }

    /// The scenes that the picker lists, in groups.
    pub fn scene_rows(&self, list: &List) -> Vec<&'static Arc<Scene>> {
        let group = |scene: &'static Arc<Scene>| SceneGroup::of(scene);
        let title = |scene| group(scene).title();
        self.matching(list, library().iter(), PaletteRow::Scene, group, title)
    }

    /// The layers that the list of layers shows, those of the plot in use first.
    pub fn layer_rows(&self, list: &List) -> Vec<&'static LayerSpec> {
        let in_use = self.view_in_use();
        let order = |row: &LayerSpec| (row.view != in_use, row.view);
        let title = |row: &LayerSpec| row.view.spec().title;
        self.matching(list, LAYERS.iter(), PaletteRow::Layer, order, title)
    }

    /// The views that the picker lists.
    pub fn view_rows(&self, list: &List) -> Vec<&'static ViewSpec> {
        self.matching(list, VIEWS.iter(), PaletteRow::View, |_| (), |_| "")
    }

    /// The view of the plot in use.
    pub fn view_in_use(&self) -> View {
        self.plots[self.plot].view
    }

    /// The rows of a list; `None` for each that cannot be run.
    pub(crate) fn rows_of(&self, kind: ListKind, list: &List) -> Vec<Option<PaletteRow>> {
        let rows: Vec<PaletteRow> = match kind {
            ListKind::Scenes => self.scene_rows(list).into_iter().map(PaletteRow::Scene).collect(),
            ListKind::Layers => self.layer_rows(list).into_iter().map(PaletteRow::Layer).collect(),
            ListKind::Views => self.view_rows(list).into_iter().map(PaletteRow::View).collect(),
            ListKind::Paper => {
                self.claim_rows(list).into_iter().map(|row| PaletteRow::Claim(row.0)).collect()
            }
            ListKind::Palette => self.palette_rows(list),
            ListKind::Cost => return vec![None; self.cost_rows(list).len()],
            ListKind::Interrupted => return vec![None; self.interrupted_rows(list).len()],
        };
        rows.into_iter().map(Some).collect()
    }

    /// The heading under which a row stands.
    pub fn heading(&self, row: PaletteRow) -> &'static str {
        self.place_of(row).map_or(row.texts()[3], |place| place.spec().title)
    }

    /// The distance of a row's context from the pane in focus.
    fn distance(&self, row: PaletteRow) -> usize {
        let Some(place) = self.place_of(row) else { return usize::MAX };
        let all = CONTEXTS.iter().map(|row| &row.context);
        let mut nearest = self.contexts_below().iter().chain(all);
        nearest.position(|context| *context == place).unwrap_or(usize::MAX)
    }

    /// The context in which keys run a row: that of the pane in focus if it has keys there.
    pub fn place_of(&self, row: PaletteRow) -> Option<Context> {
        let PaletteRow::Command(command) = row else { return None };
        let mut here = self.contexts_below().iter().copied();
        let has_keys = |context: &Context| command.contexts().any(|at| at == *context);
        here.find(has_keys).or(home(command))
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

/// The first context outside of lists and lines in which a command has default keys; commands that switch
/// layers have none.
fn home(command: &Command) -> Option<Context> {
    let with_keys = command.keys.iter().filter(|(_, keys)| !keys.is_empty());
    with_keys.map(|(context, _)| *context).find(|context| !context.is_overlay())
}

impl Session {
    /// The claims that the page of the paper lists, each with the result of its examination, if known.
    pub fn claim_rows(&self, list: &List) -> Vec<(&'static Claim, Option<&ClaimResult>)> {
        let examined = self.examined();
        let row = |(index, claim): (usize, &'static Claim)| {
            let examined = examined.get(index);
            let verdict = examined.and_then(ClaimResult::verdict).map_or("", Verdict::name);
            let words = [claim.equation, claim.section, claim.statement, verdict];
            list.matches(&words).then_some((claim, examined))
        };
        claims().enumerate().filter_map(row).collect()
    }

    /// The interrupted sessions that their list shows, each with its index among all.
    pub fn interrupted_rows(&self, list: &List) -> Vec<(usize, &KeptSession)> {
        let all = self.interrupted.iter().enumerate();
        all.filter(|(_, kept)| list.matches(&[&kept.when, &kept.what])).collect()
    }
}

/// Synonyms for names of commands, lines, scenes, views and layers.
pub static SYNONYMS: LazyLock<BTreeMap<&str, Vec<&str>>> = LazyLock::new(|| {
    let lines = include_str!("../../../assets/synonyms.txt").lines();
    let rows = lines.filter_map(|line| line.split_once(": "));
    rows.map(|(name, words)| (name, words.split(", ").collect())).collect()
});

/// The rank of a row in a search, by its names and its meaning; 0 is best. Rows whose name is the searched text
/// come first, then those with words that begin with it, names before meanings. Without a search, all rows have
/// the same rank.
pub fn rank(search: &str, names: &[&str], meaning: &str) -> usize {
    let names: Vec<String> = names.iter().map(|name| plain(name)).collect();
    let (search, meaning) = (plain(search), plain(meaning));
    // Without blanks: `fig 16` is `fig16`.
    let joined = |text: &str| text.replace(' ', "");
    let any = |test: &dyn Fn(&String) -> bool| names.iter().any(test);
    let ranks = [
        any(&|name| joined(name) == joined(&search)),
        any(&|name| joined(name).starts_with(&joined(&search))),
        any(&|name| name.contains(&search)),
        meaning.contains(&search),
        any(&|name| name.contains(search.trim())),
        meaning.contains(search.trim()),
    ];
    ranks.iter().position(|holds| *holds).unwrap_or(ranks.len())
}

/// A text in lower case, with a blank before each word of letters and digits.
fn plain(text: &str) -> String {
    let words = text.split(|char: char| !char.is_alphanumeric()).filter(|word| !word.is_empty());
    words.flat_map(|word| [" ".to_owned(), word.to_lowercase()]).collect()
}
