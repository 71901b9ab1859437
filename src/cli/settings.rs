//! The user's settings: the file, its path and its content, and the options that say how the screen looks; the directories
//! for settings and for state, by the XDG conventions.

use std::path::PathBuf;
use std::time::SystemTime;

use clap::Args;

use super::Result;
use crate::runtime::bounded;
use crate::session::config::{Config, parse};
use crate::session::{Colors, DisplaySettings, Glyphs, NamedValue, Theme, choices, named};
use crate::words::joined;

/// Which settings file is read.
#[derive(Args)]
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
    pub fn read(&self) -> Result<Config> {
        let is_there = |path: &PathBuf| self.config.is_some() || path.exists();
        let Some(path) = self.path().filter(is_there) else { return Ok(Config::default()) };
        parse(&path.display().to_string(), &bounded::text(&path)?)
            .map_err(|mistake| mistake.to_string().into())
    }

    /// The file that is read, whether it exists or not.
    pub fn path(&self) -> Option<PathBuf> {
        if self.no_config {
            None
        } else {
            self.config.clone().or_else(own_settings)
        }
    }
}

/// How the screen looks.
#[derive(Clone, Copy, Args)]
pub struct Looks {
    #[arg(long, value_name = "KIND",
          value_parser = named::<Glyphs>, help = help::<Glyphs>("Characters that dots are drawn with"))]
    glyphs: Option<Glyphs>,

    #[arg(long, value_name = "DEPTH",
          value_parser = named::<Colors>, help = help::<Colors>("Colour depth"))]
    color: Option<Colors>,

    #[arg(long, value_name = "NAME",
          value_parser = named::<Theme>, help = help::<Theme>("Colour theme"))]
    theme: Option<Theme>,

    /// Lets the mouse start motions and zoom instead of selecting text
    #[arg(long)]
    mouse: bool,

    /// Shows one or two plots with wide lines and the outcome in large letters, for a class
    #[arg(long)]
    lecture: bool,
}

impl Looks {
    /// The user's choice: from the options, else from the settings file, else the default.
    pub fn wishes(self, config: &Config) -> DisplaySettings {
        DisplaySettings {
            glyphs: self.glyphs.or(config.glyphs).unwrap_or_default(),
            colors: self.color.or(config.colors).unwrap_or_default(),
            theme: self.theme.or(config.theme).unwrap_or_default(),
            mouse: self.mouse || config.mouse,
            lecture: self.lecture || config.lecture,
            ..DisplaySettings::default()
        }
    }
}

fn help<T: NamedValue>(what: &str) -> String {
    format!("{what}: {}", joined(choices::<T>().map(|row| row.0), ", "))
}

/// Prefix of the file names of interrupted sessions.
const INTERRUPTED: &str = "interrupted-";

/// The directory in a variable if that is an absolute path, else one below the user's home.
fn base(name: &str, below_home: &str) -> Option<PathBuf> {
    let set = |name| std::env::var_os(name).filter(|it| !it.is_empty()).map(PathBuf::from);
    let named = set(name).filter(|path| path.is_absolute());
    let home = || set("HOME").or_else(|| set("USERPROFILE"));
    named.or_else(|| Some(home()?.join(below_home)))
}

/// The user's own settings file, whether it exists or not; `None` if there is no directory for it.
fn own_settings() -> Option<PathBuf> {
    Some(base("XDG_CONFIG_HOME", ".config")?.join("hopfscope/config.toml"))
}

/// What the program remembers, in the directory in which it keeps its state.
pub struct Memory {
    folder: PathBuf,
    /// Whether the directory did not exist before: this is the first start.
    pub is_new: bool,
    /// The file that holds the last copy.
    pub copies: PathBuf,
    /// The file in which this process saves its session if it is interrupted.
    pub keep: PathBuf,
    /// The file of the session that was left or put aside last.
    pub last: PathBuf,
}

impl Memory {
    /// Creates the directory if needed; `None` if that is impossible.
    pub fn open() -> Option<Memory> {
        let folder = base("XDG_STATE_HOME", ".local/state")?.join("hopfscope");
        let is_new = !folder.exists();
        std::fs::create_dir_all(&folder).ok()?;
        let keep = folder.join(format!("{INTERRUPTED}{}.toml", std::process::id()));
        let (copies, last) = (folder.join("copy.txt"), folder.join("last.toml"));
        Some(Memory { folder, is_new, copies, keep, last })
    }

    /// Whether a session was left or interrupted.
    pub fn keeps(&self) -> bool {
        self.last.exists() || !self.interrupted().is_empty()
    }

    /// The files of interrupted sessions that have not been put aside since, with the times at which they
    /// ended, the newest first.
    pub fn interrupted(&self) -> Vec<(SystemTime, PathBuf)> {
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let kept = entries.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_kept = name.starts_with(INTERRUPTED);
            let when = entry.metadata().and_then(|data| data.modified());
            is_kept.then(|| (when.unwrap_or(SystemTime::UNIX_EPOCH), entry.path()))
        });
        let mut kept: Vec<_> = kept.collect();
        kept.sort_by(|one, other| other.cmp(one));
        kept
    }
}
