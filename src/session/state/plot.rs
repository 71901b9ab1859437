//! Plots: parts of the screen that show a window of a view each.

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

/// How a plot's window was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    Scene,
    /// Fitted to what is on show.
    Fitted,
    /// To be fitted as soon as what is on show is computed.
    Fitting,
    /// By the user, by zooming and panning.
    User,
}

/// A plot: its view, its window and its cursor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    pub view: View,
    /// Its axes, where the view leaves a choice.
    pub axes: Axes,
    /// The family of variants, by its index in the scene, that the plot shows in place of the present values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
    /// The part of the world on show.
    pub window: Window,
    /// How the window was chosen.
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

    /// Marks the plot as to be fitted, beginning from this window.
    pub fn fit_from(&mut self, window: Window) {
        (self.window, self.framing, self.cursor) = (window, Framing::Fitting, None);
    }
}
