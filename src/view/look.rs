//! How things look: a theme, a set of glyphs and a depth of colour, resolved into one table of styles.
//!
//! Symbols are data (`assets/glyphs.toml`), and so are themes (`assets/themes/*.toml`): one line for each [`Role`],
//! with one of the terminal's 16 colours, attributes, and a finer colour for terminals that have more. Without colour
//! the attributes remain, and every distinction that matters is also made by marker, dash or text.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::LazyLock;

use ratatui::style::{Color, Modifier, Style};
use ratatui::text::Span;
use serde::Deserialize;
use strum::VariantArray;

use crate::numerics::truncated;
use crate::picture::{Mark, Role};
use crate::scene::placed;
use crate::session::{Code, Colors, DisplaySettings, Glyphs, Key, Keymap, Theme};

/// The text of a theme that comes with the program.
fn text_of(theme: Theme) -> &'static str {
    match theme {
        Theme::Auto | Theme::Dark => include_str!("../../assets/themes/dark.toml"),
        Theme::Light => include_str!("../../assets/themes/light.toml"),
        Theme::Contrast => include_str!("../../assets/themes/contrast.toml"),
        Theme::Mono => include_str!("../../assets/themes/mono.toml"),
    }
}

/// The symbols of one set of glyphs.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Symbols {
    /// Marks the selected row.
    pub pointer: String,
    pub plus_minus: String,
    /// Separates remarks on a line.
    pub dot: String,
    /// A cut text continues.
    pub more: String,
    /// Corner of an axis: vertical line, tick on it, corner, horizontal line, tick on it.
    pub axis: [String; 5],
    /// Marks, in the order of [`Mark`].
    marks: [char; 9],
    /// Direction of motion, from east counter-clockwise in eighths of a turn.
    pub arrows: [char; 8],
    pub shade: char,
    /// Of the gauge of a kick: the bar, its end, what is beyond, the margin, the guaranteed one.
    pub gauge: [char; 5],
    /// Cross of the cursor, and its horizontal and vertical arms.
    pub cross: [char; 3],
}

/// The content of `assets/glyphs.toml`: symbols as Unicode and as ASCII characters, and the letters of curves.
#[derive(Debug, Default, Deserialize)]
struct GlyphSets {
    rich: Symbols,
    letters: Symbols,
    curves: BTreeMap<String, char>,
}

/// A test reads the file, so the empty sets never serve.
static SETS: LazyLock<GlyphSets> = LazyLock::new(|| {
    placed::toml("", include_str!("../../assets/glyphs.toml")).unwrap_or_default()
});

impl Symbols {
    pub fn mark(&self, mark: Mark) -> char {
        self.marks[mark as usize]
    }
}

/// Everything that decides how the screen looks.
#[derive(Clone, Debug)]
pub struct Look {
    /// How curves and symbols are drawn.
    pub glyphs: Glyphs,
    styles: [Style; ROLES],
    /// The letters of curves.
    letters: [char; ROLES],
    /// Whether lines are twice as wide, for the back of a room.
    pub wide: bool,
    /// Grounds of maps from the least to the most dangerous; none where the terminal has too few colours.
    ramp: Vec<Style>,
}

/// How many roles there are.
const ROLES: usize = Role::VARIANTS.len();

/// What has its finer colour wherever the terminal has one, since the sixteen have nothing like it.
const FINE: [Role; 3] = [Role::Ghost, Role::GhostStable, Role::GhostUnstable];

impl Look {
    /// The look that these settings ask for; what they leave open becomes braille in 16 colours.
    pub fn new(settings: DisplaySettings) -> Self {
        let DisplaySettings { glyphs, colors, fine, theme, lecture: wide, .. } = settings;
        let theme = match theme {
            _ if colors == Colors::Never => Theme::Mono,
            Theme::Auto | Theme::Dark if wide => Theme::Contrast,
            theme => theme,
        };
        // Of the sixteen, too few are dark enough for a light ground, or bright enough for a large contrast.
        let colors = match (colors, theme) {
            (Colors::Sixteen, Theme::Light | Theme::Contrast) if color_of(fine).is_some() => fine,
            _ => colors,
        };
        // A test reads every theme, so the plain look never serves.
        let read = Look::from_text(text_of(theme), glyphs, [colors, fine]);
        let look = read.unwrap_or(Look {
            glyphs,
            styles: [Style::new(); ROLES],
            letters: [' '; ROLES],
            wide,
            ramp: Vec::new(),
        });
        Look { wide, ..look }
    }

