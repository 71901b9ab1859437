//! The views that a plot can show, and the layers that are drawn in them.
//!
//! A screen has one to [`MOST_PLOTS`](super::MOST_PLOTS) plots. Each shows a view, and two plots may show the
//! same view over different axes. Layers belong to a view, not to a plot. [`LAYERS`] says which view shows a
//! layer and which question must be answered for it. A layer that is off asks nothing, and several layers may
//! share an answer.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::window::{Span, Window};
use crate::numerics::{cells, named};
use crate::question::Topic;

/// The content of a plot; [`VIEWS`] describes each view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    Phase,
    Diagram,
    TimeSeries,
    EnergyLedger,
    ReturnMap,
    Regimes,
    Trade,
    Belt,
    EnergyRate,
    Eigenvalues,
    Speeds,
    Damping,
    Residuals,
    #[serde(rename = "margin")]
    Spread,
    Scan,
}

/// What there must be for a view to show anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Needs {
    /// Nothing but the oscillator, which is always there.
    Oscillator,
    Machine,
    Record,
    Scan,
}

impl Needs {
    /// How to get it, in a sentence in which keys are named by their commands; empty where it is always there.
    pub fn sentence(self) -> &'static str {
        match self {
            Needs::Oscillator => "",
            Needs::Machine => "needs a machine: {prompt}belt clutch opens one",
            Needs::Record => "needs a recorded motion: {prompt}fit FILE opens one",
            Needs::Scan => "needs a scan: {scan} opens the line for one",
        }
    }
}

/// One row of [`VIEWS`].
#[derive(Clone, Copy, Debug)]
pub struct ViewSpec {
    pub view: View,
    /// Its name in scene files.
    pub name: &'static str,
    /// Its name on the screen.
    pub title: &'static str,
    /// Heading above the keys of this view.
    pub heading: &'static str,
    /// The names of its coordinates, to the right and upwards, where its axes are no choice.
    pub coordinates: (&'static str, &'static str),
    /// The window where no other is asked for.
    pub window: Window,
    /// Explanation in a few words.
    pub meaning: &'static str,
    pub needs: Needs,
    /// What it says where it has all that it needs and nothing lies in its window, as [`Needs::sentence`].
    pub nothing: &'static str,
}

/// Every view, in the order in which they are listed and the keys cycle through them: the lines of `assets/views.txt`.
pub static VIEWS: LazyLock<Vec<ViewSpec>> = LazyLock::new(|| {
    include_str!("../../assets/views.txt").lines().filter_map(described).collect()
});

/// The view that a line of the file describes; `None` for a comment. A test reads every line.
fn described(line: &'static str) -> Option<ViewSpec> {
    let [name, title, heading, needs, coordinates, window, meaning, nothing] = cells(line)?;
    let coordinates = coordinates.split_once(' ')?;
    let ends: Vec<f64> = window.split(' ').filter_map(|end| end.parse().ok()).collect();
    let [left, right, low, high] = ends[..] else { return None };
    let window = Window { x: Span::known(left, right), y: Span::known(low, high) };
    let (view, needs) = (named(name)?, named(needs)?);
    Some(ViewSpec { view, name, title, heading, coordinates, window, meaning, needs, nothing })
}

impl View {
    /// The row of [`VIEWS`] that describes this view.
    pub fn spec(self) -> &'static ViewSpec {
        &VIEWS[self as usize]
    }
}

/// One row of [`LAYERS`].
#[derive(Clone, Copy, Debug)]
pub struct LayerSpec {
    pub layer: Layer,
    /// Its name in scene files and on the screen.
    pub name: &'static str,
    /// The view that shows it.
    pub view: View,
    /// Explanation in a few words.
    pub meaning: &'static str,
    /// The question whose answer it draws; `None` where it needs only formulas.
    pub needs: Option<Topic>,
    /// Whether it is switched on with its view, unless the scene says otherwise.
    pub usual: bool,
}

