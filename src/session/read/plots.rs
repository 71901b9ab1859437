//! The content of the plots, and which of them are on show.

use crate::scene::{Layer, Needs, PlotSetup, View};
use crate::session::state::{Framing, Pane, Plot, ScreenSetup, Session};

impl Session {
    /// Whether a plot draws circles round.
    pub fn has_equal_units(&self, plot: usize) -> bool {
        self.plots[plot].view == View::Phase && !self.display.stretched
    }

    /// The indices of the plots on show.
    pub fn on_show(&self) -> std::ops::Range<usize> {
        if self.enlarged { self.plot..self.plot + 1 } else { 0..self.plots.len() }
    }

    /// The panes on show, in the order in which they get the focus.
    pub fn panes(&self) -> Vec<Pane> {
        std::iter::once(Pane::Parameters).chain(self.on_show().map(Pane::Plot)).collect()
    }

    pub fn focused(&self) -> Option<&Plot> {
        match self.focus {
            Pane::Parameters => None,
            Pane::Plot(index) => self.plots.get(index),
        }
    }

    /// The plot in focus, mutable.
    pub fn focused_mut(&mut self) -> Option<&mut Plot> {
        match self.focus {
            Pane::Parameters => None,
            Pane::Plot(index) => self.plots.get_mut(index),
        }
    }

    /// Whether a layer is on and a plot on show has its view.
    pub fn shows(&self, layer: Layer) -> bool {
        self.on_show().any(|index| self.shows_in(layer, index))
    }

    /// Whether a layer is on and belongs to the view of a plot.
    pub fn shows_in(&self, layer: Layer, plot: usize) -> bool {
        let view = layer.spec().view;
        self.layers.contains(&layer) && self.plots.get(plot).is_some_and(|plot| plot.view == view)
    }

    /// What a view lacks to show anything and which key gives it, by the names of commands; `None` where it
    /// lacks nothing.
    pub fn lacks(&self, view: View) -> Option<&'static str> {
        let needs = view.spec().needs;
        let there = match needs {
            Needs::Oscillator => true,
            Needs::Machine => self.scene.machine.is_some(),
            Needs::Record => self.scene.recording.is_some(),
            Needs::Scan => self.scanned.is_some(),
        };
        (!there).then(|| needs.sentence())
    }

    /// What is said in place of a picture in which nothing is drawn; `None` while it may still come.
    pub fn nothing(&self, index: usize) -> Option<String> {
        let view = self.plots[index].view;
        if let Some(lacks) = self.lacks(view) {
            return Some(lacks.to_owned());
        }
        let asked = self.asked_by(index);
        if let Some(why) = asked.iter().find_map(|request| self.answers.failure(request)) {
            return Some(format!("no answer: {why}; {{retry}} tries again"));
        }
        if asked.iter().any(|request| self.is_open(request)) {
            return None;
        }
        let shows = |layer: &Layer| self.shows_in(*layer, index);
        let on = view == View::Scan || self.layers.iter().any(shows);
        let text = if on { view.spec().nothing } else { "no layer is on: {layers} lists them" };
        Some(text.to_owned())
    }

    /// Why a layer that is on draws nothing, if the reason lies in the axes of every diagram on show or in a
    /// missing mark.
    pub fn not_drawn(&self, layer: Layer) -> Option<&'static str> {
        if layer == Layer::Ghost {
            return self.marks.left.is_none().then_some("not drawn: no mark has been visited yet");
        }
        if matches!(layer, Layer::Record | Layer::Recorded) {
            return self.scene.recording.is_none().then_some("not drawn: no record is open");
        }
        if matches!(layer, Layer::Belt | Layer::BeltPath | Layer::Whole) {
            return self.scene.machine.is_none().then_some("not drawn: the scene has no machine");
        }
        let harmonic = matches!(layer, Layer::Harmonic | Layer::Asymptotes);
        let drawn = |index: usize| {
            self.shows_in(layer, index) && self.plots[index].axes.ordinate.spec().harmonic.is_some()
        };
        (harmonic && self.shows(layer) && !self.on_show().any(drawn))
            .then_some("not drawn: the harmonic answer has no multiplier")
    }

    /// The scene's setup of a plot with this view: the one at the same place, otherwise the first one with that
    /// view.
    pub fn plot_of_scene(&self, plot: usize, view: View) -> Option<PlotSetup> {
        let plots = &self.scene.plots;
        let here = plots.get(plot).filter(|plot_setup| plot_setup.view == view);
        here.or(plots.iter().find(|plot_setup| plot_setup.view == view)).copied()
    }

    /// The present setup of a plot.
    pub fn plot_setup(&self, index: usize) -> Option<PlotSetup> {
        let plot = self.plots.get(index)?;
        let of_scene = self.plot_of_scene(index, plot.view);
        let window = match plot.framing {
            Framing::Scene => of_scene.and_then(|plot_setup| plot_setup.window),
            Framing::Fitting => None,
            Framing::Fitted | Framing::User => Some(plot.window),
        };
        Some(PlotSetup { view: plot.view, axes: plot.axes, window, family: plot.family })
    }

    /// The present setup of all plots.
    pub(in crate::session) fn screen_setup(&self) -> ScreenSetup {
        let plot_setups = (0..self.plots.len()).filter_map(|index| self.plot_setup(index));
        ScreenSetup { plots: plot_setups.collect(), arrangement: self.arrangement }
    }
}
