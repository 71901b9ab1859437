//! Undo and redo of every change of a parameter, and of opening another scene.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::state::Steps;
use crate::flow::Problem;
use crate::oscillator::Symbol;
use crate::scene::{Layer, Scene, Window};

/// What undo brings back.
///
/// The scene, its windows and its layers come back only where the scene differs: undoing a step of D
/// leaves the zoom alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// The scene.
    pub scene: Arc<Scene>,
    /// Step sizes.
    pub steps: Steps,
    /// Layers that are on.
    pub layers: BTreeSet<Layer>,
    /// Window of the phase plane.
    pub phase: Window,
    /// Window of the diagram.
    pub diagram: Window,
    /// Parameter along the diagram's horizontal axis.
    pub abscissa: Symbol,
}

/// The past and, after an undo, the future.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    past: Vec<Snapshot>,
    future: Vec<Snapshot>,
}

impl History {
    /// Notes the state before a change. What had been undone can no longer be redone.
    pub fn record(&mut self, before: Snapshot) {
        self.past.push(before);
        self.future.clear();
    }

    /// Exchanges the present for the state before the last change.
    pub fn undo(&mut self, present: impl FnOnce() -> Snapshot) -> Option<Snapshot> {
        let before = self.past.pop()?;
        self.future.push(present());
        Some(before)
    }

    /// Exchanges the present for the state that was last undone.
    pub fn redo(&mut self, present: impl FnOnce() -> Snapshot) -> Option<Snapshot> {
        let after = self.future.pop()?;
        self.past.push(present());
        Some(after)
    }

    /// How many changes can be undone, and how many redone.
    #[must_use]
    pub fn depth(&self) -> (usize, usize) {
        (self.past.len(), self.future.len())
    }
}
