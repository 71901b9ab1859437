//! Undo and redo of all changes of parameters and plots, and of opening or resetting a scene.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::scene::{Arrangement, Layer, PlotSetup, Scene};
use crate::session::state::rows::StepSizes;
use crate::session::state::setup::Setup;

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
#[derive(Clone, Debug, PartialEq)]
pub struct ScreenSetup {
    pub plots: Vec<PlotSetup>,
    /// How they share the screen.
    pub arrangement: Arrangement,
}

/// The past and, after an undo, the future.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    past: Vec<Before>,
    future: Vec<Before>,
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

    /// The state before the last change. For redo, `present` returns the present state to the same extent.
    pub fn undo(&mut self, present: impl FnOnce(&Before) -> Before) -> Option<Before> {
        let before = self.past.pop()?;
        self.future.push(present(&before));
        Some(before)
    }

    /// The state that was undone last. For undo, `present` returns the present state to the same extent.
    pub fn redo(&mut self, present: impl FnOnce(&Before) -> Before) -> Option<Before> {
        let after = self.future.pop()?;
        self.past.push(present(&after));
        Some(after)
    }

    /// A history from its past and its future, the most recent change last in each.
    pub fn of(past: Vec<Before>, future: Vec<Before>) -> Self {
        History { past, future }
    }

    /// The past and the future, the most recent change last in each.
    pub fn parts(&self) -> (&[Before], &[Before]) {
        (&self.past, &self.future)
    }

    /// Number of changes that can be undone, and that can be redone.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}
