//! The rows of the lists over the panes.

use std::sync::Arc;

use crate::paper::{Claim, ClaimResult, Verdict, claims};
use crate::scene::library::SceneGroup;
use crate::scene::{LAYERS, LayerSpec, Scene, VIEWS, View, ViewSpec, library};
use crate::session::read::search;
use crate::session::state::{Kept, List, Listed, Overlay, Session};

impl List {
    /// The rank of a row with these names and this meaning: the best matches for the search come first.
    fn rank(&self, names: &[impl AsRef<str>], meaning: &str) -> usize {
        let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        if self.search.is_empty() { 0 } else { search::rank(&self.search, &names, meaning) }
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
    pub(in crate::session) fn list_length(&self) -> usize {
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

    pub(in crate::session) fn list_mut(&mut self) -> Option<&mut List> {
        self.overlay.as_mut().and_then(Overlay::list_mut)
    }
}
