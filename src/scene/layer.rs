//! Layers: what is drawn in the views.
//!
//! [`LAYERS`] is the one table of layers. It says which view shows a layer and which question must be
//! answered for it: a layer that is off asks nothing, and several layers may share one answer.

use serde::{Deserialize, Serialize};

use super::views::View;
use crate::question::Topic;

/// Something drawn in a view that can be switched on and off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layer {
    /// The motion from the initial state.
    Trajectory,
    /// The segment of equilibria.
    Sticking,
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
    Harmonic,
    /// The asymptotes of the harmonic amplitudes.
    Asymptotes,
    /// Labels at the special points.
    Special,
    Position,
    Velocity,
    /// The force of dry friction over time.
    Friction,
    Energy,
    /// Turning points and capture on the time axis.
    Events,
    /// Works over one turn of each cycle.
    CycleWorks,
    /// Works along the motion.
    MotionWorks,
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
    /// Starts that are safe whatever the parameters and the disturbance are.
    Safe,
    /// Starts that are lost whatever the parameters and the disturbance are.
    Lost,
    /// Damping over amplitude.
    #[serde(rename = "decrements")]
    Damping,
    /// Residuals of a fit.
    #[serde(rename = "differences")]
    Residuals,
    /// The distribution of the margin.
    Spread,
}

/// One row of [`LAYERS`].
#[derive(Clone, Copy, Debug)]
pub struct LayerSpec {
    pub layer: Layer,
    /// Its name in scene files and on the screen.
    pub name: &'static str,
    /// The view that shows it.
    pub view: View,
    /// What it shows, in a few words.
    pub meaning: &'static str,
    /// The question whose answer it draws; `None` where formulas do.
    pub needs: Option<Topic>,
    /// Whether it is switched on with its view, where the scene has nothing to say about that.
    pub usual: bool,
}

