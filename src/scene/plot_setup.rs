//! How a scene sets up its plots: their views, axes and windows, and how they share the screen.

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use super::ordinate::{Height, Ordinate, Unit, usual_values};
use super::views::View;
use super::window::Window;
use crate::model::Knob;

/// Maximum number of plots on a screen: more would be too small to read.
pub const MOST_PLOTS: usize = 4;

/// The axes of a plot. A view that leaves no choice ignores them and keeps them for other views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Axes {
    /// The parameter to the right.
    pub abscissa: Knob,
    /// The property of the cycles upwards.
    pub ordinate: Ordinate,
    /// The unit of the ordinate, where that is a length.
    pub unit: Unit,
    /// The parameter upwards, in a chart over two parameters.
    pub against: Knob,
}

impl Default for Axes {
    /// The axes of the paper's diagrams.
    fn default() -> Self {
        Axes { abscissa: Knob::D, ordinate: Ordinate::QMax, unit: Unit::One, against: Knob::D3 }
    }
}

impl Axes {
    /// The label of the ordinate of a diagram.
    pub fn label(&self) -> &'static str {
        let spec = self.ordinate.spec();
        spec.ratio.filter(|_| self.unit == Unit::Friction).unwrap_or(spec.label)
    }

    /// The measure of heights in a diagram whose cycles are computed at this friction.
    pub fn height(&self, friction: f64) -> Height {
        let friction = (self.abscissa != Knob::R).then_some(friction);
        Height { ordinate: self.ordinate, unit: self.unit, friction }
    }
}

/// A plot as a scene sets it up: its view, its axes, and the part to show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSetup {
    pub view: View,
    /// The axes, where the view leaves a choice.
    #[serde(default)]
    pub axes: Axes,
    /// The part to show; `None` for a window fitted to the content.
    pub window: Option<Window>,
    /// The family of variants, by its index in the scene, that the plot shows in place of the present values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
}

impl From<View> for PlotSetup {
    /// A view with its usual axes, in a fitted window.
    fn from(view: View) -> Self {
        PlotSetup { view, axes: Axes::default(), window: None, family: None }
    }
}

impl PlotSetup {
    /// The window with which the plot opens, or from which fitting begins if none is given.
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

/// How the plots share the screen, in the order in which the key cycles through it.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Arrangement {
    /// The arrangement in which the plots are closest to squares.
    #[default]
    Auto,
    Columns,
    Rows,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrangements_have_the_names_of_scene_files() {
        for arrangement in Arrangement::VARIANTS {
            let name: &str = arrangement.into();
            assert_eq!(serde_json::to_value(arrangement).unwrap(), name);
        }
    }
}