    /// The look that a theme file describes, in colours of one depth for all and, where that is sixteen, of
    /// another for what they have no colour for. Fails with the role that has no style, or the word that is none.
    fn from_text(text: &str, glyphs: Glyphs, [colors, fine]: [Colors; 2]) -> Result<Self, String> {
        let fine = match (colors, fine) {
            (Colors::Sixteen, Colors::Indexed | Colors::True) => fine,
            _ => colors,
        };
        let lines: BTreeMap<String, String> =
            placed::toml("theme", text).map_err(|mistake| mistake.to_string())?;
        let mut styles = [Style::new(); ROLES];
        let mut rgb = [None; ROLES];
        let mut letters = [' '; ROLES];
        for (index, role) in Role::VARIANTS.iter().enumerate() {
            let words = lines.get(role.name()).ok_or(role.name())?;
            letters[index] = *SETS.curves.get(role.name()).ok_or(role.name())?;
            let (style, fine_colour) = parsed(words)?;
            let depth = if FINE.contains(role) { fine } else { colors };
            (styles[index], rgb[index]) = (in_depth(style, fine_colour, depth), fine_colour);
        }
        let ends = [Role::Calm, Role::Danger].map(|role| rgb[role as usize]);
        let ramp = match (ends, color_of(fine)) {
            ([Some(calm), Some(danger)], Some(color)) => {
                let ground = |step| color(mixed(calm, danger, step));
                (0..STEPS).map(ground).map(|ground| Style::new().fg(ground).bg(ground)).collect()
            }
            _ => Vec::new(),
        };
        Ok(Look { glyphs, styles, letters, wide: false, ramp })
    }

    /// The style of a place on a map: `part` grows from 0 to 1 with what is dangerous. Where there are colours
    /// enough its ground says it, and hides the letter that says it elsewhere.
    pub fn danger(&self, part: f64) -> Style {
        let step = truncated(part * f64::from(STEPS));
        let ground = self.ramp.get(step.min(usize::from(STEPS) - 1));
        ground.copied().unwrap_or(self.style(Role::Danger))
    }

    pub fn style(&self, role: Role) -> Style {
        self.styles[role as usize]
    }

    /// The same look, in which what stands for a role looks as the cursor does, without colours reversed.
    pub fn pointing(mut self, role: Role) -> Self {
        let cursor = self.style(Role::Cursor);
        let attribute = cursor.fg.map_or(Modifier::REVERSED, |_| Modifier::BOLD);
        self.styles[role as usize] = cursor.add_modifier(attribute);
        self
    }

    /// A text in the style of a role.
    pub fn span<'a>(&self, text: impl Into<Cow<'a, str>>, role: Role) -> Span<'a> {
        Span::styled(text, self.style(role))
    }

    /// Whether the grounds of maps say how dangerous a place is.
    pub fn has_grounds(&self) -> bool {
        !self.ramp.is_empty()
    }

    /// The letter that draws the curves of a role where there are no dots.
    pub fn letter(&self, role: Role) -> char {
        self.letters[role as usize]
    }

    /// The symbols of this set of glyphs.
    pub fn symbols(&self) -> &'static Symbols {
        if self.glyphs == Glyphs::Ascii {
            &SETS.letters
        } else {
            &SETS.rich
        }
    }

    /// How a key is named on the screen: arrows as arrows, other keys by name, without brackets.
    pub fn key(&self, key: Key) -> String {
        const ARROWS: [(Code, char); 4] =
            [(Code::Left, '←'), (Code::Right, '→'), (Code::Up, '↑'), (Code::Down, '↓')];
        let arrow = ARROWS.iter().find(|(code, _)| *code == key.code);
        match arrow.filter(|_| self.glyphs != Glyphs::Ascii) {
            // It stands behind the keys that are held with it.
            Some((code, arrow)) => key.said().replace(&code.to_string(), &arrow.to_string()),
            None => key.said(),
        }
    }

    /// Several keys, side by side; single characters need no space between them.
    pub fn keys(&self, keys: impl IntoIterator<Item = Key>) -> String {
        let names: Vec<String> = keys.into_iter().map(|key| self.key(key)).collect();
        let short = names.iter().all(|name| name.chars().count() == 1);
        names.join(if short { "" } else { " " })
    }

    /// A sentence of a scene, with the keys that the user has in place of the commands that it names.
    pub fn sentence(&self, text: &str, keymap: &Keymap) -> String {
        keymap.fill(text, |key| self.key(key))
    }
}

