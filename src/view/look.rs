//! How things look: a theme, a set of glyphs and a depth of colour, resolved into one table of styles.
//!
//! Themes are data (`assets/themes/*.toml`): one line for each [`Role`], with one of the terminal's 16
//! colours, attributes, and a finer colour for terminals that have more. Without colour the attributes
//! remain, and every distinction that matters is also made by marker, dash or text.

use std::fmt;
use std::str::FromStr;

use ratatui::style::{Color, Modifier, Style};

use crate::picture::role::{ROLES, Role};
use crate::session::settings::{self, Colors, Glyphs, Theme};

/// The text of a theme that comes with the program.
fn text_of(theme: Theme) -> &'static str {
    match theme {
        Theme::Dark => include_str!("../../assets/themes/dark.toml"),
        Theme::Light => include_str!("../../assets/themes/light.toml"),
        Theme::Contrast => include_str!("../../assets/themes/contrast.toml"),
        Theme::Mono => include_str!("../../assets/themes/mono.toml"),
    }
}

/// Symbols that exist in a plain and in a letters-only form.
#[derive(Clone, Copy, Debug)]
pub struct Symbols {
    /// Marks the selected row.
    pub pointer: &'static str,
    pub plus_minus: &'static str,
    /// Separates remarks on a line.
    pub dot: &'static str,
    /// A cut text goes on.
    pub more: &'static str,
    pub rule: &'static str,
    pub upright: &'static str,
    /// Corner of an axis: vertical line, tick on it, corner, horizontal line, tick on it.
    pub axis: [&'static str; 5],
    /// Where a motion starts.
    pub start: char,
    /// Where a motion came to rest.
    pub rest: char,
    /// Where a motion is at its end time.
    pub head: char,
    /// A stable and an unstable point.
    pub points: [char; 2],
    /// Corners and sides of a box: top left, top right, bottom left, bottom right.
    pub corners: [&'static str; 4],
    /// Direction of motion, from east counter-clockwise in eighths of a turn.
    pub arrows: [char; 8],
    pub shade: char,
    /// Cross of the cursor, and its horizontal and vertical arms.
    pub cross: [char; 3],
}

const RICH: Symbols = Symbols {
    pointer: "▸",
    plus_minus: "±",
    dot: "·",
    more: "…",
    rule: "─",
    upright: "│",
    axis: ["│", "┤", "└", "─", "┴"],
    start: '○',
    rest: '■',
    head: '●',
    points: ['●', '○'],
    corners: ["┌", "┐", "└", "┘"],
    arrows: ['→', '↗', '↑', '↖', '←', '↙', '↓', '↘'],
    shade: '·',
    cross: ['┼', '─', '│'],
};

const LETTERS: Symbols = Symbols {
    pointer: ">",
    plus_minus: "+-",
    dot: "|",
    more: "~",
    rule: "-",
    upright: "|",
    axis: ["|", "+", "+", "-", "+"],
    start: 'S',
    rest: 'X',
    head: '@',
    points: ['#', 'o'],
    corners: ["+", "+", "+", "+"],
    arrows: ['>', '/', '^', '\\', '<', '/', 'v', '\\'],
    shade: '.',
    cross: ['+', '-', '|'],
};

/// A theme that cannot be used, and where it is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ThemeError {
    /// Not a TOML table of texts; the message has line and column.
    Syntax(String),
    /// A role that does not exist.
    Role(String),
    /// A role without a line.
    Missing(&'static str),
    /// A word that is neither a colour nor an attribute.
    Word { role: &'static str, word: String },
}

impl fmt::Display for ThemeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ThemeError::Syntax(message) => write!(out, "theme: {message}"),
            ThemeError::Role(role) => write!(out, "theme: {role:?} is nothing that has a style"),
            ThemeError::Missing(role) => write!(out, "theme: {role} has no style"),
            ThemeError::Word { role, word } => write!(
                out,
                "theme: {role}: {word:?} is no colour (red, light-red, #ff8800, default), \
                 and not bold, dim, italic, underlined or reversed"
            ),
        }
    }
}

