//! The user's wishes for the screen, as plain data. The outer rings adapt them to the present terminal.

/// The characters that form the dots of plots.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Colors {
    /// What the terminal says it has; no colours if `NO_COLOR` is set.
    #[default]
    Auto,
    /// No colours: markers, dashes, bold and reverse distinguish things.
    Never,
    /// The sixteen colours of the terminal's own palette.
    Sixteen,
    /// The 256 indexed colours.
    Indexed,
    /// Red, green and blue with eight bits each.
    True,
}

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// The set that suits the background of the terminal.
    #[default]
    Auto,
    Dark,
    Light,
    Contrast,
    /// No colour at all.
    Mono,
}

/// The glyph modes, in the order in which the key cycles through them.
pub const GLYPHS: [(Glyphs, &str); 5] = [
    (Glyphs::Auto, "auto"),
    (Glyphs::Braille, "braille"),
    (Glyphs::Octant, "octant"),
    (Glyphs::Block, "block"),
    (Glyphs::Ascii, "ascii"),
];

/// The colour depths, with their names on the command line.
pub const COLORS: [(Colors, &str); 5] = [
    (Colors::Auto, "auto"),
    (Colors::Never, "never"),
    (Colors::Sixteen, "16"),
    (Colors::Indexed, "256"),
    (Colors::True, "true"),
];

/// The themes, in the order in which the key cycles through them. Most backgrounds are dark, so `light` comes
/// after `auto`: the first step is then visible.
pub const THEMES: [(Theme, &str); 5] = [
    (Theme::Auto, "auto"),
    (Theme::Light, "light"),
    (Theme::Dark, "dark"),
    (Theme::Contrast, "contrast"),
    (Theme::Mono, "mono"),
];

/// Everything about the appearance that the user can choose.
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
}

/// The value and name that follow `current` in a table such as [`GLYPHS`]; the first ones after the last.
pub fn next_of<T: Copy + PartialEq>(table: &[(T, &'static str)], current: T) -> (T, &'static str) {
    let index = table.iter().position(|(value, _)| *value == current).unwrap_or(0);
    table[(index + 1) % table.len()]
}

/// The value with this name in a table such as [`COLORS`].
pub fn named<T: Copy>(table: &[(T, &'static str)], name: &str) -> Option<T> {
    table.iter().find(|(_, row)| *row == name).map(|(value, _)| *value)
}
