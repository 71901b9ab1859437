//! Views: what a plot of the screen can show.
//!
//! [`VIEWS`] is the one table of views. A screen has one to [`MOST_PLOTS`] plots; each shows a view, and
//! two plots may show the same one over different axes. Layers belong to a view, not to a plot.

use serde::{Deserialize, Serialize};

use super::ordinate::{Height, Ordinate, Unit, usual_values};
use super::window::{Span, Window};
use crate::oscillator::Symbol;

/// Plots on a screen at most: more would be too small to read.
pub const MOST_PLOTS: usize = 4;

/// What a plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// The phase plane, q to the right and v upwards.
    Phase,
    /// The bifurcation diagram: a property of the cycles over a parameter.
    Diagram,
    /// Displacement, velocity, friction force and energy over time.
    TimeSeries,
    /// The work that each source does over one turn of each cycle, and along the motion.
    EnergyLedger,
    /// The next turning point on the same side over a turning point.
    ReturnMap,
    /// What becomes of kicks, over two parameters.
    Regimes,
    /// The error of every method over its cost.
    Trade,
    /// The mass on its belt.
    Belt,
    /// The rate of the energy over the velocity.
    EnergyRate,
    /// The eigenvalues of the rest without friction in the complex plane.
    Eigenvalues,
    /// The cycles of a machine over the speed of its belt.
    Speeds,
    /// What was measured at each point of a scan.
    Scan,
    /// The loss of amplitude over amplitude, as a record shows it.
    Damping,
    /// What was measured less what was fitted, over time.
    Residuals,
    /// The distribution of the margin that a record leaves.
    #[serde(rename = "margin")]
    Spread,
}

/// One row of [`VIEWS`].
#[derive(Clone, Copy, Debug)]
pub struct ViewSpec {
    pub view: View,
    /// Its name in scene files.
    pub name: &'static str,
    /// Its name on the screen.
    pub title: &'static str,
    /// A heading for its keys.
    pub heading: &'static str,
    /// What it shows, in a few words.
    pub meaning: &'static str,
    /// What is looked at where nothing else is asked for.
    pub window: Window,
}

/// Every view, in the order in which they are listed and the keys visit them.
pub const VIEWS: [ViewSpec; 15] = [
    ViewSpec {
        view: View::Phase,
        name: "phase",
        title: "phase plane",
        heading: "Phase plane",
        meaning: "velocity over position: where motions go and where they rest",
        window: Window { x: Span::known(-2.0, 2.0), y: Span::known(-2.0, 2.0) },
    },
    ViewSpec {
        view: View::Diagram,
        name: "diagram",
        title: "bifurcation",
        heading: "Bifurcation diagram",
        meaning: "a property of the limit cycles over a parameter",
        window: Window { x: Span::known(-0.9, 0.1), y: Span::known(0.0, 2.0) },
    },
    ViewSpec {
        view: View::TimeSeries,
        name: "time-series",
        title: "time series",
        heading: "Time series",
        meaning: "displacement, velocity, friction, energy over time",
        window: Window { x: Span::known(0.0, 60.0), y: Span::known(-2.0, 2.0) },
    },
    ViewSpec {
        view: View::EnergyLedger,
        name: "energy-ledger",
        title: "energy",
        heading: "Energy ledger",
        meaning: "what feeds cycles and motion, and what brakes them",
        window: Window { x: Span::known(-1.1, 1.1), y: Span::known(0.0, 10.0) },
    },
    ViewSpec {
        view: View::ReturnMap,
        name: "return-map",
        title: "return map",
        heading: "Return map",
        meaning: "the next turning point over a turning point",
        window: Window { x: Span::known(0.0, 2.0), y: Span::known(0.0, 2.0) },
    },
    ViewSpec {
        view: View::Regimes,
        name: "regimes",
        title: "regimes",
        heading: "Chart of regimes",
        meaning: "what becomes of kicks, over two parameters",
        window: Window { x: Span::known(-0.9, 0.1), y: Span::known(-1.0, 1.0) },
    },
    ViewSpec {
        view: View::Trade,
        name: "trade",
        title: "trade",
        heading: "Trade of error for cost",
        meaning: "error over cost: what accuracy costs, by every method",
        window: Window { x: Span::known(1.0, 6.0), y: Span::known(-17.0, 1.0) },
    },
    ViewSpec {
        view: View::Belt,
        name: "belt",
        title: "mass on belt",
        heading: "Mass on its belt",
        meaning: "the machine, moving with the motion",
        window: Window { x: Span::known(-2.0, 2.0), y: Span::known(0.0, 1.0) },
    },
    ViewSpec {
        view: View::EnergyRate,
        name: "energy-rate",
        title: "energy rate",
        heading: "Rate of the energy",
        meaning: "V' over velocity: what damping feeds and friction takes",
        window: Window { x: Span::known(-2.0, 2.0), y: Span::known(-2.0, 2.0) },
    },
    ViewSpec {
        view: View::Eigenvalues,
        name: "eigenvalues",
        title: "eigenvalues",
        heading: "Eigenvalues",
        meaning: "of the rest without friction, in the complex plane",
        window: Window { x: Span::known(-1.5, 1.5), y: Span::known(-1.5, 1.5) },
    },
    ViewSpec {
        view: View::Speeds,
        name: "speeds",
        title: "belt speeds",
        heading: "Cycles over the belt's speed",
        meaning: "cycles of the machine over the speed of its belt",
        window: Window { x: Span::known(0.01, 1.0), y: Span::known(0.0, 1.0) },
    },
    ViewSpec {
        view: View::Scan,
        name: "scan",
        title: "scan",
        heading: "Scan",
        meaning: "what was measured at each point of a line or grid",
        window: Window { x: Span::known(0.0, 1.0), y: Span::known(0.0, 1.0) },
    },
    ViewSpec {
        view: View::Damping,
        name: "damping",
        title: "damping",
        heading: "Damping over amplitude",
        meaning: "loss of amplitude of a recorded motion, and its zeros",
        window: Window { x: Span::known(0.0, 1.0), y: Span::known(-1.0, 1.0) },
    },
    ViewSpec {
        view: View::Residuals,
        name: "residuals",
        title: "residuals",
        heading: "Residuals of a fit",
        meaning: "what was measured less what was fitted, over time",
        window: Window { x: Span::known(0.0, 1.0), y: Span::known(-1.0, 1.0) },
    },
    ViewSpec {
        view: View::Spread,
        name: "margin",
        title: "margin",
        heading: "Distribution of the margin",
        meaning: "how sure the margin is that a record leaves",
        window: Window { x: Span::known(0.0, 1.0), y: Span::known(0.0, 1.0) },
    },
];