impl std::error::Error for ThemeError {}

/// Everything that decides how the screen looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// How curves and symbols are drawn.
    pub glyphs: Glyphs,
    styles: [Style; ROLES.len()],
}

impl Look {
    /// The look that these settings ask for; what they leave open becomes braille in 16 colours.
    pub fn new(settings: settings::Look) -> Self {
        let settings::Look { glyphs, colors, theme, .. } = settings;
        // A test reads every theme, so the plain look never serves.
        Look::from_text(text_of(theme), glyphs, colors)
            .unwrap_or(Look { glyphs, styles: [Style::new(); ROLES.len()] })
    }

    /// The look that a theme file describes.
    ///
    /// # Errors
    /// [`ThemeError`] names the line, the role or the word that is wrong.
    pub fn from_text(text: &str, glyphs: Glyphs, colors: Colors) -> Result<Self, ThemeError> {
        let lines: std::collections::BTreeMap<String, String> =
            toml::from_str(text).map_err(|error| ThemeError::Syntax(error.to_string()))?;
        if let Some(role) = lines.keys().find(|key| ROLES.iter().all(|(_, name, _)| name != key)) {
            return Err(ThemeError::Role(role.clone()));
        }
        let mut styles = [Style::new(); ROLES.len()];
        for (style, (_, role, _)) in styles.iter_mut().zip(ROLES) {
            let words = lines.get(role).ok_or(ThemeError::Missing(role))?;
            *style = style_from(words, colors)
                .map_err(|word| ThemeError::Word { role, word: word.into() })?;
        }
        Ok(Look { glyphs, styles })
    }

    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        self.styles[role as usize]
    }

    /// The letter that draws the curves of a role where there are no dots.
    pub fn letter(&self, role: Role) -> char {
        ROLES[role as usize].2
    }

    /// The symbols of this set of glyphs.
    pub fn symbols(&self) -> &'static Symbols {
        if self.glyphs == Glyphs::Ascii { &LETTERS } else { &RICH }
    }
}

/// Reads a style such as `red bold #ff7b72`: the finer colour serves where the terminal has more
/// than 16. Returns the word that it does not know.
fn style_from(words: &str, colors: Colors) -> Result<Style, &str> {
    let mut style = Style::new();
    let mut fine = None;
    for word in words.split_whitespace() {
        match word {
            "default" => {}
            "bold" => style = style.add_modifier(Modifier::BOLD),
            "dim" => style = style.add_modifier(Modifier::DIM),
            "italic" => style = style.add_modifier(Modifier::ITALIC),
            "underlined" => style = style.add_modifier(Modifier::UNDERLINED),
            "reversed" => style = style.add_modifier(Modifier::REVERSED),
            colour => match Color::from_str(colour).map_err(|_| colour)? {
                Color::Rgb(red, green, blue) => fine = Some((red, green, blue)),
                basic => style = style.fg(basic),
            },
        }
    }
    match (colors, fine) {
        (Colors::Never, _) => style.fg = None,
        // A finer colour is quiet by itself where the 16 colours need the attribute.
        (Colors::Indexed, Some(rgb)) => style = style.fg(Color::Indexed(nearest(rgb))),
        (Colors::True, Some((red, green, blue))) => style = style.fg(Color::Rgb(red, green, blue)),
        _ => return Ok(style),
    }
    if fine.is_some() && colors != Colors::Never {
        style.add_modifier.remove(Modifier::DIM);
    }
    Ok(style)
}

