//! The rows of the lists over the panes, and the search in them: synonyms, and the order of the rows found.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use crate::paper::{Claim, ClaimResult, Verdict, claims};
use crate::scene::library::SceneGroup;
use crate::scene::{LAYERS, LayerSpec, Scene, VIEWS, View, ViewSpec, library};
use crate::session::{Kept, List, Listed, Overlay, Session};

impl List {
    /// The rank of a row with these names and this meaning: the best matches for the search come first.
    fn rank(&self, names: &[impl AsRef<str>], meaning: &str) -> usize {
        let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        if self.search.is_empty() { 0 } else { rank(&self.search, &names, meaning) }
    }
}

impl Session {
    /// The scenes that the picker lists, in groups.
    pub fn scene_rows(&self, list: &List) -> Vec<&'static Arc<Scene>> {
        let found = library().iter().filter(|scene| {
            let also = scene.also.as_deref().unwrap_or_default();
            list.matches(&[scene.name.as_str(), also, &scene.title])
        });
        let mut rows: Vec<_> = found.collect();
        let names = |scene: &Scene| [scene.name.clone(), scene.also.clone().unwrap_or_default()];
        rows.sort_by_cached_key(|scene| {
            (list.rank(&names(scene), &scene.title), SceneGroup::of(scene))
        });
        rows
    }

    /// The layers that the list of layers shows, those of the plot in use first.
    pub fn layer_rows(&self, list: &List) -> Vec<&'static LayerSpec> {
        let found = LAYERS.iter().filter(|row| list.matches(&[row.name, row.meaning]));
        let mut rows: Vec<_> = found.collect();
        rows.sort_by_key(|row| {
            (list.rank(&[row.name], row.meaning), row.view != self.view_in_use(), row.view)
        });
        rows
    }

    /// The view of the plot in use.
    pub fn view_in_use(&self) -> View {
        self.plots[self.plot].view
    }

    /// The views that the picker lists.
    pub fn view_rows(&self, list: &List) -> Vec<&'static ViewSpec> {
        let found = VIEWS.iter().filter(|row| list.matches(&[row.name, row.title, row.meaning]));
        let mut rows: Vec<_> = found.collect();
        rows.sort_by_key(|row| list.rank(&[row.name, row.title], row.meaning));
        rows
    }

    /// The claims that the page of the paper lists, each with the result of its examination, if known.
    pub fn claim_rows(&self, list: &List) -> Vec<(&'static Claim, Option<&ClaimResult>)> {
        let examined = self.examined();
        let rows = claims().enumerate().map(|(index, claim)| (claim, examined.get(index)));
        let matches = |(claim, examined): &(&'static Claim, Option<&ClaimResult>)| {
            let verdict = examined.and_then(ClaimResult::verdict).map_or("", Verdict::name);
            list.matches(&[claim.equation, claim.section, claim.statement, verdict])
        };
        rows.filter(matches).collect()
    }

    /// The interrupted sessions that their list shows, each with its index among all.
    pub fn interrupted_rows(&self, list: &List) -> Vec<(usize, &Kept)> {
        let all = self.interrupted.iter().enumerate();
        all.filter(|(_, kept)| list.matches(&[&kept.when, &kept.what])).collect()
    }

    /// Number of rows of the open list.
    pub(crate) fn list_length(&self) -> usize {
        let Some(Overlay::List(listed, list)) = &self.overlay else { return 0 };
        match listed {
            Listed::Scenes => self.scene_rows(list).len(),
            Listed::Layers => self.layer_rows(list).len(),
            Listed::Views => self.view_rows(list).len(),
            Listed::Paper => self.claim_rows(list).len(),
            Listed::Palette => self.palette_rows(list).len(),
            Listed::Cost => self.cost_rows(list).len(),
            Listed::Interrupted => self.interrupted_rows(list).len(),
        }
    }

    pub(crate) fn list_mut(&mut self) -> Option<&mut List> {
        self.overlay.as_mut().and_then(Overlay::list_mut)
    }
}

/// Synonyms for names of commands, lines, scenes, views and layers.
pub(crate) static SYNONYMS: LazyLock<BTreeMap<&str, Vec<&str>>> = LazyLock::new(|| {
    let lines = include_str!("../../../assets/synonyms.txt").lines();
    let rows = lines.filter_map(|line| line.split_once(": "));
    rows.map(|(name, words)| (name, words.split(", ").collect())).collect()
});

/// The synonyms for this name.
pub(crate) fn aliases(name: &str) -> &'static [&'static str] {
    SYNONYMS.get(name).map_or(&[], Vec::as_slice)
}

/// The rank of a row in a search, by its names and its meaning; 0 is best. Rows whose name is the searched text
/// come first, then those with words that begin with it, names before meanings. Without a search, all rows have
/// the same rank.
pub(crate) fn rank(search: &str, names: &[&str], meaning: &str) -> usize {
    let search = Plain::new(search);
    let names: Vec<Plain> = names.iter().map(|name| Plain::new(name)).collect();
    let meaning = Plain::new(meaning);
    let any = |test: &dyn Fn(&Plain) -> bool| names.iter().any(test);
    let ranks = [
        any(&|name| name.joined() == search.joined()),
        any(&|name| name.joined().starts_with(&search.joined())),
        any(&|name| name.has_at_a_word(&search)),
        meaning.has_at_a_word(&search),
        any(&|name| name.0.contains(search.0.trim())),
        meaning.0.contains(search.0.trim()),
    ];
    ranks.iter().position(|holds| *holds).unwrap_or(ranks.len())
}

/// A text in lower case, with a blank before each word of letters and digits.
struct Plain(String);

impl Plain {
    fn new(text: &str) -> Self {
        let words = text.split(|char: char| !char.is_alphanumeric());
        let words = words.filter(|word| !word.is_empty());
        Plain(words.flat_map(|word| [" ".to_owned(), word.to_lowercase()]).collect())
    }

    /// The text without blanks: `fig 16` becomes `fig16`.
    fn joined(&self) -> String {
        self.0.replace(' ', "")
    }

    fn has_at_a_word(&self, search: &Plain) -> bool {
        self.0.contains(&search.0)
    }
}