/// Steps of the grounds of maps.
const STEPS: u8 = 16;

/// Red, green and blue.
pub type Rgb = [u8; 3];

/// Reads a style such as `red bold #ff7b72`: the finer colour serves where the terminal has more
/// than 16. Returns the word that it does not know.
fn parsed(words: &str) -> Result<(Style, Option<Rgb>), &str> {
    let mut style = Style::new();
    let mut fine = None;
    for word in words.split_whitespace().filter(|word| *word != "default") {
        match (Modifier::from_name(&word.to_uppercase()), Color::from_str(word)) {
            (Some(attribute), _) => style = style.add_modifier(attribute),
            (None, Ok(Color::Rgb(red, green, blue))) => fine = Some([red, green, blue]),
            _ => style = style.fg(Color::Indexed(number(word).ok_or(word)?)),
        }
    }
    Ok((style, fine))
}

/// A style in colours of some depth.
fn in_depth(mut style: Style, fine: Option<Rgb>, colors: Colors) -> Style {
    match (color_of(colors), fine) {
        (Some(color), Some(rgb)) => {
            // A finer colour is quiet by itself where the 16 colours need the attribute.
            style.add_modifier.remove(Modifier::DIM);
            style.fg(color(rgb))
        }
        _ if colors == Colors::Never => Style { fg: None, ..style },
        _ => style,
    }
}

/// How a colour is sent to a terminal with more than sixteen.
fn color_of(colors: Colors) -> Option<fn(Rgb) -> Color> {
    match colors {
        Colors::Indexed => Some(|rgb| Color::Indexed(nearest(rgb))),
        Colors::True => Some(Color::from),
        Colors::Auto | Colors::Never | Colors::Sixteen => None,
    }
}

/// A colour this many steps on the way from one to another.
fn mixed(from: Rgb, to: Rgb, step: u8) -> Rgb {
    let [step, last] = [step, STEPS - 1].map(u16::from);
    [0, 1, 2].map(|index| {
        let sum = u16::from(from[index]) * (last - step) + u16::from(to[index]) * step;
        u8::try_from(sum / last).unwrap_or(u8::MAX)
    })
}

