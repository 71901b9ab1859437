//! Undo and redo of all changes of parameters and plots, and of opening or resetting a scene; and marks, points of
//! the parameters to come back to.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use strum::IntoStaticStr;

use crate::flow::Problem;
use crate::scan::LevelTarget;
use crate::scene::{Arrangement, Layer, MOST_PLOTS, PlotSetup, Scene, find};
use crate::session::{Done, Setup, StepSizes};

/// The state before a change, limited to what the change affects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", from = "SavedEarlierState")]
pub enum EarlierState {
    /// A number was changed. Undoing that leaves zoom and layers alone.
    #[serde(rename = "motions")]
    Setup(Box<Setup>),
    /// The present state was exchanged with the pinned one.
    Swap(Box<Setup>),
    /// A plot was added, removed or moved, or its view was changed.
    #[serde(rename = "plots")]
    ScreenSetup(ScreenSetup),
    /// A scene was opened or reset, which sets everything that a scene determines.
    Scene { plots: Vec<PlotSetup>, show: Box<Snapshot> },
}

impl EarlierState {
    /// Fails with one line that names the first number that is not within its range.
    pub(crate) fn check(&self) -> Done {
        match self {
            EarlierState::Setup(setup) | EarlierState::Swap(setup) => setup.check(),
            EarlierState::ScreenSetup(screen_setup) => check_number(&screen_setup.plots),
            EarlierState::Scene { plots, show } => check_number(plots).and_then(|()| show.check()),
        }
    }
}

/// The same as this and earlier versions wrote it.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SavedEarlierState {
    /// A motion alone, without a machine and known exactly: earlier versions wrote that.
    Motion(Problem),
    #[serde(alias = "motion-on-belt")]
    Motions(Box<Setup>),
    Swap(Box<Setup>),
    Plots(ScreenSetup),
    Scene {
        plots: Vec<PlotSetup>,
        show: Box<Snapshot>,
    },
}

impl From<SavedEarlierState> for EarlierState {
    fn from(saved: SavedEarlierState) -> Self {
        match saved {
            SavedEarlierState::Motion(problem) => EarlierState::Setup(Setup::alone(problem).into()),
            SavedEarlierState::Motions(setup) => EarlierState::Setup(setup),
            SavedEarlierState::Swap(setup) => EarlierState::Swap(setup),
            SavedEarlierState::Plots(screen_setup) => EarlierState::ScreenSetup(screen_setup),
            SavedEarlierState::Scene { plots, show } => EarlierState::Scene { plots, show },
        }
    }
}

/// Fails with one line if a screen cannot have so many plots.
pub(crate) fn check_number<P>(plots: &[P]) -> Done {
    match plots.len() {
        1..=MOST_PLOTS => Ok(()),
        count => Err(format!("{count} plots; there can be 1 to {MOST_PLOTS}")),
    }
}

/// Everything that a scene determines but its plots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    #[serde(serialize_with = "by_name", deserialize_with = "named_or_whole")]
    pub scene: Arc<Scene>,
    /// The motion and the speed of its belt.
    #[serde(flatten)]
    pub setup: Setup,
    pub steps: StepSizes,
    pub layers: BTreeSet<Layer>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<LevelTarget>,
    /// How the plots share the screen.
    pub arrangement: Arrangement,
}

impl Snapshot {
    /// Fails with one line that names the first number that is not within its range.
    pub(crate) fn check(&self) -> Done {
        Setup::alone(self.scene.problem).check()?;
        check_number(&self.scene.plots)?;
        self.setup.check()
    }
}

/// The plots, and how they share the screen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScreenSetup {
    /// How they share the screen.
    pub arrangement: Arrangement,
    pub plots: Vec<PlotSetup>,
}

/// A scene, by its name if it is built in, otherwise in full.
#[derive(Deserialize)]
#[serde(untagged)]
enum SavedScene {
    Library(String),
    Full(Box<Scene>),
}

fn by_name<S: Serializer>(scene: &Arc<Scene>, serializer: S) -> Result<S::Ok, S::Error> {
    match find(&scene.name) {
        Ok(known) if known == *scene => scene.name.serialize(serializer),
        _ => scene.serialize(serializer),
    }
}

fn named_or_whole<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<Scene>, D::Error> {
    match SavedScene::deserialize(deserializer)? {
        SavedScene::Library(name) => find(&name).map_err(D::Error::custom),
        SavedScene::Full(scene) => Ok(Arc::from(scene)),
    }
}

/// The past and, after an undo, the future; the most recent change last in each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    pub past: Vec<EarlierState>,
    pub future: Vec<EarlierState>,
}

impl History {
    /// Forgets which windows were fitted in stored states: one that was not is fitted when it comes back.
    #[cfg(test)]
    pub fn forget_windows(&mut self) {
        for before in self.past.iter_mut().chain(&mut self.future) {
            let plots = match before {
                EarlierState::Setup(_) | EarlierState::Swap(_) => continue,
                EarlierState::ScreenSetup(screen_setup) => &mut screen_setup.plots,
                EarlierState::Scene { plots, .. } => plots,
            };
            for plot in plots {
                plot.window = None;
            }
        }
    }

    /// Records the state before a change. Changes that were undone can no longer be redone.
    pub fn record(&mut self, before: EarlierState) {
        self.past.push(before);
        self.future.clear();
    }

    /// Merges the changes recorded since the past had this depth into one, if all of them are of numbers.
    pub fn merge(&mut self, depth: usize) {
        let is_of_numbers = |before: &EarlierState| matches!(before, EarlierState::Setup(_));
        if self.past.get(depth..).is_some_and(|since| since.iter().all(is_of_numbers)) {
            self.past.truncate(depth + 1);
        }
    }

    /// Number of changes that can be undone, and that can be redone.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}

/// Points of the parameters to come back to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bookmarks {
    pub places: BTreeMap<char, Setup>,
    /// The other point of a comparison: the one that is pinned, otherwise the one that was left last for a mark.
    pub left: Option<Setup>,
    /// What the pinned point is called; `None` where none is pinned.
    pub pinned: Option<Letter>,
}

/// The names of the two points of a comparison: the one that is pinned begins as A.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
pub enum Letter {
    #[default]
    A,
    B,
}

impl Letter {
    /// The name of the other point.
    pub fn other(self) -> Self {
        if self == Self::A { Self::B } else { Self::A }
    }
}
