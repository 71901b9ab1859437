//! The user's wishes for the screen, as plain data. The outer rings adapt them to the present terminal.

use strum::{IntoStaticStr, VariantArray};

use crate::words::one_of;

/// The characters that form the dots of plots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum Glyphs {
    /// The best that the terminal and its locale can show.
    #[default]
    Auto,
    /// Two by four dots per cell.
    Braille,
    /// Two by four blocks per cell.
    Octant,
    /// Two by two blocks per cell.
    Block,
    Ascii,
}

/// Colour depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum Colors {
    /// What the terminal says it has; no colours if `NO_COLOR` is set.
    #[default]
    Auto,
    /// No colours: markers, dashes, bold and reverse distinguish things.
    Never,
    /// The sixteen colours of the terminal's own palette.
    #[strum(serialize = "16")]
    Sixteen,
    /// The 256 indexed colours.
    #[strum(serialize = "256")]
    Indexed,
    /// Red, green and blue with eight bits each.
    True,
}

/// A set of colours. Most backgrounds are dark, so that the first step to a light one is visible.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum Theme {
    /// The set that suits the background of the terminal.
    #[default]
    Auto,
    Light,
    Dark,
    Contrast,
    /// No colour at all.
    Mono,
}

/// Everything about the appearance that the user can choose.
#[expect(
    clippy::struct_excessive_bools,
    reason = "what is on or off has nothing to do with each other"
)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DisplaySettings {
    /// The characters that form the dots of plots.
    pub glyphs: Glyphs,
    /// Colour depth.
    pub colors: Colors,
    /// Colour depth of the terminal, for what sixteen colours cannot show; `Auto` if unknown.
    pub fine: Colors,
    pub theme: Theme,
    /// Whether the terminal reports the mouse; otherwise the mouse selects text.
    pub mouse: bool,
    /// Whether phase planes fill the space of their plot, so that the units of both axes differ in length.
    pub stretched: bool,
    /// Whether axes of machines have no units.
    pub dimensionless: bool,
    /// Whether the screen is read by a class: one or two plots with wide lines, the outcome in large letters, and nothing
    /// of how it is computed.
    pub lecture: bool,
}

/// A value with a name, of an enumeration in the order in which a key cycles through it.
pub trait NamedValue: VariantArray + Copy + PartialEq + Into<&'static str> {}

impl<T: VariantArray + Copy + PartialEq + Into<&'static str>> NamedValue for T {}

/// All values with their names.
pub fn choices<T: NamedValue>() -> impl Iterator<Item = (&'static str, T)> {
    T::VARIANTS.iter().map(|value| ((*value).into(), *value))
}

/// The value with this name. Fails with one line that names all.
pub fn named<T: NamedValue>(name: &str) -> Result<T, String> {
    one_of("", name, choices())
}

/// The value that follows `current`, and its name; the first one after the last.
pub fn next_of<T: NamedValue>(current: T) -> (T, &'static str) {
    let after = T::VARIANTS.iter().skip_while(|value| **value != current).nth(1);
    let next = *after.unwrap_or(&T::VARIANTS[0]);
    (next, next.into())
}
