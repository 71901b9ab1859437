//! The user's settings: the file, its path and its content, and the options that say how the screen looks.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, places};
use crate::runtime::bounded;
use crate::session::config::{Config, parse};
use crate::session::settings::{Colors, DisplaySettings, Glyphs, NamedValue, Theme, choices};
use crate::words;

/// Which settings file is read.
#[derive(Clone, Debug, Args)]
pub struct Settings {
    /// Reads this settings file instead of your own
    #[arg(long, value_name = "FILE", conflicts_with = "no_config")]
    config: Option<PathBuf>,

    /// Reads no settings file
    #[arg(long)]
    no_config: bool,
}

impl Settings {
    /// The content of the file. The user's own file need not exist; a file named on the command line must.
    pub fn read(&self) -> Result<Config, Failure> {
        let is_there = |path: &PathBuf| self.config.is_some() || path.exists();
        let Some(path) = self.path().filter(is_there) else { return Ok(Config::default()) };
        parse(&path.display().to_string(), &bounded::text(&path)?)
            .map_err(|misread| Failure::Usage(misread.to_string()))
    }

    /// The file that is read, whether it exists or not.
    pub fn path(&self) -> Option<PathBuf> {
        if self.no_config { None } else { self.config.clone().or_else(places::settings) }
    }
}

/// How the screen looks.
#[derive(Clone, Copy, Debug, Args)]
pub struct Looks {
    #[arg(long, value_name = "KIND",
          value_parser = one_of::<Glyphs>, help = help::<Glyphs>("Characters that dots are drawn with"))]
    glyphs: Option<Glyphs>,

    #[arg(long, value_name = "DEPTH",
          value_parser = one_of::<Colors>, help = help::<Colors>("Colour depth"))]
    color: Option<Colors>,

    #[arg(long, value_name = "NAME",
          value_parser = one_of::<Theme>, help = help::<Theme>("Colour theme"))]
    theme: Option<Theme>,

    /// Lets the mouse start motions and zoom instead of selecting text
    #[arg(long)]
    mouse: bool,
}

impl Looks {
    /// The user's choice: from the options, else from the settings file, else the default.
    pub fn wishes(self, config: &Config) -> DisplaySettings {
        DisplaySettings {
            glyphs: self.glyphs.or(config.glyphs).unwrap_or_default(),
            colors: self.color.or(config.colors).unwrap_or_default(),
            fine: Colors::Auto,
            theme: self.theme.or(config.theme).unwrap_or_default(),
            mouse: self.mouse || config.mouse,
            stretched: false,
            dimensionless: false,
        }
    }
}

fn help<T: NamedValue>(what: &str) -> String {
    let names: Vec<_> = choices::<T>().map(|row| row.0).collect();
    format!("{what}: {}", names.join(", "))
}

fn one_of<T: NamedValue>(name: &str) -> Result<T, String> {
    words::one_of("", name, choices())
}
