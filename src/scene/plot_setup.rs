//! How a scene sets its plots up: what each shows, over which axes, in which window, and how they share the
//! screen.

use serde::{Deserialize, Serialize};

use super::ordinate::{Height, Ordinate, Unit, usual_values};
use super::views::View;
use super::window::Window;
use crate::oscillator::Symbol;

/// Plots on a screen at most: more would be too small to read.
pub const MOST_PLOTS: usize = 4;

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

impl From<View> for PlotSetup {
    /// A view over its usual axes, in a window fitted to it.
    fn from(view: View) -> Self {
        PlotSetup { view, axes: Axes::default(), window: None, family: None }
    }
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
    fn arrangements_have_the_names_of_scene_files() {
        for (arrangement, name) in ARRANGEMENTS {
            assert_eq!(serde_json::to_value(arrangement).unwrap(), name);
        }
    }
}
