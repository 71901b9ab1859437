//! The views that a plot can show, and the layers that are drawn in them.
//!
//! A screen has one to [`MOST_PLOTS`](super::MOST_PLOTS) plots. Each shows a view, and two plots may show the
//! same view over different axes. Layers belong to a view, not to a plot. [`LAYERS`] says which view shows a
//! layer and which question must be answered for it. A layer that is off asks nothing, and several layers may
//! share an answer.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::window::Window;
use crate::numerics::{cells, named};
use crate::question::{TOPICS, Topic};

/// The content of a plot; [`VIEWS`] describes each view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
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
    #[serde(rename = "speeds")]
    BeltDiagram,
    Damping,
    Residuals,
    #[serde(rename = "margin")]
    Spread,
    Scan,
}

/// What there must be for a view to show anything.
#[derive(Clone, Copy, Debug, Deserialize)]
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
pub static VIEWS: LazyLock<Vec<ViewSpec>> =
    LazyLock::new(|| include_str!("../../assets/views.txt").lines().filter_map(view).collect());

/// The view that a line of the file describes; `None` for a comment. A test reads every line.
fn view(line: &'static str) -> Option<ViewSpec> {
    let [name, title, heading, needs, coordinates, window, meaning, nothing] = cells(line)?;
    let coordinates = coordinates.split_once(' ')?;
    let ends: Vec<f64> = window.split(' ').filter_map(|end| end.parse().ok()).collect();
    let window = Window::of(ends.try_into().ok()?)?;
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

/// A part of a view that can be switched on and off; [`LAYERS`] describes each layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layer {
    Trajectory,
    Sticking,
    Cycles,
    Basin,
    Margin,
    Field,
    Lyapunov,
    Bands,
    Balance,
    Ghost,
    Belt,
    Mass,
    Branch,
    Harmonic,
    Asymptotes,
    Special,
    Position,
    Velocity,
    Friction,
    Energy,
    Events,
    CycleWorks,
    MotionWorks,
    Map,
    Cobweb,
    FixedPoints,
    Regimes,
    #[serde(alias = "borders")]
    Boundaries,
    #[serde(alias = "harmonic-border")]
    HarmonicFold,
    Rows,
    Front,
    Extents,
    Levels,
    Spirals,
    Rate,
    Locus,
    BeltPath,
    Record,
    Recorded,
    Whole,
    #[serde(rename = "speeds")]
    MachineBranch,
    Safe,
    Lost,
    #[serde(rename = "decrements")]
    Damping,
    #[serde(rename = "differences")]
    Residuals,
    Spread,
    Kicks,
}

/// Every layer, in the order in which they are listed: the lines of `assets/layers.txt`.
pub static LAYERS: LazyLock<Vec<LayerSpec>> =
    LazyLock::new(|| include_str!("../../assets/layers.txt").lines().filter_map(layer).collect());

/// The layer that a line of the file describes; `None` for a comment. A test reads every line.
fn layer(line: &'static str) -> Option<LayerSpec> {
    let [name, view, topic, switch, meaning] = cells(line)?;
    let (layer, view) = (named(name)?, named(view)?);
    let needs = TOPICS.iter().find(|known| known.name() == topic).copied();
    Some(LayerSpec { layer, name, view, meaning, needs, usual: switch == "on" })
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
        let lines = include_str!("../../assets/layers.txt").lines().filter_map(cells::<5>);
        for (row, [name, _, topic, switch, _]) in LAYERS.iter().zip(lines) {
            assert_eq!((row.layer.spec().layer, row.name), (row.layer, name));
            assert_eq!(row.needs.map_or("-", Topic::name), topic);
            assert!(["on", "off"].contains(&switch), "{name}");
            assert_eq!(named(row.name), Some(row.layer));
            assert!(row.meaning.len() <= 52, "{} is cut at 80 columns", row.name);
        }
        assert_eq!(LAYERS.last().map(|row| row.layer), Some(Layer::Kicks));
        assert_eq!(LAYERS.len(), Layer::Kicks as usize + 1);
        assert_eq!(named("harmonic-border"), Some(Layer::HarmonicFold));
    }
}
