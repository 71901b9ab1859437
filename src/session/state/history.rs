//! Undo and redo of every change of a parameter, and of opening or resetting a scene, and
//! of what the plots show.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::scene::{Arrangement, Layer, PlotSetup, Scene};
use crate::session::state::rows::Steps;
use crate::session::state::setup::Setup;

/// The state before a change, as far as the change reached.
#[derive(Clone, Debug, PartialEq)]
pub enum Before {
    /// A number was changed. Undoing it leaves zoom and layers alone.
    Setup(Box<Setup>),
    /// A plot was added, removed or moved, or shows another view.
    ScreenSetup(ScreenSetup),
    /// A scene was opened or reset, and everything that a scene sets with it.
    Scene(Box<Snapshot>),
}

/// Everything that a scene sets.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    pub scene: Arc<Scene>,
    /// The motion, and the speed of its belt.
    pub setup: Setup,
    pub steps: Steps,
    pub layers: BTreeSet<Layer>,
    /// Plots and their arrangement.
    pub screen_setup: ScreenSetup,
}

/// What is on show, and how it shares the screen.
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
    /// Forgets which windows were fitted when they were left: one that was not is fitted when it comes back.
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

    /// Notes the state before a change. What had been undone can no longer be redone.
    pub fn record(&mut self, before: Before) {
        self.past.push(before);
        self.future.clear();
    }

    /// Makes one change of those since the past was so deep, if all of them are of a kind.
    pub fn merge(&mut self, depth: usize, is_of_kind: impl Fn(&Before) -> bool) {
        if self.past.get(depth..).is_some_and(|since| since.iter().all(is_of_kind)) {
            self.past.truncate(depth + 1);
        }
    }

    /// Makes one change of all those since the past was so deep, before which things stood like this.
    pub fn merge_all(&mut self, depth: usize, before: Box<Snapshot>) {
        self.merge(depth, |before| matches!(before, Before::Setup(_)));
        if self.past.len() > depth + 1 {
            self.past.truncate(depth);
            self.past.push(Before::Scene(before));
        }
    }

    /// The state before the last change. `present` tells the present state to the same extent, for redo.
    pub fn undo(&mut self, present: impl FnOnce(&Before) -> Before) -> Option<Before> {
        let before = self.past.pop()?;
        self.future.push(present(&before));
        Some(before)
    }

    /// The state that was last undone. `present` tells the present state to the same extent, for undo.
    pub fn redo(&mut self, present: impl FnOnce(&Before) -> Before) -> Option<Before> {
        let after = self.future.pop()?;
        self.past.push(present(&after));
        Some(after)
    }

    /// A past and a future, the newest change last in each.
    pub fn of(past: Vec<Before>, future: Vec<Before>) -> Self {
        History { past, future }
    }

    /// The past and the future, the newest change last in each.
    pub fn parts(&self) -> (&[Before], &[Before]) {
        (&self.past, &self.future)
    }

    /// How many changes can be undone, and how many redone.
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}
