//! The file of a saved session.

use std::collections::{BTreeMap, BTreeSet};

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::flow::Problem;
use crate::model::State;
use crate::portrait::kicks::RandomKick;
use crate::scene::{Arrangement, Axes, Layer, PlotSetup, Point, Scene, Setting, View, Window};
use crate::session::state::{Framing, StepSizes, Uncertainty};

/// The format that this program writes; it reads this and all earlier formats.
pub const VERSION: u32 = 1;

/// The file of a saved session.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedSession {
    pub hopfscope: u32,
    /// The selected row of the parameter pane, by its name.
    pub selected: String,
    /// The pane in focus: 0 for the parameters, then the plots.
    pub focus: usize,
    /// The plot in use, from 1.
    pub plot: usize,
    pub enlarged: bool,
    pub unfolded: bool,
    pub harmonics: usize,
    #[serde(default)]
    pub kicks: RandomKick,
    /// Lines typed on the command line, the most recent last.
    pub lines: Vec<String>,
    pub present: Show,
    pub plots: Vec<SavedPlot>,
    #[serde(default)]
    pub marks: BTreeMap<char, Problem>,
    /// The settings of the machine at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub belts: BTreeMap<char, Setting>,
    /// The starts of the other motions at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub beside: BTreeMap<char, Vec<State>>,
    /// What is not known exactly at marks.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub doubts: BTreeMap<char, Uncertainty>,
    /// The motion of the point that was left last.
    pub left: Option<Problem>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_beside: Vec<State>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_belt: Option<Setting>,
    #[serde(default, skip_serializing_if = "Uncertainty::is_none")]
    pub left_doubt: Uncertainty,
    /// Recorded keys of earlier versions, which are dropped.
    #[serde(default, skip_serializing)]
    #[expect(dead_code, reason = "a file that has them is still read")]
    pub registers: IgnoredAny,
    #[serde(default)]
    pub past: Vec<SavedChange>,
    #[serde(default)]
    pub future: Vec<SavedChange>,
}

/// A scene, by its name if it is built in, otherwise in full.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
pub enum SavedScene {
    Library(String),
    Full(Box<Scene>),
}

/// Everything that a scene determines, at present or before a change.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Show {
    pub arrangement: Arrangement,
    pub layers: BTreeSet<Layer>,
    pub steps: StepSizes,
    pub motion: Problem,
    /// Starts of the other motions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<State>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub belt: Option<Setting>,
    #[serde(default, skip_serializing_if = "Uncertainty::is_none")]
    pub doubt: Uncertainty,
    pub scene: SavedScene,
}

/// A plot with its window and cursor.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedPlot {
    pub view: View,
    pub framing: Framing,
    pub axes: Axes,
    pub window: Window,
    pub cursor: Option<Point>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
}

/// A change that can be undone or redone: the state on its other side.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SavedChange {
    Motion(Problem),
    MotionOnBelt {
        motion: Problem,
        belt: Setting,
    },
    Motions {
        motion: Problem,
        beside: Vec<State>,
        belt: Option<Setting>,
        #[serde(default, skip_serializing_if = "Uncertainty::is_none")]
        doubt: Uncertainty,
    },
    Plots {
        arrangement: Arrangement,
        plots: Vec<PlotSetup>,
    },
    Scene {
        plots: Vec<PlotSetup>,
        show: Box<Show>,
    },
}
