//! Layers: what is drawn in the views.
//!
//! [`LAYERS`] is the one table of layers. It says which view shows a layer and which question must be
//! answered for it: a layer that is off asks nothing, and several layers may share one answer.

use serde::{Deserialize, Serialize};

use super::request::Slot;
use super::views::View;

/// Something drawn in a view that can be switched on and off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layer {
    /// The motion from the initial state.
    Trajectory,
    /// The segment of equilibria.
    Sticking,
    /// The limit cycles.
    Cycles,
    /// The basin of attraction of the sticking set, shaded.
    Basin,
    /// Directions of the flow.
    Field,
    /// The circle of equation (24).
    Lyapunov,
    /// The borders between the bands of capture.
    Bands,
    /// The cycles of N harmonics.
    Balance,
    /// The point left last for a mark: its motion and cycles.
    Ghost,
    /// The velocity at which the mass sticks to the belt.
    Belt,
    /// The mass on its belt.
    Mass,
    /// Computed cycles along the diagram's parameter.
    Branch,
    /// First-order harmonic amplitudes.
    Harmonic,
    /// The asymptotes of the harmonic amplitudes.
    Asymptotes,
    /// Labels at the special points.
    Special,
    /// Displacement over time.
    Position,
    /// Velocity over time.
    Velocity,
    /// The force of dry friction over time.
    Friction,
    /// Energy over time.
    Energy,
    /// Turning points and capture on the time axis.
    Events,
    /// Works over one turn of each cycle.
    CycleWorks,
    /// Works along the motion.
    MotionWorks,
    /// The return map.
    Map,
    /// The turning points of the motion, as a cobweb.
    Cobweb,
    /// The cycles, as fixed points of the return map.
    FixedPoints,
    /// What becomes of kicks, over two parameters.
    Regimes,
    /// The computed borders between regimes.
    Borders,
    /// The border by one harmonic (48).
    HarmonicBorder,
    /// Error over cost, method by method.
    Rows,
    /// The best choices among them.
    Front,
    /// The largest velocity of the cycles, beside the ordinate.
    Extents,
    /// Levels of the energy, and where it falls.
    Levels,
    /// The spirals that make the cycle.
    Spirals,
    /// The rate of the energy over the velocity.
    Rate,
    /// The eigenvalues, and their way over D.
    Locus,
    /// The path of the machine over the speed of its belt.
    BeltPath,
    /// Measured displacements over time.
    Record,
    /// Measured displacements in the phase plane.
    Recorded,
    /// The whole model of the machine in place of its cubic expansion.
    Whole,
    /// The cycles over the speed of the belt.
    Speeds,
}

/// One row of [`LAYERS`].
#[derive(Clone, Copy, Debug)]
pub struct LayerSpec {
    /// The layer.
    pub layer: Layer,
    /// Its name in scene files and on the screen.
    pub name: &'static str,
    /// The view that shows it.
    pub view: View,
    /// What it shows, in a few words.
    pub meaning: &'static str,
    /// The question whose answer it draws; `None` where formulas do.
    pub needs: Option<Slot>,
    /// Whether it is switched on with its view, where the scene has nothing to say about that.
    pub usual: bool,
}

