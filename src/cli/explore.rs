//! `hopfscope [SCENE]`: the explorer in this terminal.

use clap::Args;

use super::failure::Failure;
use super::start::Start;
use crate::terminal::capabilities::Environment;

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
    /// Runs the explorer until it is left.
    pub fn run(&self) -> Result<(), Failure> {
        let name = self.named.as_deref().unwrap_or(&self.start.scene);
        let _scene = self.start.scene_named(name).map_err(|missing| or_command(name, missing))?;
        Environment::of_process().admit().map_err(|refusal| Failure::Usage(refusal.to_string()))?;
        Err(Failure::Unanswered("the explorer is not in this build".to_owned()))
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
