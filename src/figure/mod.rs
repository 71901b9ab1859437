//! Figures for papers and for other programs: the pictures of a session as SVG, CSV, JSON and text.
//!
//! A [`Figure`] is what the plots of a session show, with every function sampled and every line a list
//! of points; each form writes the same data, and with it the parameters, method, tolerance and version
//! that it was computed with. A picture is first a page of [`elements`], which SVG, PDF and PNG write alike; plotting
//! libraries for Rust round coordinates to whole pixels and have no dashed curves.

mod areas;
mod axes;
mod captions;
mod content;
mod data;
mod elements;
mod facts;
mod inks;
mod legend;
mod letters;
mod lines;
mod map;
#[cfg(feature = "print")]
mod outlines;
mod page;
mod panel;
mod paper;
#[cfg(feature = "print")]
mod pdf;
#[cfg(feature = "print")]
mod png;
mod svg;
mod symbols;

pub use content::{Axis, Figure, MarkedPoint, Outline, Panel};
pub use facts::facts;
pub use lines::FAINT;
pub use symbols::{LetterStyle, runs};

use std::path::Path;

use clap::ValueEnum;
use strum::EnumString;

use data::csv;
use svg::svg;

use crate::fit::{FitResult, OMEGA0, parameters};
use crate::flow::Problem;
use crate::model::{Group, Knob, State};
use crate::picture;
use crate::picture::fit::pictures;
use crate::report::json::text;
use crate::scene::{ScaledMachine, Sheet};
use crate::session::read::completion::difference;
use crate::session::{Key, Session};
use crate::words::provenance::Provenance;
use crate::words::{joined, significant};

/// How a figure is written: the ending of its file, or the format on standard output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumString, ValueEnum)]
#[strum(serialize_all = "lowercase", ascii_case_insensitive)]
pub enum FigureForm {
    /// Drawn with characters.
    #[strum(disabled)]
    Text,
    /// One JSON document, all digits; what is not a number is `null`.
    Json,
    /// One row per point, all digits.
    Csv,
    /// A vector picture.
    Svg,
    /// The same picture, its letters in fonts that come with it.
    #[value(skip)]
    Pdf,
    /// The same picture as dots.
    #[value(skip)]
    Png,
}

impl FigureForm {
    /// The form that the ending of a file asks for. Fails with one line with the endings that there are.
    pub fn of_file(path: &Path) -> Result<FigureForm, String> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        ending.parse().map_err(|_| "a figure ends in .pdf, .svg, .png, .csv or .json".to_owned())
    }
}

/// A figure as the content of a file. Fails with one line if the picture cannot be painted; only for [`FigureForm::Png`],
/// and for [`FigureForm::Text`], which is for what is drawn by a screen.
pub fn file(figure: &Figure, form: FigureForm) -> Result<Vec<u8>, String> {
    match form {
        FigureForm::Svg => Ok(svg(&page::page(figure), figure, "plot").into_bytes()),
        FigureForm::Csv => Ok(csv(figure).into_bytes()),
        FigureForm::Json => Ok(text(figure).into_bytes()),
        #[cfg(feature = "print")]
        FigureForm::Pdf => pdf::pdf(&page::page(figure), figure),
        #[cfg(feature = "print")]
        FigureForm::Png => png::png(&page::page(figure), figure),
        FigureForm::Text => Err("the screen draws it with characters".into()),
        #[cfg(not(feature = "print"))]
        FigureForm::Pdf | FigureForm::Png => {
            Err("this program was built without .pdf and .png; .svg, .csv and .json are there"
                .into())
        }
    }
}

/// Each panel as SVG of its own with its part of the legend, so that a page of any width can hold them.
pub fn panels(figure: &Figure) -> Vec<String> {
    // Its own title is enough.
    let alone = |panel: &Panel| Figure {
        title: String::new(),
        panels: vec![panel.clone()],
        sheet: Sheet::default(),
        ..figure.clone()
    };
    let written = |(number, panel): (usize, &Panel)| {
        let (figure, title) = (alone(panel), panel.title.clone());
        svg(&page::page(&figure), &Figure { title, ..figure }, &format!("panel{number}"))
    };
    figure.panels.iter().enumerate().map(written).collect()
}