/// Every layer, in the order in which they are listed.
pub const LAYERS: [LayerSpec; 40] = [
    LayerSpec {
        layer: Layer::Trajectory,
        name: "trajectory",
        view: View::Phase,
        meaning: "the motion from (q0, v0)",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Sticking,
        name: "sticking",
        view: View::Phase,
        meaning: "the sticking set: every point of it is at rest",
        needs: None,
        usual: true,
    },
    LayerSpec {
        layer: Layer::Cycles,
        name: "cycles",
        view: View::Phase,
        meaning: "limit cycles, stable and unstable",
        needs: Some(Slot::Cycles),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Basin,
        name: "basin",
        view: View::Phase,
        meaning: "starts that come to rest, shaded",
        needs: Some(Slot::Cycles),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Field,
        name: "field",
        view: View::Phase,
        meaning: "directions of the flow",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Lyapunov,
        name: "lyapunov",
        view: View::Phase,
        meaning: "the circle of starts whose capture is proved",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Bands,
        name: "bands",
        view: View::Phase,
        meaning: "bands of capture: one more half swing in each",
        needs: Some(Slot::Capture),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Balance,
        name: "balance",
        view: View::Phase,
        meaning: "cycles of N harmonics, and their error",
        needs: Some(Slot::Balance),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Ghost,
        name: "ghost",
        view: View::Phase,
        meaning: "the point left for a mark, its motion and cycles",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Belt,
        name: "belt",
        view: View::Phase,
        meaning: "the speed of the belt, at which the mass sticks",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Mass,
        name: "mass",
        view: View::Belt,
        meaning: "the mass on its belt, moving with the motion",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Branch,
        name: "branch",
        view: View::Diagram,
        meaning: "computed limit cycles, stable and unstable",
        needs: Some(Slot::Branch),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Harmonic,
        name: "harmonic",
        view: View::Diagram,
        meaning: "amplitudes of the first-order harmonic balance",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Asymptotes,
        name: "asymptotes",
        view: View::Diagram,
        meaning: "asymptotes A1 and A2 of the harmonic amplitudes",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Special,
        name: "special",
        view: View::Diagram,
        meaning: "special points: fold, crossing, escape, Hopf",
        needs: Some(Slot::Branch),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Position,
        name: "position",
        view: View::TimeSeries,
        meaning: "displacement q",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Velocity,
        name: "velocity",
        view: View::TimeSeries,
        meaning: "velocity v",
        needs: Some(Slot::Trajectory),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Friction,
        name: "friction",
        view: View::TimeSeries,
        meaning: "force of dry friction, between -r and r",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Energy,
        name: "energy",
        view: View::TimeSeries,
        meaning: "energy (q^2 + v^2)/2",
        needs: Some(Slot::Trajectory),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Events,
        name: "events",
        view: View::TimeSeries,
        meaning: "turning points, capture",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::CycleWorks,
        name: "cycle-works",
        view: View::EnergyLedger,
        meaning: "works over one turn of each cycle",
        needs: Some(Slot::Cycles),
        usual: true,
    },
    LayerSpec {
        layer: Layer::MotionWorks,
        name: "motion-works",
        view: View::EnergyLedger,
        meaning: "works along the motion",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Map,
        name: "map",
        view: View::ReturnMap,
        meaning: "the next turning point on the same side",
        needs: Some(Slot::ReturnMap),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Cobweb,
        name: "cobweb",
        view: View::ReturnMap,
        meaning: "the turning points of the motion, step by step",
        needs: Some(Slot::Trajectory),
        usual: true,
    },
    LayerSpec {
        layer: Layer::FixedPoints,
        name: "fixed-points",
        view: View::ReturnMap,
        meaning: "limit cycles, stable and unstable",
        needs: Some(Slot::Cycles),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Regimes,
        name: "regimes",
        view: View::Regimes,
        meaning: "what becomes of kicks",
        needs: Some(Slot::Regimes),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Borders,
        name: "borders",
        view: View::Regimes,
        meaning: "computed fold and escape point",
        needs: Some(Slot::Regimes),
        usual: true,
    },
    LayerSpec {
        layer: Layer::HarmonicBorder,
        name: "harmonic-border",
        view: View::Regimes,
        meaning: "the fold by one harmonic (48)",
        needs: Some(Slot::Regimes),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Rows,
        name: "rows",
        view: View::Trade,
        meaning: "every method over its tolerances, steps or widths",
        needs: Some(Slot::Trade),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Front,
        name: "front",
        view: View::Trade,
        meaning: "the best choices: nothing else is better for less",
        needs: Some(Slot::Trade),
        usual: true,
    },
    LayerSpec {
        layer: Layer::Extents,
        name: "extents",
        view: View::Diagram,
        meaning: "largest velocity of the cycles, beside the ordinate",
        needs: Some(Slot::Branch),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Levels,
        name: "levels",
        view: View::Phase,
        meaning: "levels of the energy, and shaded where it falls",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Spirals,
        name: "spirals",
        view: View::Phase,
        meaning: "the two shifted spirals that make the cycle",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Rate,
        name: "rate",
        view: View::EnergyRate,
        meaning: "V', what damping feeds and what friction takes",
        needs: None,
        usual: true,
    },
    LayerSpec {
        layer: Layer::Locus,
        name: "locus",
        view: View::Eigenvalues,
        meaning: "the eigenvalues, and their way over D",
        needs: None,
        usual: true,
    },
    LayerSpec {
        layer: Layer::BeltPath,
        name: "belt-path",
        view: View::Regimes,
        meaning: "the machine over the speed of its belt",
        needs: None,
        usual: true,
    },
    LayerSpec {
        layer: Layer::Record,
        name: "record",
        view: View::TimeSeries,
        meaning: "measured displacements of the record",
        needs: Some(Slot::Fit),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Recorded,
        name: "recorded",
        view: View::Phase,
        meaning: "measured displacements over their fitted velocity",
        needs: Some(Slot::Fit),
        usual: false,
    },
    LayerSpec {
        layer: Layer::Whole,
        name: "whole",
        view: View::Phase,
        meaning: "the whole model in place of its cubic expansion",
        needs: None,
        usual: false,
    },
    LayerSpec {
        layer: Layer::Speeds,
        name: "speeds",
        view: View::Speeds,
        meaning: "cycles over the belt's speed, and the jumps",
        needs: Some(Slot::Speeds),
        usual: true,
    },
];

impl Layer {
    /// The row of [`LAYERS`] that describes this layer.
    #[must_use]
    pub fn spec(self) -> &'static LayerSpec {
        &LAYERS[self as usize]
    }
}

/// The letters that move in a list or close it.
const TAKEN: [char; 5] = ['g', 'j', 'k', 'q', 'v'];

/// The layers of a view, each with its letter in the list of layers: the first of its name that no layer
/// before it has.
pub fn letters(view: View) -> impl Iterator<Item = (char, Layer)> {
    let mut taken = TAKEN.to_vec();
    LAYERS.iter().filter(move |row| row.view == view).filter_map(move |row| {
        let mut letters = row.name.chars().filter(char::is_ascii_lowercase).chain('a'..='z');
        let letter = letters.find(|letter| !taken.contains(letter))?;
        taken.push(letter);
        Some((letter, row.layer))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_layer_has_a_letter_of_its_own_in_its_view() {
        for row in &super::super::VIEWS {
            let letters: Vec<char> = letters(row.view).map(|(letter, _)| letter).collect();
            let own: std::collections::BTreeSet<_> = letters.iter().collect();
            let layers = LAYERS.iter().filter(|layer| layer.view == row.view).count();
            assert_eq!((letters.len(), own.len()), (layers, layers), "{}", row.name);
        }
        assert_eq!(letters(View::Phase).next(), Some(('t', Layer::Trajectory)));
    }

    #[test]
    fn every_layer_stands_at_its_own_row_under_the_name_of_scene_files() {
        for row in &LAYERS {
            assert_eq!(row.layer.spec().name, row.name);
            assert_eq!(serde_json::to_value(row.layer).unwrap(), row.name);
            assert!(row.meaning.len() <= 52, "{} is cut at 80 columns", row.name);
        }
    }
}
