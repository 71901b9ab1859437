//! Undo and redo of all changes of parameters and plots, and of opening or resetting a scene; and marks, points of
//! the parameters to come back to.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::scene::{Arrangement, Layer, PlotSetup, Request, Scene};
use crate::session::{Setup, StepSizes};

/// The state before a change, limited to what the change affects.
#[derive(Clone, Debug, PartialEq)]
pub enum Before {
    /// A number was changed. Undoing that leaves zoom and layers alone.
    Setup(Box<Setup>),
    /// A plot was added, removed or moved, or its view was changed.
    ScreenSetup(ScreenSetup),
    /// A scene was opened or reset, which sets everything that a scene determines.
    Scene(Box<Snapshot>),
}

/// Everything that a scene determines.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    pub scene: Arc<Scene>,
    /// The motion and the speed of its belt.
    pub setup: Setup,
    pub steps: StepSizes,
    pub layers: BTreeSet<Layer>,
    /// Plots and their arrangement.
    pub screen_setup: ScreenSetup,
}

/// The plots, and how they share the screen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScreenSetup {
    /// How they share the screen.
    pub arrangement: Arrangement,
    pub plots: Vec<PlotSetup>,
}

/// The past and, after an undo, the future; the most recent change last in each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    pub past: Vec<Before>,
    pub future: Vec<Before>,
}

impl History {
    /// Forgets which windows were fitted in stored states: one that was not is fitted when it comes back.
    #[cfg(test)]
    pub fn forget_windows(&mut self) {
        for before in self.past.iter_mut().chain(&mut self.future) {
            let screen_setup = match before {
                Before::Setup(_) => continue,
                Before::ScreenSetup(screen_setup) => screen_setup,
                Before::Scene(snapshot) => &mut snapshot.screen_setup,
            };
            screen_setup.plots.iter_mut().for_each(|plot| plot.window = None);
        }
    }

    /// Records the state before a change. Changes that were undone can no longer be redone.
    pub fn record(&mut self, before: Before) {
        self.past.push(before);
        self.future.clear();
    }

    /// Merges the changes recorded since the past had this depth into one, if all of them are of numbers.
    pub fn merge(&mut self, depth: usize) {
        let is_of_numbers = |before: &Before| matches!(before, Before::Setup(_));
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
    pub places: BTreeMap<char, Bookmark>,
    /// The point that was left last, for comparison.
    pub left: Option<Bookmark>,
}

/// A point of the parameters, and what is drawn of it beside the present one.
#[derive(Clone, Debug, PartialEq)]
pub struct Bookmark {
    /// The motion and the speed of its belt.
    pub setup: Setup,
    /// The questions for its motion and its cycles; empty until the point was on show.
    pub asked: Vec<Request>,
}