/// Every layer, in the order in which they are listed.
#[rustfmt::skip]
pub const LAYERS: [LayerSpec; 45] = [
    row(Layer::Trajectory, "trajectory", View::Phase, Some(Topic::Trajectory), true, "the motion from (q0, v0)"),
    row(Layer::Sticking, "sticking", View::Phase, None, true, "the sticking set: every point of it is at rest"),
    row(Layer::Cycles, "cycles", View::Phase, Some(Topic::Cycles), true, "limit cycles, stable and unstable"),
    row(Layer::Basin, "basin", View::Phase, Some(Topic::Cycles), true, "starts that come to rest, shaded"),
    row(Layer::Field, "field", View::Phase, None, false, "directions of the flow"),
    row(Layer::Lyapunov, "lyapunov", View::Phase, None, false, "the circle of starts whose capture is proved"),
    row(Layer::Bands, "bands", View::Phase, Some(Topic::Capture), false, "bands of capture: one more half swing in each"),
    row(Layer::Balance, "balance", View::Phase, Some(Topic::Balance), false, "cycles of N harmonics, and their error"),
    row(Layer::Ghost, "ghost", View::Phase, None, false, "the point left for a mark, its motion and cycles"),
    row(Layer::Belt, "belt", View::Phase, None, false, "the speed of the belt, at which the mass sticks"),
    row(Layer::Mass, "mass", View::Belt, Some(Topic::Trajectory), true, "the mass on its belt, moving with the motion"),
    row(Layer::Branch, "branch", View::Diagram, Some(Topic::Branch), true, "computed limit cycles, stable and unstable"),
    row(Layer::Harmonic, "harmonic", View::Diagram, None, false, "amplitudes of the first-order harmonic balance"),
    row(Layer::Asymptotes, "asymptotes", View::Diagram, None, false, "asymptotes A1 and A2 of the harmonic amplitudes"),
    row(Layer::Special, "special", View::Diagram, Some(Topic::Branch), true, "special points: fold, crossing, escape, Hopf"),
    row(Layer::Position, "position", View::TimeSeries, Some(Topic::Trajectory), true, "displacement q"),
    row(Layer::Velocity, "velocity", View::TimeSeries, Some(Topic::Trajectory), false, "velocity v"),
    row(Layer::Friction, "friction", View::TimeSeries, Some(Topic::Trajectory), true, "force of dry friction, between -r and r"),
    row(Layer::Energy, "energy", View::TimeSeries, Some(Topic::Trajectory), false, "energy (q^2 + v^2)/2"),
    row(Layer::Events, "events", View::TimeSeries, Some(Topic::Trajectory), true, "turning points, capture"),
    row(Layer::CycleWorks, "cycle-works", View::EnergyLedger, Some(Topic::Cycles), true, "works over one turn of each cycle"),
    row(Layer::MotionWorks, "motion-works", View::EnergyLedger, Some(Topic::Trajectory), true, "works along the motion"),
    row(Layer::Map, "map", View::ReturnMap, Some(Topic::ReturnMap), true, "the next turning point on the same side"),
    row(Layer::Cobweb, "cobweb", View::ReturnMap, Some(Topic::Trajectory), true, "the turning points of the motion, step by step"),
    row(Layer::FixedPoints, "fixed-points", View::ReturnMap, Some(Topic::Cycles), true, "limit cycles, stable and unstable"),
    row(Layer::Regimes, "regimes", View::Regimes, Some(Topic::Regimes), true, "what becomes of kicks"),
    row(Layer::Borders, "borders", View::Regimes, Some(Topic::Regimes), true, "computed fold and escape point"),
    row(Layer::HarmonicBorder, "harmonic-border", View::Regimes, Some(Topic::Regimes), false, "the fold by one harmonic (48)"),
    row(Layer::Rows, "rows", View::Trade, Some(Topic::Trade), true, "every method over its tolerances, steps or widths"),
    row(Layer::Front, "front", View::Trade, Some(Topic::Trade), true, "the best choices: nothing else is better for less"),
    row(Layer::Extents, "extents", View::Diagram, Some(Topic::Branch), false, "largest velocity of the cycles, beside the ordinate"),
    row(Layer::Levels, "levels", View::Phase, None, false, "levels of the energy, and shaded where it falls"),
    row(Layer::Spirals, "spirals", View::Phase, None, false, "the two shifted spirals that make the cycle"),
    row(Layer::Rate, "rate", View::EnergyRate, None, true, "V', what damping feeds and what friction takes"),
    row(Layer::Locus, "locus", View::Eigenvalues, None, true, "the eigenvalues, and their way over D"),
    row(Layer::BeltPath, "belt-path", View::Regimes, None, true, "the machine over the speed of its belt"),
    row(Layer::Record, "record", View::TimeSeries, Some(Topic::Fit), false, "measured displacements of the record"),
    row(Layer::Recorded, "recorded", View::Phase, Some(Topic::Fit), false, "measured displacements over their fitted velocity"),
    row(Layer::Whole, "whole", View::Phase, None, false, "the whole model in place of its cubic expansion"),
    row(Layer::Speeds, "speeds", View::Speeds, Some(Topic::Speeds), true, "cycles over the belt's speed, and the jumps"),
    row(Layer::Safe, "safe", View::Phase, Some(Topic::Zones), false, "surely safe, for all half widths and disturbances"),
    row(Layer::Lost, "lost", View::Phase, Some(Topic::Zones), false, "surely lost, for the same"),
    row(Layer::Damping, "decrements", View::Damping, Some(Topic::Fit), true, "measured decrements, exact and averaged damping"),
    row(Layer::Residuals, "differences", View::Residuals, Some(Topic::Fit), true, "measured less fitted, and two deviations"),
    row(Layer::Spread, "spread", View::Spread, Some(Topic::Fit), true, "distribution of the margin, by draws"),
];

const fn row(
    layer: Layer,
    name: &'static str,
    view: View,
    needs: Option<Topic>,
    usual: bool,
    meaning: &'static str,
) -> LayerSpec {
    LayerSpec { layer, name, view, meaning, needs, usual }
}

impl Layer {
    /// The row of [`LAYERS`] that describes this layer.
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
