//! The user's settings file: its path and its content.

use std::path::PathBuf;

use clap::Args;

use super::failure::Failure;
use super::places;
use crate::runtime::bounded;
use crate::session::config::{Config, parse};

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
        let (path, named) = match (&self.config, self.no_config) {
            (Some(path), _) => (path.clone(), true),
            (None, true) => return Ok(Config::default()),
            (None, false) => match places::settings() {
                Some(path) => (path, false),
                None => return Ok(Config::default()),
            },
        };
        match bounded::text(&path) {
            Ok(text) => parse(&path.display().to_string(), &text)
                .map_err(|misread| Failure::Usage(misread.to_string())),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound && !named => {
                Ok(Config::default())
            }
            Err(error) => Err(Failure::Usage(format!("{}: {error}", path.display()))),
        }
    }

    /// The file that is read, whether it exists or not.
    pub fn path(&self) -> Option<PathBuf> {
        if self.no_config { None } else { self.config.clone().or_else(places::settings) }
    }
}
