//! What the terminal can do, as far as the environment tells.
//!
//! Only [`Environment::of_process`] reads the environment, so that every decision is a function of its variables and can
//! be tested.

use crate::session::{Colors, DisplaySettings, Glyphs, Theme};

/// The terminal, as far as it is known.
#[derive(Clone)]
pub struct Environment {
    /// Type of the terminal; empty if unknown.
    term: String,
    /// The default glyphs: braille where the locale, tmux or Windows Terminal says UTF-8, else ASCII.
    ///
    /// The latter count because they draw UTF-8 themselves, whatever locale a login over SSH left behind. The Linux
    /// console supports UTF-8, but its fonts have no braille: it gets blocks.
    pub glyphs: Glyphs,
    /// The default colours: none where the user or the terminal wants none, else 16.
    ///
    /// Only sixteen even where the terminal has more, because these follow the user's own palette and cost the
    /// fewest bytes; `--color 256` and `--color true` ask for more. The field `fine` is for what sixteen colours cannot
    /// show.
    pub colors: Colors,
    /// The finest colours that the terminal claims to have; `Auto` if it claims none beyond sixteen.
    fine: Colors,
    /// Whether standard input is a terminal.
    pub input_is_terminal: bool,
    /// Whether standard output is a terminal.
    pub output_is_terminal: bool,
    /// Whether the terminal reported a light background; `None` if it reported nothing.
    pub is_light: Option<bool>,
}

impl Environment {
    /// An empty variable counts as unset.
    pub fn of_process() -> Environment {
        use std::io::IsTerminal;
        Environment {
            input_is_terminal: std::io::stdin().is_terminal(),
            output_is_terminal: std::io::stdout().is_terminal(),
            ..Environment::of(|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
        }
    }

    /// That of terminals on both sides and these variables.
    pub fn of(value: impl Fn(&str) -> Option<String>) -> Environment {
        let term = value("TERM").unwrap_or_default();
        // The first overrides the others.
        let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(&value);
        let plain = |locale: String| locale.to_ascii_lowercase().replace('-', "");
        let draws = ["TMUX", "WT_SESSION"].into_iter().any(|name| value(name).is_some());
        let unicode = draws || locale.is_some_and(|locale| plain(locale).contains("utf8"));
        let monochrome = MONOCHROME.iter().any(|name| term.starts_with(name));
        let colourless = monochrome || value("NO_COLOR").is_some();
        Environment {
            glyphs: match (unicode, term == "linux") {
                (true, false) => Glyphs::Braille,
                (true, true) => Glyphs::Block,
                (false, _) => Glyphs::Ascii,
            },
            colors: if colourless { Colors::Never } else { Colors::Sixteen },
            fine: match value("COLORTERM").as_deref() {
                Some("truecolor" | "24bit") => Colors::True,
                _ if term.contains("256color") => Colors::Indexed,
                _ => Colors::Auto,
            },
            term,
            input_is_terminal: true,
            output_is_terminal: true,
            is_light: None,
        }
    }

    /// Whether the explorer can run here. Fails with one line that says why it cannot; the exit code is 2.
    pub fn admit(&self) -> Result<(), String> {
        let why = if !self.input_is_terminal {
            "standard input is not a terminal"
        } else if !self.output_is_terminal {
            "standard output is not a terminal"
        } else if self.term == "dumb" {
            "TERM=dumb is a terminal without cursor movement"
        } else {
            return Ok(());
        };
        Err(format!(
            "{why}; the explorer needs one. Without a terminal: hopfscope trajectory, cycles, scenes, \
             replay FILE (hopfscope --help lists all)"
        ))
    }

    /// The user's wishes, with every `Auto` replaced by what suits this terminal.
    pub fn fit(&self, wish: DisplaySettings) -> DisplaySettings {
        let glyphs = match wish.glyphs {
            Glyphs::Auto => self.glyphs,
            wanted => wanted,
        };
        let (colors, fine) = match wish.colors {
            Colors::Auto => (self.colors, self.fine),
            wanted => (wanted, wanted),
        };
        let theme = match (wish.theme, self.is_light) {
            (Theme::Auto, Some(true)) => Theme::Light,
            (Theme::Auto, _) => Theme::Dark,
            (wanted, _) => wanted,
        };
        DisplaySettings { glyphs, colors, fine, theme, ..wish }
    }

    /// Whether to ask the terminal for the colour of its background: the wishes depend on it, it is unknown,
    /// and the terminal is of a type that ignores sequences it does not understand.
    pub fn asks_for_background(&self, wish: DisplaySettings) -> bool {
        let passes = !["", "linux"].contains(&self.term.as_str());
        let coloured = self.fit(wish).colors != Colors::Never;
        wish.theme == Theme::Auto && self.is_light.is_none() && passes && coloured
    }
}

/// Prefixes of `TERM` for terminals without colours.
const MONOCHROME: [&str; 4] = ["vt1", "vt2", "vt3", "dumb"];

#[cfg(test)]
mod tests {
    use super::*;

