//! Mode files: any self-excited vibration mode, by its frequency, its modal mass and a damping ratio that
//! depends on velocity.

use serde::Deserialize;
use toml::Spanned;

use super::file::{Number, StartTable, duration, exact, or_usual, polynomial};
use crate::model::Knob;
use crate::model::Modal;
use crate::scene::misread::{self, Complaint, Misread};

/// A vibration mode, and the start of its motion.
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

/// The file as it is written.
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

/// Whether a text describes a mode: only modes have a modal mass.
pub fn is_mode(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with("modal_mass"))
}

/// Why a mode cannot be drawn.
pub const NO_BELT: &str =
    "a vibration mode has no belt to be drawn; `hopfscope belt FILE` answers about it";

/// Reads a mode; `name` is the name by which it is opened, `file` the one in error messages. Fails with
/// [`Misread`], which names the place and what is allowed there.
pub fn parse(name: &str, file: &str, text: &str) -> Result<Mode, Misread> {
    let read: ModeFile = misread::toml(file, text)?;
    mode(name, &read).map_err(|complaint| complaint.in_file(file, text))
}

fn mode(name: &str, read: &ModeFile) -> Result<Mode, Complaint> {
    let frequency = exact(Knob::Frequency, &read.frequency)?;
    let mass = exact(Knob::ModalMass, &read.modal_mass)?;
    let damping_ratio = polynomial("ratio", read.damping_ratio.get_ref(), exact)?;
    let moving = or_usual(Knob::Friction, read.guide.as_ref())?;
    let at_rest = read.guide_static.as_ref();
    let static_guide = at_rest.map(|given| exact(Knob::StaticGuide, given)).transpose()?;
    let numbers = Modal { frequency, mass, damping_ratio, friction: moving, static_guide };
    numbers
        .model()
        .map_err(|unfit| Complaint { at: read.damping_ratio.span(), message: unfit.to_string() })?;
    let start = read.start.read()?;
    let until = duration(read.until.as_ref(), 1.0 / frequency)?;
    let title = if read.title.is_empty() { name } else { &read.title }.to_owned();
    Ok(Mode { name: name.to_owned(), title, numbers, start, until })
}
