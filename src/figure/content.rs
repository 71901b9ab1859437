//! A figure as data.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::model::{Parameters, State};
use crate::picture::{Caption, Dash, Mark, Role, Scale, ScanMap, items};
use crate::scene::{Point, Window};
use crate::words::provenance::Provenance;

/// What plots show, as data.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The name of the scene.
    pub figure: String,
    /// What the scene is called.
    pub title: String,
    /// Name and version of the program.
    pub program: String,
    /// What wrote the figure: program, version, revision and command line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub provenance: Option<Provenance>,
    /// What the numbers are measured in.
    pub units: &'static str,
    /// Parameters of the present motion; curves have their own.
    pub parameters: Parameters,
    /// Where the motion starts.
    pub initial: State,
    /// End time of the motion.
    pub until: f64,
    /// How motions are integrated.
    pub method: String,
    /// Relative error of a step.
    pub tolerance: f64,
    /// One for each plot.
    pub panels: Vec<Panel>,
}

/// A plot, as data.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// What it is called.
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// Lines, from back to front.
    pub curves: Vec<FigureCurve>,
    pub areas: Vec<Area>,
    /// Points with a meaning.
    pub marks: Vec<MarkedPoint>,
    /// What is behind all lines, where the plot is a map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<ScanMap>,
    /// What stands beside the axes: where they are logarithmic, the quantities themselves.
    #[serde(skip)]
    pub names: [String; 2],
    /// What the numbers along both axes stand for.
    #[serde(skip)]
    pub scales: [Scale; 2],
    /// The part of the world on show.
    #[serde(skip)]
    pub window: Window,
    #[serde(skip)]
    pub captions: Vec<Caption>,
    /// What the plot needs, where it can show nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nothing: Option<String>,
    /// Lines to be read against.
    #[serde(skip)]
    pub guides: Vec<Vec<Point>>,
    /// Directions: where, and which way in the world.
    #[serde(skip)]
    pub arrows: Vec<(Point, Point)>,
}

/// An axis: its name, and the values at its ends.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What stands on it.
    pub name: String,
    /// The value at its lower end.
    pub from: f64,
    /// The value at its upper end.
    pub to: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureCurve {
    /// What it is, and which values it has of its own.
    pub name: String,
    pub role: Role,
    /// How it is drawn.
    pub style: Dash,
    /// The parameters that hold all along it; those on an axis of the panel are left out.
    pub parameters: BTreeMap<&'static str, f64>,
    /// Its points; `null` interrupts it.
    pub points: Vec<[f64; 2]>,
    /// What it is, whichever variant it belongs to.
    #[serde(skip)]
    pub kind: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Area {
    pub name: String,
    pub role: Role,
    /// The parameters that hold all over it; those on an axis of the panel are left out.
    pub parameters: BTreeMap<&'static str, f64>,
    /// Its edge. Where this is not closed, the area is the side of it that holds the origin.
    pub edge: Vec<[f64; 2]>,
    /// What it is, whichever variant it belongs to.
    #[serde(skip)]
    pub kind: String,
}

/// A point with a meaning.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MarkedPoint {
    pub name: items::Text,
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// Whether an arrow at the edge of the plot stands for it if it lies above or below.
    #[serde(skip)]
    pub at_edge: bool,
    /// How it is drawn.
    #[serde(skip)]
    pub mark: Mark,
    #[serde(skip)]
    pub role: Role,
}
