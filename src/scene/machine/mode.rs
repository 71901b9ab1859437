//! Mode files: any self-excited vibration mode, by its frequency, its modal mass and a damping ratio that
//! depends on velocity.

use serde::Deserialize;
use toml::Spanned;

use super::file::{FARTHEST_START, Number, StartTable, UNTIL_RANGE, number, quantity_as};
use crate::machine::Modal;
use crate::oscillator::belt::{Dimension, Quantity};
use crate::scene::misread::{self, Complaint, Misread};

/// A vibration mode, and the motion of it that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// The name by which it is opened.
    pub name: String,
    pub title: String,
    pub numbers: Modal,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    /// How long the motion is followed, in s.
    pub until: f64,
}

/// The file as it stands on disk.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ModeFile {
    #[serde(default)]
    title: String,
    #[serde(default, rename = "look")]
    _look: String,
    frequency: Spanned<Number>,
    modal_mass: Spanned<Number>,
    damping_ratio: Spanned<Vec<Spanned<Number>>>,
    #[serde(rename = "R")]
    guide: Option<Spanned<Number>>,
    #[serde(rename = "R_static")]
    guide_static: Option<Spanned<Number>>,
    #[serde(default)]
    start: StartTable,
    until: Option<Spanned<Number>>,
}

/// Whether a text is that of a mode: no machine has a modal mass.
pub fn is_mode(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with("modal_mass"))
}

/// Why a mode is not drawn.
pub const NO_BELT: &str =
    "a vibration mode has no belt to be drawn; `hopfscope belt FILE` answers about it";

/// Reads a mode; `name` is the name by which it is opened, `file` the one in error messages. Fails with [`Misread`]
/// with the place and what is allowed there.
pub fn parse(name: &str, file: &str, text: &str) -> Result<Mode, Misread> {
    let read: ModeFile = misread::toml(file, text)?;
    mode(name, &read).map_err(|complaint| complaint.in_file(file, text))
}

fn mode(name: &str, read: &ModeFile) -> Result<Mode, Complaint> {
    /// Frequencies of a mode, in 1/s.
    const FREQUENCIES: (f64, f64) = (1e-9, 1e12);
    /// Periods for which a motion is followed where a file says nothing.
    const PERIODS: f64 = 20.0;
    let rate = Dimension::new(0, 0, -1);
    let frequency = number("frequency", Some(&read.frequency), rate, "1/s", FREQUENCIES, 1.0)?;
    let mass = quantity_as("modal_mass", Quantity::Mass, &read.modal_mass)?;
    let any = (-1e12, 1e12);
    let ratio = |(power, given): (usize, &Spanned<Number>)| {
        let power = i8::try_from(power).unwrap_or(i8::MAX);
        let slowness = Dimension::ONE.times(Dimension::new(0, -1, 1), power);
        let unit = if power == 0 { String::new() } else { format!("s^{power}/m^{power}") };
        number("damping_ratio", Some(given), slowness.unwrap_or(Dimension::ONE), &unit, any, 0.0)
    };
    let ratios = read.damping_ratio.get_ref().iter().enumerate().map(ratio);
    let ratios: Vec<f64> = ratios.collect::<Result<_, _>>()?;
    let guide = |given| quantity_as("R", Quantity::Friction, given);
    let moving = read.guide.as_ref().map(guide).transpose()?.unwrap_or(0.0);
    let static_guide = read.guide_static.as_ref().map(guide).transpose()?;
    let numbers = Modal { frequency, mass, damping_ratio: ratios, friction: moving, static_guide };
    numbers
        .model()
        .map_err(|unfit| Complaint { at: read.damping_ratio.span(), message: unfit.to_string() })?;
    let far = (-FARTHEST_START, FARTHEST_START);
    let x = number("x", read.start.x.as_ref(), Dimension::LENGTH, "m", far, 0.0)?;
    let v = number("v", read.start.v.as_ref(), Dimension::VELOCITY, "m/s", far, 0.0)?;
    let periods = PERIODS / frequency;
    let until = number("until", read.until.as_ref(), Dimension::TIME, "s", UNTIL_RANGE, periods)?;
    let title = if read.title.is_empty() { name } else { &read.title }.to_owned();
    Ok(Mode { name: name.to_owned(), title, numbers, start: (x, v), until })
}
