//! `hopfscope replay`: a keystroke file, run without a terminal.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::settings::Looks;
use super::{Failure, Result, StartOptions, input, print, write};
use crate::flow::Limits;
use crate::runtime::{Files, Options, bounded, play};
use crate::session::config::Config;
use crate::session::replay::{Instruction, Recorder, Script, parse};
use crate::session::save::opening;
use crate::session::{Msg, Session, Size, Theme};
use crate::terminal::{Cast, Environment};
use crate::view::screen::{self, Paper};

/// Runs a keystroke file without a terminal and prints the last screen
#[derive(Args)]
pub struct ReplayCommand {
    /// Keystroke file
    file: PathBuf,
    /// Size of the screen, in cells
    #[arg(long, value_name = "WxH", value_parser = input::size, default_value = "120x40")]
    size: (u16, u16),
    /// Writes the screens named in the file to this directory
    #[arg(long, value_name = "DIR")]
    screens: Option<PathBuf>,
    /// Format of these screens
    #[arg(long, value_enum, default_value_t = ScreenFormat::Text, value_name = "FORMAT")]
    screen_format: ScreenFormat,
    /// Writes every frame to this file, which asciinema plays
    #[arg(long, value_name = "FILE.cast", value_parser = |text: &str| input::file(text, "a recording of frames", "cast"))]
    cast: Option<PathBuf>,
    /// Replaces what the file of --cast holds
    #[arg(long, requires = "cast")]
    force: bool,
    /// Lets the file write files, as its commands ask for
    #[arg(long)]
    allow_write: bool,
    /// Writes the files that its commands ask for in this directory, and none outside of it
    #[arg(long, value_name = "DIR", conflicts_with = "allow_write")]
    write: Option<PathBuf>,
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    looks: Looks,
}

/// The form of a screen in a file.
#[derive(Clone, Copy, ValueEnum)]
enum ScreenFormat {
    /// Its characters, in UTF-8.
    Text,
    /// A picture.
    Svg,
}

impl ReplayCommand {
    pub fn run(&self) -> Result<()> {
        let script = script(&self.file)?;
        let (width, height) = self.size;
        let mut session = Session::new(self.start.scene(None)?, Size { width, height });
        // With the user's own settings the same file could show different screens.
        session.display = self.looks.wishes(&Config::default());
        let is_light = session.display.theme == Theme::Light;
        let paper = if is_light { Paper::LIGHT } else { Paper::DARK };
        if let Some(folder) = &self.write {
            std::fs::create_dir_all(folder).map_err(Failure::unwritten(folder))?;
        }
        let may_play_write = self.allow_write || self.write.is_some();
        let files = Files { may_play_write, folder: self.write.clone(), ..Files::default() };
        let cast = self.cast.as_ref().map(|_| Cast::default());
        // The last step stands for the command that plays the file.
        let mut steps = opening(&session).map_err(Failure::Unanswered)?;
        steps.push(Instruction::Give(Msg::Run(String::new())));
        let recorder = Recorder::new(String::new(), steps);
        let options = Options { replay: Some(script), recorder, files, cast, ..Options::default() };
        let played = play(session, anywhere(), options, &Limits::PATIENT);
        if let (Some(path), Some(cast)) = (&self.cast, played.cast) {
            write(path, cast.end().as_bytes(), self.force)?;
        }
        if let Some(directory) = &self.screens {
            std::fs::create_dir_all(directory).map_err(Failure::unwritten(directory))?;
            for (name, screen) in &played.kept {
                let (ending, content) = match self.screen_format {
                    ScreenFormat::Text => ("txt", screen::text(screen)),
                    ScreenFormat::Svg => ("svg", screen::svg(screen, paper)),
                };
                let path = directory.join(format!("{name}.{ending}"));
                write(&path, content.as_bytes(), true)?;
            }
        }
        print(&screen::text(&played.screen))?;
        let why = played.unmet.map(|unmet| unmet.to_string()).or(played.unwritten);
        why.map_or(Ok(()), |why| Err(Failure::unanswered(self.file.display(), why)))
    }
}

/// A terminal with all capabilities, so that a replay looks the same wherever it runs.
fn anywhere() -> Environment {
    Environment::of(|name| match name {
        "TERM" => Some("xterm-256color".to_owned()),
        "LANG" => Some("C.UTF-8".to_owned()),
        _ => None,
    })
}

/// A keystroke file, parsed completely before anything runs.
pub fn script(file: &Path) -> Result<Script> {
    parse(&bounded::text(file)?).map_err(|error| Failure::file(file, error))
}