    fn environment(variables: &[(&str, &str)]) -> Environment {
        Environment::of(|name| {
            let found = variables.iter().find(|(given, _)| *given == name);
            found.map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn glyphs_follow_the_locale_in_its_order_of_precedence() {
        let cases: [(&[(&str, &str)], Glyphs); 8] = [
            (&[], Glyphs::Ascii),
            (&[("LANG", "C")], Glyphs::Ascii),
            (&[("LANG", "C.UTF-8")], Glyphs::Braille),
            (&[("LANG", "de_DE.utf8")], Glyphs::Braille),
            (&[("LANG", "de_DE.UTF-8"), ("LC_CTYPE", "C")], Glyphs::Ascii),
            (&[("LC_CTYPE", "C"), ("LC_ALL", "en_GB.UTF-8")], Glyphs::Braille),
            (&[("LANG", "C"), ("TMUX", "/tmp/tmux-0/default,1,0")], Glyphs::Braille),
            (&[("LANG", "C.UTF-8"), ("TERM", "linux")], Glyphs::Block),
        ];
        for (variables, glyphs) in cases {
            assert_eq!(environment(variables).glyphs, glyphs, "{variables:?}");
        }
    }

    #[test]
    fn colours_follow_no_color_and_the_terminal() {
        let cases: [(&[(&str, &str)], Colors); 5] = [
            (&[], Colors::Sixteen),
            (&[("TERM", "xterm-256color")], Colors::Sixteen),
            (&[("TERM", "xterm-256color"), ("NO_COLOR", "1")], Colors::Never),
            (&[("TERM", "vt100")], Colors::Never),
            (&[("TERM", "vt220")], Colors::Never),
        ];
        for (variables, colors) in cases {
            assert_eq!(environment(variables).colors, colors, "{variables:?}");
        }
    }

    #[test]
    fn a_wish_beats_what_the_terminal_says() {
        let environment = environment(&[("LANG", "C"), ("NO_COLOR", "1")]);
        let wish = DisplaySettings {
            glyphs: Glyphs::Braille,
            colors: Colors::True,
            fine: Colors::True,
            theme: Theme::Contrast,
            ..DisplaySettings::default()
        };
        assert_eq!(environment.fit(wish), wish);
        let fitted = environment.fit(DisplaySettings::default());
        assert_eq!((fitted.glyphs, fitted.colors), (Glyphs::Ascii, Colors::Never));
    }

    #[test]
    fn finer_colours_are_those_that_the_terminal_says_it_has_or_the_user_asks_for() {
        type Case<'a> = (&'a [(&'a str, &'a str)], Colors, Colors);
        let cases: [Case; 6] = [
            (&[("TERM", "xterm")], Colors::Auto, Colors::Auto),
            (&[("TERM", "xterm-256color")], Colors::Auto, Colors::Indexed),
            (&[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")], Colors::Auto, Colors::True),
            (&[("TERM", "foot"), ("COLORTERM", "24bit")], Colors::Auto, Colors::True),
            (&[("TERM", "foot"), ("COLORTERM", "24bit")], Colors::Sixteen, Colors::Sixteen),
            (&[("TERM", "xterm")], Colors::Indexed, Colors::Indexed),
        ];
        for (variables, colors, fine) in cases {
            let fitted = environment(variables)
                .fit(DisplaySettings { colors, ..DisplaySettings::default() });
            assert_eq!(fitted.fine, fine, "{variables:?} {colors:?}");
        }
    }

    #[test]
    fn the_theme_follows_the_background_where_it_is_known_and_not_chosen() {
        let terminal = environment(&[("TERM", "xterm")]);
        let [auto, chosen] = [Theme::Auto, Theme::Contrast]
            .map(|theme| DisplaySettings { theme, ..DisplaySettings::default() });
        assert!(terminal.asks_for_background(auto) && !terminal.asks_for_background(chosen));
        for unasked in [&[("TERM", "linux")][..], &[("TERM", "xterm"), ("NO_COLOR", "1")], &[]] {
            assert!(!environment(unasked).asks_for_background(auto), "{unasked:?}");
        }
        for (is_light, theme) in
            [(None, Theme::Dark), (Some(false), Theme::Dark), (Some(true), Theme::Light)]
        {
            let known = Environment { is_light, ..terminal.clone() };
            assert_eq!(known.fit(auto).theme, theme);
            assert_eq!(known.fit(chosen).theme, Theme::Contrast);
            assert_eq!(known.asks_for_background(auto), is_light.is_none());
        }
    }

    #[test]
    fn a_refusal_names_what_is_missing_and_what_to_do_instead() {
        let terminal = environment(&[("TERM", "xterm")]);
        assert_eq!(terminal.admit(), Ok(()));
        let piped = Environment { output_is_terminal: false, ..terminal.clone() };
        let line = piped.admit().unwrap_err();
        assert!(line.contains("standard output") && line.contains("trajectory"), "{line}");
        let piped = Environment { input_is_terminal: false, ..terminal };
        assert!(piped.admit().unwrap_err().starts_with("standard input"));
        assert!(environment(&[("TERM", "dumb")]).admit().unwrap_err().starts_with("TERM=dumb"));
    }
}
