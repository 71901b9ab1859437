//! Figures for papers and for other programs: the pictures of a session as SVG, CSV, JSON and text.
//!
//! A [`Figure`] is what the plots of a session show, with every function sampled and every line a list
//! of points; each form writes the same data, and with it the parameters, method, tolerance and version
//! that it was computed with. The SVG is written here: the plotting libraries at hand round coordinates
//! to whole pixels and have no dashed curves, and a picture of lines and letters needs neither. The PNG is
//! that SVG, painted.

mod captions;
mod chord;
mod data;
mod filled;
mod layout;
mod panel;
#[cfg(feature = "png")]
mod png;
mod region;
mod sample;
mod svg;

pub use chord::FAINT;
pub use data::{csv, json};
pub use svg::svg;

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::flow::Problem;
use crate::oscillator::{Parameters, State};
use crate::scene::{Point, Window};
use crate::session::Session;
use crate::view::look::Role;
use crate::view::picture;
use crate::view::ticks::Scale;

/// The form in which a figure is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A vector picture.
    Svg,
    /// The same picture as dots, [`SCALE`] to a pixel of it.
    Png,
    /// One row a point, all digits.
    Csv,
    /// One JSON document, all digits.
    Json,
}

/// The endings of files, and the forms that they ask for.
const ENDINGS: [(&str, Form); 4] =
    [("svg", Form::Svg), ("png", Form::Png), ("csv", Form::Csv), ("json", Form::Json)];

/// Dots of a PNG along a pixel of the vector picture, which is a 96th of an inch: 288 to the inch.
pub const SCALE: f32 = 3.0;

impl Form {
    /// The form that the ending of a file asks for.
    ///
    /// # Errors
    /// One line with the endings that there are.
    pub fn of_file(path: &Path) -> Result<Form, String> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let form = ENDINGS.iter().find(|(known, _)| known.eq_ignore_ascii_case(ending));
        form.map(|(_, form)| *form)
            .ok_or_else(|| "a figure ends in .svg, .png, .csv or .json".to_owned())
    }
}

/// A figure as the content of a file.
///
/// # Errors
/// One line if the picture cannot be painted; only for [`Form::Png`].
pub fn file(figure: &Figure, form: Form) -> Result<Vec<u8>, String> {
    match form {
        Form::Svg => Ok(svg(figure).into_bytes()),
        Form::Csv => Ok(csv(figure).into_bytes()),
        Form::Json => Ok(json(figure).into_bytes()),
        #[cfg(feature = "png")]
        Form::Png => png::png(&svg(figure)),
        #[cfg(not(feature = "png"))]
        Form::Png => {
            Err("this program was built without .png; .svg, .csv and .json are there".into())
        }
    }
}

/// What all numbers of a figure are measured in.
const UNITS: &str =
    "dimensionless, as in equation (4): time tau in 1/omega_0, q in x0, v in omega_0 x0";

/// What plots show, as data.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The name of the scene.
    pub figure: String,
    /// What the scene is called.
    pub title: String,
    /// Name and version of the program.
    pub program: String,
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
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Lines, from back to front.
    pub curves: Vec<Curve>,
    /// Shaded areas.
    pub areas: Vec<Area>,
    /// Points with a meaning.
    pub marks: Vec<Mark>,
    /// What stands beside the axes: where they are logarithmic, the quantities themselves.
    #[serde(skip)]
    pub names: [String; 2],
    /// What the numbers along both axes stand for.
    #[serde(skip)]
    pub scales: [Scale; 2],
    /// The part of the world on show.
    #[serde(skip)]
    pub window: Window,
    /// Texts beside points.
    #[serde(skip)]
    pub captions: Vec<Caption>,
    /// Lines to be read against.
    #[serde(skip)]
    pub guides: Vec<Vec<Point>>,
    /// Directions: where, and which way in the world.
    #[serde(skip)]
    pub arrows: Vec<(Point, Point)>,
}

/// A text beside a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// The point.
    pub at: Point,
    /// Points beside which it says the same.
    pub or_at: Vec<Point>,
    /// What it says.
    pub text: String,
    /// What it says where the text would cover a curve.
    pub short: String,
    /// What it stands for.
    pub role: Role,
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

/// A line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// What it is, and which values it has of its own.
    pub name: String,
    /// What it stands for.
    pub role: &'static str,
    /// How it is drawn: solid, dashed, dotted, sparse or thick.
    pub style: &'static str,
    /// The parameters that hold all along it; those on an axis of the panel are left out.
    pub parameters: BTreeMap<&'static str, f64>,
    /// Its points; `null` interrupts it.
    pub points: Vec<[f64; 2]>,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

/// A shaded area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Area {
    /// What it is.
    pub name: String,
    /// What it stands for.
    pub role: &'static str,
    /// The parameters that hold all over it; those on an axis of the panel are left out.
    pub parameters: BTreeMap<&'static str, f64>,
    /// Its edge. Where this is not closed, the area is the side of it that holds the origin.
    pub edge: Vec<[f64; 2]>,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

/// A point with a meaning.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// What it says.
    pub name: picture::Text,
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// How it is drawn.
    #[serde(skip)]
    pub mark: picture::Mark,
    /// What it stands for.
    #[serde(skip)]
    pub pen: Role,
}

impl Figure {
    /// What these plots of a session show.
    #[must_use]
    pub fn of(session: &Session, plots: impl IntoIterator<Item = usize>) -> Self {
        let Problem { parameters, initial, until, method, tolerance, .. } = session.problem;
        Figure {
            figure: session.scene.name.clone(),
            title: session.scene.title.clone(),
            program: format!("hopfscope {}", env!("CARGO_PKG_VERSION")),
            units: UNITS,
            parameters,
            initial,
            until,
            method: method.to_string(),
            tolerance,
            panels: plots.into_iter().map(|plot| Panel::of(session, plot)).collect(),
        }
    }
}
