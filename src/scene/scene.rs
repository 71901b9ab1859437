//! A scene: the setup that shows one phenomenon. Scene files and saved sessions hold it alike.
//!
//! A scene declares the terms of the model that it needs. The pane lists only those parameters; a term that is
//! not declared is zero and never evaluated. A scene also sets windows and layers, and says in a few sentences
//! what to look for. A scene of the user, a study, also says which files are made of it.

use std::collections::{BTreeMap, BTreeSet};

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::machine::{ScaledMachine, Setting, library};
use super::plot_setup::{Arrangement, PlotSetup};
use super::sheet::Sheet;
use super::views::Layer;
use crate::flow::Problem;
use crate::model::{Knob, State};
use crate::question::Recording;
use crate::scan::LevelTarget;

/// The setup that shows one phenomenon.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The name by which it is opened; that of its file.
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
    /// The level curves in charts and in scans over two numbers, such as `impulse=0.2`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<LevelTarget>,
    /// Whether the motion is played from the beginning.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub plays: bool,
    /// The scene that enter leads to, if this is a first screen; such a screen begins with what it says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<String>,
    /// How the plots share the screen.
    pub arrangement: Arrangement,
    /// How its figure is printed.
    #[serde(default, skip_serializing_if = "Sheet::is_usual")]
    pub sheet: Sheet,
    /// The machine that the numbers describe, if any.
    #[serde(default, deserialize_with = "named_or_whole", skip_serializing_if = "Option::is_none")]
    pub machine: Option<Box<ScaledMachine>>,
    /// The record to which the oscillator is fitted, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recording>,
    /// Starts of the motions that are shown beside the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<State>,
    /// The scans of a study.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scans: Vec<ScanOptions>,
    /// The files that `hopfscope figure` makes of it, named from its own folder.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outputs: Vec<String>,
}

/// The options of a scan by their names, as the command `scan` takes them: one value or several.
pub type ScanOptions = BTreeMap<String, ScanOption>;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a text or a list of texts")]
pub enum ScanOption {
    One(String),
    Several(Vec<String>),
}

/// A machine in full, or the name of a built-in one and, where that is not its own, the speed of its belt in m/s, as in
/// `textbook 0.2`.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a machine or the name of one")]
enum SavedMachine {
    Named(String),
    Whole(Box<ScaledMachine>),
}

pub fn named_or_whole<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Box<ScaledMachine>>, D::Error> {
    let text = match SavedMachine::deserialize(deserializer)? {
        SavedMachine::Named(text) => text,
        SavedMachine::Whole(scaled) => return Ok(Some(scaled)),
    };
    let (name, speed) = text.split_once(' ').map_or((&*text, None), |(name, it)| (name, Some(it)));
    let machine = library::find(name).map_err(D::Error::custom)?;
    let refused =
        |it| D::Error::custom(format!("\"{it}\" is no speed of its belt: a number of m/s"));
    let speed = speed.map(|it| it.parse().map_err(|_| refused(it))).transpose()?;
    let speed = speed.unwrap_or(machine.belt.belt_speed);
    let scaled = Setting::of_speed(speed).on(machine).map_err(D::Error::custom)?;
    Ok(Some(Box::new(scaled)))
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
            problem.set(*symbol, *value);
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
