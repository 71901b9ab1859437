//! Plots: the parts of the screen that show a view each, and what one looks at in them.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::state::Session;
use crate::scene::{Answered, Axes, Exhibit, Layer, Point, Slot, View, Window};

/// A part of the screen that can have the focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pane {
    /// The list of parameters, method and tolerance.
    Parameters,
    /// A plot, by its index among [`Session::plots`].
    Plot(usize),
}

/// Who chose a plot's window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    /// The scene.
    Scene,
    /// It was fitted to what is on show.
    Fitted,
    /// It will be fitted as soon as what is on show is computed.
    Fitting,
    /// The user, by zooming and panning.
    User,
}

/// A plot: what it shows, where one looks, and what one points at.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// What it shows.
    pub view: View,
    /// Over which axes, where the view leaves a choice.
    pub axes: Axes,
    /// Which family of the scene's stands in for the present values, if one does.
    pub family: Option<usize>,
    /// What part of the world is on show.
    pub window: Window,
    /// Who chose the window.
    pub framing: Framing,
    /// The cursor, in world coordinates.
    pub cursor: Option<Point>,
    /// The last good answers to the questions that are this plot's own.
    pub answers: BTreeMap<Slot, Arc<Answered>>,
}

impl Plot {
    /// A plot as a scene sets it up.
    #[must_use]
    pub fn opened(exhibit: &Exhibit) -> Self {
        Plot {
            view: exhibit.view,
            axes: exhibit.axes,
            family: exhibit.family,
            window: exhibit.opening(),
            framing: if exhibit.window.is_some() { Framing::Scene } else { Framing::Fitting },
            cursor: None,
            answers: BTreeMap::new(),
        }
    }

    /// Shows something else; what was answered is kept for when it is asked for again.
    pub fn show(&mut self, exhibit: &Exhibit) {
        let answers = std::mem::take(&mut self.answers);
        *self = Plot { answers, ..Plot::opened(exhibit) };
    }

    /// Waits to be fitted, from this window.
    pub fn fit_from(&mut self, window: Window) {
        (self.window, self.framing, self.cursor) = (window, Framing::Fitting, None);
    }
}

impl Session {
    /// The indices of the plots on show.
    #[must_use]
    pub fn on_show(&self) -> std::ops::Range<usize> {
        if self.enlarged { self.plot..self.plot + 1 } else { 0..self.plots.len() }
    }

    /// The panes on show, in the order in which the focus visits them.
    #[must_use]
    pub fn panes(&self) -> Vec<Pane> {
        std::iter::once(Pane::Parameters).chain(self.on_show().map(Pane::Plot)).collect()
    }

    /// The plot in focus.
    #[must_use]
    pub fn focused(&self) -> Option<&Plot> {
        match self.focus {
            Pane::Parameters => None,
            Pane::Plot(index) => self.plots.get(index),
        }
    }

    /// The plot in focus, to be changed.
    pub fn focused_mut(&mut self) -> Option<&mut Plot> {
        match self.focus {
            Pane::Parameters => None,
            Pane::Plot(index) => self.plots.get_mut(index),
        }
    }

    /// Whether a layer is on and a plot on show has its view.
    #[must_use]
    pub fn shows(&self, layer: Layer) -> bool {
        self.on_show().any(|index| self.shows_in(layer, index))
    }

    /// Whether a layer is on and belongs to the view of a plot.
    #[must_use]
    pub fn shows_in(&self, layer: Layer, plot: usize) -> bool {
        let view = layer.spec().view;
        self.layers.contains(&layer) && self.plots.get(plot).is_some_and(|plot| plot.view == view)
    }

    /// Why a layer that is on shows nothing, where that lies in the axes of every diagram on show.
    #[must_use]
    pub fn not_drawn(&self, layer: Layer) -> Option<&'static str> {
        if layer == Layer::Ghost {
            return self.marks.left.is_none().then_some("not drawn: no mark has been gone to yet");
        }
        if matches!(layer, Layer::Belt | Layer::BeltPath) {
            return self.scene.machine.is_none().then_some("not drawn: the scene is of no machine");
        }
        let harmonic = matches!(layer, Layer::Harmonic | Layer::Asymptotes);
        let drawn = |index: usize| {
            self.shows_in(layer, index) && self.plots[index].axes.ordinate.spec().harmonic.is_some()
        };
        (harmonic && self.shows(layer) && !self.on_show().any(drawn))
            .then_some("not drawn: the harmonic answer has no multiplier")
    }

    /// What the scene shows in a plot: what it has at that place, else what it shows of that view
    /// anywhere.
    #[must_use]
    pub fn exhibit_of_scene(&self, plot: usize, view: View) -> Option<Exhibit> {
        let plots = &self.scene.plots;
        let here = plots.get(plot).filter(|exhibit| exhibit.view == view);
        here.or(plots.iter().find(|exhibit| exhibit.view == view)).copied()
    }

    /// What a plot shows, so that it can be set up again.
    #[must_use]
    pub fn exhibit(&self, index: usize) -> Option<Exhibit> {
        let plot = self.plots.get(index)?;
        let of_scene = self.exhibit_of_scene(index, plot.view);
        let window = match plot.framing {
            Framing::Scene => of_scene.and_then(|exhibit| exhibit.window),
            Framing::Fitting => None,
            Framing::Fitted | Framing::User => Some(plot.window),
        };
        Some(Exhibit { view: plot.view, axes: plot.axes, window, family: plot.family })
    }
}