impl View {
    /// The row of [`VIEWS`] that describes this view.
    pub fn spec(self) -> &'static ViewSpec {
        &VIEWS[self as usize]
    }
}

/// What stands on the axes of a view that leaves a choice; a view that leaves none keeps it for others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axes {
    /// The parameter to the right.
    pub abscissa: Symbol,
    /// The property of the cycles upwards.
    pub ordinate: Ordinate,
    /// What it is measured in, where it is a length.
    #[serde(default)]
    pub unit: Unit,
    /// The parameter upwards, in a chart of two.
    pub against: Symbol,
}

impl Default for Axes {
    /// The axes of the paper's diagrams.
    fn default() -> Self {
        Axes { abscissa: Symbol::D, ordinate: Ordinate::QMax, unit: Unit::One, against: Symbol::D3 }
    }
}

impl Axes {
    /// The name of the ordinate of a diagram.
    pub fn label(&self) -> &'static str {
        let spec = self.ordinate.spec();
        spec.ratio.filter(|_| self.unit == Unit::Friction).unwrap_or(spec.label)
    }

    /// How high things stand in a diagram whose cycles live at this friction.
    pub fn height(&self, friction: f64) -> Height {
        let friction = (self.abscissa != Symbol::R).then_some(friction);
        Height { ordinate: self.ordinate, unit: self.unit, friction }
    }
}

/// A plot as a scene sets it up: what it shows, over which axes, and which part of that.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotSetup {
    pub view: View,
    /// Over which axes, where there is a choice.
    pub axes: Axes,
    /// Which part of it; `None` for a window fitted to what there is to see.
    pub window: Option<Window>,
    /// Which family of the scene's stands in for the present values, if one does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
}

impl PlotSetup {
    /// The window with which the plot opens; where none is given, the one from which fitting begins.
    pub fn opening(&self) -> Window {
        let usual = self.view.spec().window;
        self.window.unwrap_or(match self.view {
            View::Diagram => Window { x: usual_values(self.axes.abscissa), ..usual },
            View::Regimes => {
                let Axes { abscissa, against, .. } = self.axes;
                Window { x: usual_values(abscissa), y: usual_values(against) }
            }
            _ => usual,
        })
    }
}

/// How the plots share the screen.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Arrangement {
    /// As leaves each nearest to a square.
    #[default]
    Auto,
    Columns,
    Rows,
}

/// The arrangements with their names, in the order in which the key visits them.
pub const ARRANGEMENTS: [(Arrangement, &str); 3] =
    [(Arrangement::Auto, "auto"), (Arrangement::Columns, "columns"), (Arrangement::Rows, "rows")];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_stands_at_its_own_row_under_the_name_of_scene_files() {
        for row in &VIEWS {
            assert_eq!(row.view.spec().name, row.name);
            assert_eq!(serde_json::to_value(row.view).unwrap(), row.name);
        }
        for (arrangement, name) in ARRANGEMENTS {
            assert_eq!(serde_json::to_value(arrangement).unwrap(), name);
        }
    }
}
