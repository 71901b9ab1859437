//! `hopfscope [SCENE]`: the explorer in this terminal.

use std::process::ExitCode;

use clap::Args;

use super::failure::Failure;
use super::start::Start;
use crate::runtime::{Options, explore};
use crate::session::{Session, Size};
use crate::terminal::Environment;

/// Opens the explorer.
#[derive(Debug, Args)]
pub struct Explore {
    /// Scene to open; `hopfscope scenes` lists them
    #[arg(value_name = "SCENE", conflicts_with = "scene")]
    named: Option<String>,
    #[command(flatten)]
    start: Start,
}

impl Explore {
    /// Runs the explorer until it is left, or a signal ends it.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let name = self.named.as_deref().unwrap_or(&self.start.scene);
        let scene = self.start.scene_named(name).map_err(|missing| or_command(name, missing))?;
        let environment = Environment::of_process();
        environment.admit().map_err(|refusal| Failure::Usage(refusal.to_string()))?;
        let session = Session::new(scene, Size { width: 80, height: 24 });
        let ended = explore(session, environment, Options::default())
            .map_err(|error| Failure::Unanswered(format!("terminal: {error}")))?;
        Ok(ended.code)
    }
}

/// Adds to the complaint about a scene the command that was meant, if one looks like it.
fn or_command(name: &str, missing: Failure) -> Failure {
    /// How much two names must have in common (0: nothing, 1: equal).
    const ALIKE: f64 = 0.8;
    let likeness = |command: &String| strsim::jaro(name, command);
    let commands = super::command_names().into_iter();
    match commands.max_by(|a, b| likeness(a).total_cmp(&likeness(b))) {
        Some(command) if likeness(&command) >= ALIKE => {
            Failure::Usage(format!("{missing}; or the command {command}"))
        }
        _ => missing,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_command_is_recognised() {
        let complaint = |name| or_command(name, Failure::Usage("no scene".to_owned())).to_string();
        assert_eq!(complaint("trajectry"), "no scene; or the command trajectory");
        assert_eq!(complaint("foo"), "no scene");
    }
}