/// The nearest of xterm's 240 fixed colours: a cube of 6 levels a side and a ramp of 24 greys.
fn nearest((red, green, blue): (u8, u8, u8)) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |other: (u8, u8, u8)| {
        let part = |a: u8, b: u8| u32::from(a.abs_diff(b)).pow(2);
        part(red, other.0) + part(green, other.1) + part(blue, other.2)
    };
    let of_index = |index: u8| {
        if index < 216 {
            let level = |place: u8| LEVELS[usize::from(index / place % 6)];
            (level(36), level(6), level(1))
        } else {
            let grey = 8 + 10 * (index - 216);
            (grey, grey, grey)
        }
    };
    16 + (0..240).min_by_key(|index| distance(of_index(*index))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::settings::THEMES;

    fn look(theme: Theme, glyphs: Glyphs, colors: Colors) -> Look {
        Look::new(settings::Look { glyphs, colors, theme, ..settings::Look::default() })
    }

    #[test]
    fn every_theme_gives_every_role_a_style() {
        for (theme, name) in THEMES {
            let read = Look::from_text(text_of(theme), Glyphs::Braille, Colors::Sixteen);
            assert!(read.is_ok(), "{name}: {read:?}");
        }
    }

    #[test]
    fn each_depth_has_its_own_colours_and_no_others() {
        for (theme, name) in THEMES {
            let colours = |colors| {
                let look = look(theme, Glyphs::Braille, colors);
                look.styles.into_iter().filter_map(|style| style.fg).collect::<Vec<_>>()
            };
            assert_eq!(colours(Colors::Never), [], "{name}");
            let fine = |colour: &Color| matches!(colour, Color::Rgb(..) | Color::Indexed(_));
            assert!(!colours(Colors::Sixteen).iter().any(fine), "{name}");
            assert!(colours(Colors::True).iter().all(|colour| matches!(colour, Color::Rgb(..))));
        }
    }

    #[test]
    fn letters_tell_what_colours_tell() {
        let look = look(Theme::Mono, Glyphs::Ascii, Colors::Never);
        let pens = [Role::Trajectory, Role::Stable, Role::Unstable, Role::Harmonic, Role::Lyapunov];
        for (index, one) in pens.iter().enumerate() {
            assert!(pens[..index].iter().all(|other| look.letter(*other) != look.letter(*one)));
        }
        assert!(ROLES.iter().all(|(_, _, letter)| letter.is_ascii()));
    }

    #[test]
    fn curves_that_meet_in_a_plot_have_colours_of_their_own() {
        let diagram = [
            Role::Stable,
            Role::Unstable,
            Role::Harmonic,
            Role::Asymptote,
            Role::Velocity,
            Role::Current,
        ];
        let time_series = [Role::Trajectory, Role::Velocity, Role::Sticking, Role::Energy];
        for (theme, name) in THEMES.into_iter().filter(|(theme, _)| *theme != Theme::Mono) {
            for colors in [Colors::Sixteen, Colors::Indexed, Colors::True] {
                let look = look(theme, Glyphs::Braille, colors);
                for pens in [&diagram[..], &time_series] {
                    let mut seen: Vec<_> = pens.iter().map(|pen| look.style(*pen).fg).collect();
                    seen.sort_by_key(|colour| format!("{colour:?}"));
                    seen.dedup();
                    assert_eq!(seen.len(), pens.len(), "{name} {colors:?}: {seen:?}");
                }
            }
        }
    }

    #[test]
    fn a_wrong_theme_says_what_is_wrong() {
        let refused = |text: &str| {
            Look::from_text(text, Glyphs::Braille, Colors::Sixteen).unwrap_err().to_string()
        };
        assert!(refused("text = 3").contains("line 1"), "{}", refused("text = 3"));
        assert!(refused("tex = 'red'").contains("\"tex\""));
        assert!(refused("text = 'default'").contains("quiet"));
        let full = text_of(Theme::Dark).replace("stable = \"", "stable = \"mauve ");
        assert!(refused(&full).contains("\"mauve\""), "{}", refused(&full));
    }

    #[test]
    fn fixed_colours_are_their_own_nearest() {
        for (rgb, index) in
            [((0, 0, 0), 16), ((255, 255, 255), 231), ((95, 135, 175), 67), ((238, 238, 238), 255)]
        {
            assert_eq!(nearest(rgb), index);
        }
    }
}
