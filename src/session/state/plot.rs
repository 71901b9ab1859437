//! Plots: the parts of the screen that show a view each, and what part of the view is shown.

use serde::{Deserialize, Serialize};

use crate::scene::{Axes, PlotSetup, Point, View, Window};

/// A part of the screen that can have the focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pane {
    /// The list of parameters, method and tolerance.
    Parameters,
    /// A plot, by its index among `Session::plots`.
    Plot(usize),
}

/// Who chose a plot's window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    Scene,
    /// It was fitted to what is on show.
    Fitted,
    /// It will be fitted as soon as what is on show is computed.
    Fitting,
    /// The user, by zooming and panning.
    User,
}

/// A plot: what it shows, its window and its cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
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
}

impl Plot {
    /// A plot as a scene sets it up.
    pub fn opened(plot_setup: &PlotSetup) -> Self {
        Plot {
            view: plot_setup.view,
            axes: plot_setup.axes,
            family: plot_setup.family,
            window: plot_setup.opening(),
            framing: if plot_setup.window.is_some() { Framing::Scene } else { Framing::Fitting },
            cursor: None,
        }
    }

    /// Waits to be fitted, from this window.
    pub fn fit_from(&mut self, window: Window) {
        (self.window, self.framing, self.cursor) = (window, Framing::Fitting, None);
    }
}
