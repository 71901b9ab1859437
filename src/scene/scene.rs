//! A scene: the setup that shows one phenomenon.
//!
//! A scene declares the terms of the model that it needs. The pane lists only those parameters; a term that is
//! not declared is zero and never evaluated. A scene also sets windows and layers, and says in a few sentences
//! what to look for.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::machine::ScaledMachine;
use super::plot_setup::{Arrangement, PlotSetup};
use super::views::{Layer, View};
use crate::fit::{Signal, length_in_metres};
use crate::flow::Problem;
use crate::model::Knob;
use crate::question::Recording;

/// The setup that shows one phenomenon.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The name by which it is opened.
    pub name: String,
    /// The figure of the paper that it shows; the scene can also be opened by this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub also: Option<String>,
    pub title: String,
    /// What to look at, in a sentence or two.
    #[serde(rename = "look")]
    pub watch: String,
    /// What to press to see more.
    pub press: String,
    /// The parameters that the scene uses, in the order of the table; all others are zero.
    pub terms: BTreeSet<Knob>,
    /// The motion on show: parameters, start, end time, method and tolerance.
    pub problem: Problem,
    /// Step sizes of the keys that differ from those of the table.
    pub steps: BTreeMap<Knob, f64>,
    pub layers: BTreeSet<Layer>,
    /// The plots, one to four, in the order in which they get the focus.
    pub plots: Vec<PlotSetup>,
    /// Families of variants that plots show in place of the present values, each variant drawn over the others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub families: Vec<Vec<Variant>>,
    /// How the plots share the screen.
    pub arrangement: Arrangement,
    /// The machine that the numbers describe, if any.
    pub machine: Option<Box<ScaledMachine>>,
    /// The record to which the oscillator is fitted, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recording>,
}

/// Values that are held while the others follow the keys.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// The values that are held.
    pub held: BTreeMap<Knob, f64>,
}

impl Variant {
    /// A motion in which these values replace its own.
    pub fn of(&self, mut problem: Problem) -> Problem {
        for (symbol, value) in &self.held {
            symbol.set(&mut problem.parameters, &mut problem.initial, *value);
        }
        problem
    }
}

impl Scene {
    /// All names by which the scene can be opened.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.name.as_str()).chain(self.also.as_deref())
    }

    /// Whether a parameter belongs to this scene; initial values always do.
    pub fn declares(&self, symbol: Knob) -> bool {
        !symbol.is_parameter() || self.terms.contains(&symbol)
    }
}

impl ScaledMachine {
    /// A scene of the machine: the mass on its belt and the phase plane.
    pub fn scene(self) -> Scene {
        let layers = [
            Layer::Whole,
            Layer::Mass,
            Layer::Belt,
            Layer::Trajectory,
            Layer::Sticking,
            Layer::Cycles,
            Layer::Basin,
            Layer::Branch,
            Layer::Special,
        ];
        Scene {
            name: self.machine.name.clone(),
            also: None,
            title: self.machine.title.clone(),
            watch: self.machine.watch.clone(),
            press: "{play-motion} plays the motion and holds it, {motion-pace} changes the pace; {step-up} on D adds damping, on r friction."
                .to_owned(),
            terms: self.terms(),
            problem: self.problem(),
            steps: BTreeMap::new(),
            layers: layers.into(),
            plots: [View::Phase, View::Belt].map(PlotSetup::from).to_vec(),
            families: Vec::new(),
            arrangement: Arrangement::Rows,
            machine: Some(Box::new(self)),
            recording: None,
        }
    }
}

impl Recording {
    /// A scene of the record: decrements, time series, phase plane and the distribution of the margin, with the
    /// motion that the fit will find.
    pub fn scene(self) -> Scene {
        let signal = self.record.signal;
        let shown = match signal {
            Signal::Velocity => Layer::Velocity,
            Signal::Displacement | Signal::Acceleration => Layer::Position,
        };
        let layers = [
            Layer::Damping,
            Layer::Residuals,
            Layer::Spread,
            Layer::Record,
            Layer::Recorded,
            shown,
            Layer::Trajectory,
            Layer::Sticking,
            Layer::Cycles,
            Layer::Basin,
        ];
        let unit = self.record.unit.clone().unwrap_or_else(|| "the file's unit".to_owned());
        let reduced = format!("lengths are in {unit} and times in 1/omega0");
        let units = match self.record.unit.as_deref().and_then(length_in_metres) {
            Some(_) if self.record.t.is_some() => {
                format!("axes are in units of length and seconds; with units off {reduced}")
            }
            _ => reduced,
        };
        let seen = match signal {
            Signal::Displacement => "Dots are what was measured,",
            Signal::Velocity => "Dots are the velocities measured,",
            Signal::Acceleration => "The accelerations measured are seen in the residuals only;",
        };
        Scene {
            name: self.name.clone(),
            also: None,
            title: format!("{}, fitted", self.name),
            watch: format!(
                "{seen} the line is the motion that fits best; {units}. \
                 A number whose error is as large as itself is not known from this record."
            ),
            press: "{step-up} and {step-down} hold a number beside its best value, and all others are fitted again; \
                    {reset-row} lets it go, {reset-scene} all. {views} picks what a plot shows: residuals too."
                .to_owned(),
            terms: Knob::PARAMETERS.into(),
            problem: Problem::default(),
            steps: BTreeMap::new(),
            layers: layers.into(),
            plots: [View::Damping, View::TimeSeries, View::Phase, View::Spread]
                .map(PlotSetup::from)
                .to_vec(),
            families: Vec::new(),
            arrangement: Arrangement::Auto,
            machine: None,
            recording: Some(self),
        }
    }
}
