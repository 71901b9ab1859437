//! What the user wishes of the screen, as plain data. The outer rings fit it to the present terminal.

/// How points are made of characters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Glyphs {
    /// What the terminal and its locale can show.
    #[default]
    Auto,
    /// Two by four dots a cell.
    Braille,
    /// Two by four blocks a cell.
    Octant,
    /// Two by two blocks a cell.
    Block,
    Ascii,
}

/// How many colours to use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Colors {
    /// What the terminal says it has; none if `NO_COLOR` is set.
    #[default]
    Auto,
    /// None: markers, dashes, bold and reverse tell things apart.
    Never,
    /// The sixteen colours of the terminal's own palette.
    Sixteen,
    /// The 256 indexed colours.
    Indexed,
    /// Red, green and blue of eight bits each.
    True,
}

/// A set of colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// What suits the background of the terminal.
    #[default]
    Auto,
    Dark,
    Light,
    Contrast,
    /// No colour at all.
    Mono,
}

/// The glyph modes, in the order in which the key visits them.
pub const GLYPHS: [(Glyphs, &str); 5] = [
    (Glyphs::Auto, "auto"),
    (Glyphs::Braille, "braille"),
    (Glyphs::Octant, "octant"),
    (Glyphs::Block, "block"),
    (Glyphs::Ascii, "ascii"),
];

/// The colour depths, with the names of the command line.
pub const COLORS: [(Colors, &str); 5] = [
    (Colors::Auto, "auto"),
    (Colors::Never, "never"),
    (Colors::Sixteen, "16"),
    (Colors::Indexed, "256"),
    (Colors::True, "true"),
];

/// The themes, in the order in which the key visits them: most backgrounds are dark, so that the first step
/// from `auto` changes what is seen.
pub const THEMES: [(Theme, &str); 5] = [
    (Theme::Auto, "auto"),
    (Theme::Light, "light"),
    (Theme::Dark, "dark"),
    (Theme::Contrast, "contrast"),
    (Theme::Mono, "mono"),
];

/// Everything about the looks that the user can choose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wishes {
    /// How points are made of characters.
    pub glyphs: Glyphs,
    /// How many colours to use.
    pub colors: Colors,
    /// How many the terminal has, for what sixteen cannot show; `Auto` where that is not known.
    pub fine: Colors,
    pub theme: Theme,
    /// Whether the terminal reports the mouse; without, it selects text.
    pub mouse: bool,
    /// Whether phase planes fill their place, a unit across not as long as a unit up.
    pub stretched: bool,
    /// Whether axes of machines are without units.
    pub dimensionless: bool,
}

/// The value and name that follow `current` in a table such as [`GLYPHS`], around the end.
pub fn next_of<T: Copy + PartialEq>(table: &[(T, &'static str)], current: T) -> (T, &'static str) {
    let index = table.iter().position(|(value, _)| *value == current).unwrap_or(0);
    table[(index + 1) % table.len()]
}

/// The value with this name in a table such as [`COLORS`].
pub fn named<T: Copy>(table: &[(T, &'static str)], name: &str) -> Option<T> {
    table.iter().find(|(_, row)| *row == name).map(|(value, _)| *value)
}