/// Makes [`Layer`] and [`LAYERS`] from one list, in the order in which layers are listed: name, view, question,
/// whether the layer is usual, meaning.
macro_rules! layers {
    ($($(#[$attribute:meta])* $layer:ident: $name:literal, $view:ident, $needs:expr, $usual:literal, $meaning:literal;)*) => {
        /// A part of a view that can be switched on and off; [`LAYERS`] describes each layer.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum Layer {
            $($(#[$attribute])* #[serde(rename = $name)] $layer,)*
        }

        /// Every layer, in the order in which they are listed.
        pub const LAYERS: [LayerSpec; [$($name),*].len()] = [$(LayerSpec {
            layer: Layer::$layer,
            name: $name,
            view: View::$view,
            meaning: $meaning,
            needs: $needs,
            usual: $usual,
        }),*];
    };
}

layers! {
    Trajectory: "trajectory", Phase, Some(Topic::Trajectory), true, "the motion from (q0, v0)";
    Sticking: "sticking", Phase, None, true, "the sticking set: every point of it is at rest";
    Cycles: "cycles", Phase, Some(Topic::Cycles), true, "limit cycles, stable and unstable";
    Basin: "basin", Phase, Some(Topic::Cycles), true, "starts that come to rest, shaded";
    Field: "field", Phase, None, false, "directions of the flow";
    Lyapunov: "lyapunov", Phase, None, false, "the circle of starts whose capture is proved";
    Bands: "bands", Phase, Some(Topic::Capture), false, "bands of capture: one more half swing in each";
    Balance: "balance", Phase, Some(Topic::Balance), false, "cycles of N harmonics, and their error";
    Ghost: "ghost", Phase, None, false, "the point left for a mark, its motion and cycles";
    Belt: "belt", Phase, None, false, "the speed of the belt, at which the mass sticks";
    Mass: "mass", Belt, Some(Topic::Trajectory), true, "the mass on its belt, moving with the motion";
    Branch: "branch", Diagram, Some(Topic::Branch), true, "computed limit cycles, stable and unstable";
    Harmonic: "harmonic", Diagram, None, false, "amplitudes of the first-order harmonic balance";
    Asymptotes: "asymptotes", Diagram, None, false, "asymptotes A1 and A2 of the harmonic amplitudes";
    Special: "special", Diagram, Some(Topic::Branch), true, "special points: fold, crossing, escape, Hopf";
    Position: "position", TimeSeries, Some(Topic::Trajectory), true, "displacement q";
    Velocity: "velocity", TimeSeries, Some(Topic::Trajectory), false, "velocity v";
    Friction: "friction", TimeSeries, Some(Topic::Trajectory), true, "force of dry friction, between -r and r";
    Energy: "energy", TimeSeries, Some(Topic::Trajectory), false, "energy (q^2 + v^2)/2";
    Events: "events", TimeSeries, Some(Topic::Trajectory), true, "turning points, capture";
    CycleWorks: "cycle-works", EnergyLedger, Some(Topic::Cycles), true, "works over one turn of each cycle";
    MotionWorks: "motion-works", EnergyLedger, Some(Topic::Trajectory), true, "works along the motion";
    Map: "map", ReturnMap, Some(Topic::ReturnMap), true, "the next turning point on the same side";
    Cobweb: "cobweb", ReturnMap, Some(Topic::Trajectory), true, "the turning points of the motion, step by step";
    FixedPoints: "fixed-points", ReturnMap, Some(Topic::Cycles), true, "limit cycles, stable and unstable";
    Regimes: "regimes", Regimes, Some(Topic::Regimes), true, "what becomes of kicks";
    #[serde(alias = "borders")]
    Boundaries: "boundaries", Regimes, Some(Topic::Regimes), true, "computed fold and escape point";
    #[serde(alias = "harmonic-border")]
    HarmonicFold: "harmonic-fold", Regimes, Some(Topic::Regimes), false, "the fold by one harmonic (48)";
    Rows: "rows", Trade, Some(Topic::Trade), true, "every method over its tolerances, steps or widths";
    Front: "front", Trade, Some(Topic::Trade), true, "the best choices: nothing else is better for less";
    Extents: "extents", Diagram, Some(Topic::Branch), false, "largest velocity of the cycles, beside the ordinate";
    Levels: "levels", Phase, None, false, "levels of the energy, and shaded where it falls";
    Spirals: "spirals", Phase, None, false, "the two shifted spirals that make the cycle";
    Rate: "rate", EnergyRate, None, true, "V', what damping feeds and what friction takes";
    Locus: "locus", Eigenvalues, None, true, "the eigenvalues, and their way over D";
    BeltPath: "belt-path", Regimes, None, true, "the machine over the speed of its belt";
    Record: "record", TimeSeries, Some(Topic::Fit), false, "measured displacements of the record";
    Recorded: "recorded", Phase, Some(Topic::Fit), false, "measured displacements over their fitted velocity";
    Whole: "whole", Phase, None, false, "the whole model in place of its cubic expansion";
    Speeds: "speeds", Speeds, Some(Topic::Speeds), true, "cycles over a number of the machine, and the jumps";
    Safe: "safe", Phase, Some(Topic::Zones), false, "surely safe, for all half widths and disturbances";
    Lost: "lost", Phase, Some(Topic::Zones), false, "surely lost, for the same";
    Damping: "decrements", Damping, Some(Topic::Fit), true, "measured decrements, exact and averaged damping";
    Residuals: "differences", Residuals, Some(Topic::Fit), true, "measured less fitted, and two deviations";
    Spread: "spread", Spread, Some(Topic::Fit), true, "distribution of the margin, by draws";
    Kicks: "kicks", Phase, Some(Topic::Kicks), false, "density of random kicks, and the part lost";
}

impl Layer {
    /// The row of [`LAYERS`] that describes this layer.
    pub fn spec(self) -> &'static LayerSpec {
        &LAYERS[self as usize]
    }
}

/// Letters that already move in a list or close it.
const TAKEN: [char; 5] = ['g', 'j', 'k', 'q', 'v'];

/// The layers of a view, each with its letter in the list of layers: the first letter of its name that is not
/// taken.
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
        for row in VIEWS.iter() {
            let letters: Vec<char> = letters(row.view).map(|(letter, _)| letter).collect();
            let own: std::collections::BTreeSet<_> = letters.iter().collect();
            let layers = LAYERS.iter().filter(|layer| layer.view == row.view).count();
            assert_eq!((letters.len(), own.len()), (layers, layers), "{}", row.name);
        }
        assert_eq!(letters(View::Phase).next(), Some(('t', Layer::Trajectory)));
    }

    #[test]
    fn every_view_stands_at_its_own_row_under_the_name_of_scene_files() {
        let lines = include_str!("../../assets/views.txt").lines();
        assert_eq!(VIEWS.len(), lines.filter(|line| line.contains(" | ")).count());
        for row in VIEWS.iter() {
            assert_eq!(row.view.spec().name, row.name);
            assert_eq!(serde_json::to_value(row.view).unwrap(), row.name);
        }
    }

    #[test]
    fn every_layer_is_found_by_its_name_and_by_the_one_it_once_had() {
        for row in &LAYERS {
            assert_eq!(row.layer.spec().layer, row.layer);
            assert_eq!(named(row.name), Some(row.layer));
            assert!(row.meaning.len() <= 52, "{} is cut at 80 columns", row.name);
        }
        assert_eq!(named("harmonic-border"), Some(Layer::HarmonicFold));
    }
}