/// The nearest of xterm's 240 fixed colours.
fn nearest(rgb: Rgb) -> u8 {
    let distance = |index: &u8| -> u32 {
        let parts = rgb.into_iter().zip(fixed(*index));
        parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    (FIXED..=u8::MAX).min_by_key(distance).unwrap_or(FIXED)
}

/// The terminal's own palette, in the order of its numbers.
const PALETTE: &str = "black red green yellow blue magenta cyan gray dark-gray light-red \
                       light-green light-yellow light-blue light-magenta light-cyan white";

/// The number by which a terminal knows the colour of this name.
fn number(name: &str) -> Option<u8> {
    (0..).zip(PALETTE.split(' ')).find(|(_, known)| *known == name).map(|(index, _)| index)
}

/// The first of xterm's fixed colours.
pub const FIXED: u8 = 16;

/// A fixed colour of xterm: a cube of 6 levels a side, then a ramp of 24 greys.
pub fn fixed(index: u8) -> Rgb {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    match index.saturating_sub(FIXED) {
        cube @ 0..216 => [36, 6, 1].map(|place| LEVELS[usize::from(cube / place % 6)]),
        grey => [8 + 10 * (grey - 216); 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::{exp, ln};
    use crate::session::settings::choices;
    use crate::view::screen::Paper;

    /// The hue of a colour in degrees; none of what is nearly grey.
    fn hue(rgb: Rgb) -> Option<f64> {
        let [red, green, blue] = rgb.map(f64::from);
        let (least, most) = (red.min(green).min(blue), red.max(green).max(blue));
        let spread = most - least;
        let sextant = if most == red {
            (green - blue) / spread
        } else if most == green {
            2.0 + (blue - red) / spread
        } else {
            4.0 + (red - green) / spread
        };
        (spread > 0.15 * most).then(|| (60.0 * sextant).rem_euclid(360.0))
    }

    fn look(theme: Theme, glyphs: Glyphs, colors: Colors) -> Look {
        Look::new(DisplaySettings { glyphs, colors, theme, ..DisplaySettings::default() })
    }

    #[test]
    fn every_theme_gives_every_role_a_style() {
        for (name, theme) in choices::<Theme>() {
            let read = Look::from_text(text_of(theme), Glyphs::Braille, [Colors::Sixteen; 2]);
            assert!(read.is_ok(), "{name}: {read:?}");
            let lines: BTreeMap<String, String> = toml::from_str(text_of(theme)).unwrap();
            assert_eq!(lines.len(), ROLES, "{name}: each is that of a role");
        }
    }

    #[test]
    fn each_depth_has_its_own_colours_and_no_others() {
        for (name, theme) in choices::<Theme>() {
            let colours = |colors| {
                let look = look(theme, Glyphs::Braille, colors);
                look.styles.into_iter().filter_map(|style| style.fg).collect::<Vec<_>>()
            };
            assert_eq!(colours(Colors::Never), [], "{name}");
            let fine = |colour: &Color| matches!(colour, Color::Rgb(..) | Color::Indexed(FIXED..));
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
        assert!(look.letters.iter().all(char::is_ascii));
        assert_eq!(SETS.curves.len(), ROLES);
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
        for (name, theme) in choices::<Theme>().filter(|(_, theme)| *theme != Theme::Mono) {
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
    fn red_and_green_mean_unstable_and_stable_and_nothing_else() {
        let red = [Role::Unstable, Role::GhostUnstable];
        let green = [Role::Stable, Role::GhostStable];
        for (name, theme) in choices::<Theme>() {
            for role in Role::VARIANTS {
                let text = role.name();
                let lines: BTreeMap<String, String> = toml::from_str(text_of(theme)).unwrap();
                let (style, fine) = parsed(&lines[text]).unwrap();
                let is_red = matches!(style.fg, Some(Color::Indexed(1 | 9)));
                let is_green = matches!(style.fg, Some(Color::Indexed(2 | 10)));
                assert!(!is_red || red.contains(role), "{name}: {text}");
                assert!(!is_green || green.contains(role), "{name}: {text}");
                if let Some(hue) = fine.and_then(hue) {
                    let is_red = !(16.0..344.0).contains(&hue);
                    let is_green = (75.0..165.0).contains(&hue);
                    assert_eq!(is_red, red.contains(role), "{name}: {text} {hue}");
                    assert_eq!(is_green, green.contains(role), "{name}: {text} {hue}");
                }
            }
        }
    }

    /// The terminal's own sixteen colours as xterm and as VGA have them.
    const XTERM: [u32; 16] = [
        0x00_0000, 0xcd_0000, 0x00_cd00, 0xcd_cd00, 0x00_00ee, 0xcd_00cd, 0x00_cdcd, 0xe5_e5e5,
        0x7f_7f7f, 0xff_0000, 0x00_ff00, 0xff_ff00, 0x5c_5cff, 0xff_00ff, 0x00_ffff, 0xff_ffff,
    ];
    const VGA: [u32; 16] = [
        0x00_0000, 0xaa_0000, 0x00_aa00, 0xaa_5500, 0x00_00aa, 0xaa_00aa, 0x00_aaaa, 0xaa_aaaa,
        0x55_5555, 0xff_5555, 0x55_ff55, 0xff_ff55, 0x55_55ff, 0xff_55ff, 0x55_ffff, 0xff_ffff,
    ];

    /// The contrast of two colours by the relative luminance of WCAG 2.
    fn contrast(one: [f64; 3], other: [f64; 3]) -> f64 {
        let linear = |part: f64| match part / 255.0 {
            part if part <= 0.03928 => part / 12.92,
            part => exp(2.4 * ln((part + 0.055) / 1.055)),
        };
        let luminance = |[red, green, blue]: [f64; 3]| {
            0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
        };
        let [one, other] = [one, other].map(luminance);
        (one.max(other) + 0.05) / (one.min(other) + 0.05)
    }

    fn parts(rgb: u32) -> [f64; 3] {
        let [_, red, green, blue] = rgb.to_be_bytes();
        [red, green, blue].map(f64::from)
    }

    /// The contrast of a style with its paper, by one of the palettes. What is dim is drawn at six tenths.
    fn on_paper(style: Style, palette: &[u32; 16], paper: Paper) -> f64 {
        let ground = parts(paper.ground);
        let ink = match style.fg {
            None => parts(paper.ink),
            Some(Color::Rgb(red, green, blue)) => [red, green, blue].map(f64::from),
            Some(Color::Indexed(index @ FIXED..)) => fixed(index).map(f64::from),
            Some(Color::Indexed(index)) => parts(palette[usize::from(index)]),
            other => panic!("{other:?}"),
        };
        let strength = if style.add_modifier.contains(Modifier::DIM) {
            0.6
        } else {
            1.0
        };
        let drawn = [0, 1, 2].map(|at| strength * ink[at] + (1.0 - strength) * ground[at]);
        contrast(drawn, ground)
    }

    /// The weakest role of a look and its contrast, but for that of the ground of maps, which hides its letter.
    fn weakest(look: &Look, paper: Paper) -> (f64, &'static str) {
        let told = Role::VARIANTS.iter().filter(|role| **role != Role::Calm);
        let all = told.flat_map(|role| {
            let style = look.style(*role);
            [&XTERM, &VGA].map(|palette| (on_paper(style, palette, paper), role.name()))
        });
        all.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap()
    }

    #[test]
    fn black_on_white_has_the_greatest_contrast() {
        assert!((contrast([0.0; 3], [255.0; 3]) - 21.0).abs() < 1e-12);
        assert!((contrast([7.0; 3], [7.0; 3]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_carries_meaning_can_be_read_and_in_a_lecture_from_afar() {
        for (theme, paper) in [
            (Theme::Dark, Paper::DARK),
            (Theme::Light, Paper::LIGHT),
            (Theme::Contrast, Paper::DARK),
            (Theme::Mono, Paper::DARK),
            (Theme::Mono, Paper::LIGHT),
        ] {
            for colors in [Colors::Sixteen, Colors::Indexed, Colors::True] {
                let (least, role) = weakest(&look(theme, Glyphs::Braille, colors), paper);
                assert!(least >= 4.5, "{theme:?} {colors:?}: {role} {least}");
            }
            let lecture = DisplaySettings {
                colors: Colors::Sixteen,
                fine: Colors::True,
                theme,
                lecture: true,
                ..DisplaySettings::default()
            };
            if theme != Theme::Mono {
                let (least, role) = weakest(&Look::new(lecture), paper);
                assert!(least >= 7.0, "{theme:?}: {role} {least}");
            }
        }
    }

    #[test]
    fn each_meaning_has_a_colour_of_its_own_in_every_theme() {
        let meanings = [
            Role::Trajectory,
            Role::Stable,
            Role::Unstable,
            Role::Sticking,
            Role::Belt,
            Role::Current,
            Role::Asymptote,
        ];
        for theme in [Theme::Dark, Theme::Light, Theme::Contrast] {
            for colors in [Colors::Sixteen, Colors::Indexed, Colors::True] {
                let look = look(theme, Glyphs::Braille, colors);
                for (index, one) in meanings.iter().enumerate() {
                    for other in &meanings[..index] {
                        let [one, other] = [one, other].map(|role| look.style(*role));
                        assert_ne!(one, other, "{theme:?} {colors:?}");
                        // Of the sixteen, four can be read on a light ground: two meanings differ there by weight.
                        let is_short = theme == Theme::Light && colors == Colors::Sixteen;
                        assert!(is_short || one.fg != other.fg, "{theme:?} {colors:?}: {one:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn grounds_of_maps_are_of_one_hue_and_the_stronger_the_more_dangerous() {
        for (name, theme) in choices::<Theme>().filter(|(_, theme)| *theme != Theme::Mono) {
            let settings = DisplaySettings { theme, ..DisplaySettings::default() };
            let look = |colors, fine| Look::new(DisplaySettings { colors, fine, ..settings });
            let ground = |look: &Look, step: u8| look.danger(f64::from(step) / 16.0).bg;
            let strengths =
                (0..STEPS).map(|step| match ground(&look(Colors::Sixteen, Colors::True), step) {
                    Some(Color::Rgb(red, green, blue)) => [red, green, blue],
                    other => panic!("{name}: {other:?}"),
                });
            let strengths: Vec<Rgb> = strengths.collect();
            let far = |rgb: Rgb| {
                let [red, green, blue] = rgb.map(u32::from);
                red.max(green).max(blue) - red.min(green).min(blue)
            };
            assert!(strengths.windows(2).all(|pair| far(pair[0]) < far(pair[1])), "{name}");
            let hues: Vec<f64> = strengths.into_iter().filter_map(hue).collect();
            let (least, most) =
                hues.iter().fold((f64::MAX, f64::MIN), |(a, b), hue| (a.min(*hue), b.max(*hue)));
            assert!(most - least < 25.0, "{name}: {least} .. {most}");
            // Where there are no more than sixteen colours, or none, letters say it.
            for few in [Colors::Sixteen, Colors::Never] {
                assert_eq!(ground(&look(few, Colors::Auto), 3), None, "{name}");
            }
            assert_eq!(ground(&look(Colors::Never, Colors::True), 3), None, "{name}");
            assert!(matches!(
                ground(&look(Colors::Indexed, Colors::Auto), 3),
                Some(Color::Indexed(_))
            ));
        }
    }

    #[test]
    fn a_wrong_theme_says_what_is_wrong() {
        let refused =
            |text: &str| Look::from_text(text, Glyphs::Braille, [Colors::Sixteen; 2]).unwrap_err();
        assert!(refused("text = 3").starts_with("theme:1:8: "), "{}", refused("text = 3"));
        assert_eq!(refused("text = 'default'"), "quiet");
        let full = text_of(Theme::Dark).replace("stable = \"", "stable = \"mauve ");
        assert_eq!(refused(&full), "mauve");
    }

    #[test]
    fn fixed_colours_are_their_own_nearest() {
        for (rgb, index) in [([0; 3], 16), ([255; 3], 231), ([95, 135, 175], 67), ([238; 3], 255)] {
            assert_eq!(nearest(rgb), index);
        }
    }

    #[test]
    fn keys_have_short_names() {
        let rich = Look::new(DisplaySettings::default());
        let letters =
            Look::new(DisplaySettings { glyphs: Glyphs::Ascii, ..DisplaySettings::default() });
        let cases = [
            ("<left>", "←", "left"),
            ("<S-up>", "S-↑", "S-up"),
            ("<enter>", "enter", "enter"),
            ("<space>", "space", "space"),
            ("<lt>", "<", "<"),
            ("<C-r>", "C-r", "C-r"),
            ("<f6>", "F6", "F6"),
            ("<S-f6>", "S-F6", "S-F6"),
            ("?", "?", "?"),
        ];
        for (written, drawn, plain) in cases {
            let key: Key = written.parse().unwrap();
            assert_eq!((rich.key(key).as_str(), letters.key(key).as_str()), (drawn, plain));
        }
    }
}