/// What draws it.
const PROGRAM: &str = concat!("hopfscope ", env!("CARGO_PKG_VERSION"));

/// What all numbers of a figure are measured in.
const UNITS: &str =
    "dimensionless, as in equation (4): time tau in 1/omega_0, q in x0, v in omega_0 x0";

fn panel(session: &Session, plot: usize) -> Panel {
    let mut picture = picture::of(session, plot);
    if session.has_equal_units(plot) {
        picture.window = picture.window.with_equal_units(elements::PLOT.0, elements::PLOT.1);
    }
    let nothing = session.nothing(plot).filter(|_| picture.map.is_none() && !picture.draws());
    let nothing = nothing.map(|text| session.keymap.fill(&text, Key::said));
    Panel { nothing, ..Panel::of(&picture) }
}

/// What the title adds where A stands beside B: the numbers of each that differ.
fn beside(session: &Session) -> String {
    let setups = session.sides().map(|sides| sides.map(|(letter, of)| (letter, of.setup())));
    let Some([(a, first), (b, second)]) = setups.filter(|[(_, a), (_, b)]| a != b) else {
        return String::new();
    };
    format!("; {a}: {}; {b}: {}", difference(&second, &first), difference(&first, &second))
}

/// The numbers of a machine and of its motion, in SI units.
fn numbers(ScaledMachine { machine, reduced }: &ScaledMachine, problem: &Problem) -> String {
    let (Problem { initial: State { q, v }, until, .. }, units) = (problem, &reduced.units);
    let knobs = [Group::Machine, Group::Law].into_iter().flat_map(Group::knobs);
    let belt = knobs.filter_map(|knob| Some((knob, knob.of_belt(&machine.belt)?)));
    let course = [
        (Knob::X, q * units.displacement),
        (Knob::V, v * units.velocity),
        (Knob::Duration, until * units.time),
    ];
    let told = |(knob, value): (Knob, f64)| {
        let spec = knob.spec();
        format!("{} = {} {}", spec.name, significant(value, 12), spec.unit)
    };
    let numbers = belt.chain(course).map(told);
    joined(numbers.map(|number| number.trim_end().to_owned()), ", ")
}

impl Figure {
    /// The same, which says what wrote it.
    pub fn from(self, provenance: Provenance) -> Self {
        Figure { provenance: Some(provenance), ..self }
    }

    /// What these plots of a session show.
    pub fn of(session: &Session, plots: impl IntoIterator<Item = usize>) -> Self {
        let Problem { parameters, initial, until, method, tolerance, .. } = session.problem;
        Figure {
            figure: session.scene.name.clone(),
            title: format!("{}{}", session.scene.title, beside(session)),
            program: PROGRAM,
            provenance: None,
            units: match session.running() {
                Some(_) => format!("{UNITS}; what goes over numbers of the machine in SI units"),
                None => UNITS.to_owned(),
            },
            parameters,
            machine: session.running().map(|scaled| numbers(scaled, &session.problem)),
            initial,
            until,
            method: method.to_string(),
            tolerance,
            sheet: session.scene.sheet.clone(),
            panels: plots.into_iter().map(|plot| panel(session, plot)).collect(),
        }
    }

    /// What a fitted record shows.
    pub fn of_fit(fitted: &FitResult) -> Self {
        let estimate = &fitted.estimate;
        let p = &estimate.p;
        Figure {
            figure: "fit".into(),
            title: format!("{}: fitted motion", fitted.name),
            program: PROGRAM,
            provenance: None,
            units:
                "lengths in the unit of the record, times in s, velocities and impulses over omega0"
                    .into(),
            parameters: parameters(p),
            machine: None,
            initial: estimate.start.beginning(p, &[]).1,
            until: p[OMEGA0] * estimate.data.duration(),
            method: "half swings with exact derivatives".into(),
            tolerance: 1e-13,
            sheet: Sheet::default(),
            panels: pictures(fitted).iter().map(Panel::of).collect(),
        }
    }
}
