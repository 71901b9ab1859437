//! A scene: one phenomenon, set up to be looked at.
//!
//! A scene declares the terms of the model that it needs. Only those parameters stand in the pane, and
//! a term that is not declared is zero, so that nothing is evaluated for it. It also says where to look
//! (windows, layers) and, in a few sentences, what for.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::layer::Layer;
use super::machine::Rig;
use super::views::{Arrangement, Exhibit};
use crate::flow::Problem;
use crate::oscillator::Symbol;

/// Relative error of a step where a scene does not say otherwise: ten digits, at a few percent of the
/// cost of drawing them.
pub const TOLERANCE: f64 = 1e-10;

/// End time where a scene does not say otherwise: about ten periods of the undamped oscillator.
pub const UNTIL: f64 = 60.0;

/// A phenomenon, set up to be looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The name by which it is opened.
    pub name: String,
    /// One line.
    pub title: String,
    /// What to look at, in a sentence or two.
    pub look: String,
    /// What to press to see more.
    pub press: String,
    /// The parameters that this scene is about, in the order of the table; all others are zero.
    pub terms: BTreeSet<Symbol>,
    /// The motion on show: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Steps of the keys that differ from those of the table.
    pub steps: BTreeMap<Symbol, f64>,
    /// The layers that are on.
    pub layers: BTreeSet<Layer>,
    /// The plots, one to four, in the order of the focus.
    pub plots: Vec<Exhibit>,
    /// What plots show in place of the present values: one picture over another for each variant.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub families: Vec<Vec<Variant>>,
    /// How they share the screen.
    pub arrangement: Arrangement,
    /// The machine that the numbers stand for, if they stand for one.
    pub machine: Option<Box<Rig>>,
}

/// Values that are held while the others follow the keys.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// The values that are held.
    pub held: BTreeMap<Symbol, f64>,
}

impl Variant {
    /// A motion with the values that are held.
    #[must_use]
    pub fn of(&self, mut problem: Problem) -> Problem {
        for (symbol, value) in &self.held {
            symbol.set(&mut problem.parameters, &mut problem.initial, *value);
        }
        problem
    }
}

impl Scene {
    /// Whether a parameter belongs to this scene; initial values always do.
    #[must_use]
    pub fn declares(&self, symbol: Symbol) -> bool {
        matches!(symbol, Symbol::Q0 | Symbol::V0) || self.terms.contains(&symbol)
    }
}
