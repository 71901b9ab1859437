//! The command line: one file per command.
//!
//! `hopfscope [SCENE]` opens the explorer; every other command answers one question without a terminal
//! and ends. What a command prints to standard output is its answer and nothing else; notes and errors
//! go to standard error, one line each. Exit codes: 0 answered, 1 could not be computed or written, 2 bad input.

mod basin;
mod belt;
mod border;
mod branch;
mod check;
mod config;
mod cycles;
mod explore;
mod extremes;
mod failure;
mod figure;
mod fit;
mod input;
mod keys;
mod kicks;
mod look;
mod machine;
mod margin;
mod merge;
mod output;
mod paper;
mod part;
mod places;
mod plan;
mod progress;
mod replay;
mod scan;
mod scene_cost;
mod scenes;
mod shell;
mod source;
mod start;
mod timing;
mod tour;
mod trade;
mod trajectory;
mod wrapped;

use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Parser, Subcommand};
use signal_hook::consts::SIGXFSZ;
use signal_hook::flag;

use failure::Failure;

/// Commands for a first try, below the help text.
const EXAMPLES: &str = "\
Examples:
  hopfscope                            the explorer: ? lists the keys, q leaves
  hopfscope supercritical              the same, with a lesson; `hopfscope scenes` lists all
  hopfscope tour                       a tour of the explorer
  hopfscope cycles --set D=-0.3        the limit cycles and the basin at these numbers, as text
  hopfscope figure fig17 --output fig17.svg";

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "hopfscope",
    version,
    about = "Explorer of one oscillator: dry friction and the Hopf bifurcation",
    long_about = "Explorer of one oscillator, q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q = friction within -r .. r: \
                  how dry friction turns a Hopf bifurcation into a set of equilibria with a basin that one \
                  must know.\n\nWithout a command: the explorer in this terminal. With one: an answer on \
                  standard output.",
    after_help = EXAMPLES,
    args_conflicts_with_subcommands = true
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    explore: explore::Explore,
}

/// The commands that need no terminal.
#[derive(Debug, Subcommand)]
enum Command {
    Tour(tour::Arguments),
    Scenes(scenes::Arguments),
    Keys(keys::Arguments),
    Trajectory(trajectory::Arguments),
    Cycles(cycles::Arguments),
    Branch(branch::Arguments),
    Border(border::Arguments),
    Basin(basin::Arguments),
    Margin(margin::Arguments),
    Kicks(kicks::Arguments),
    Scan(scan::ScanCommand),
    Merge(merge::Arguments),
    Belt(belt::Arguments),
    Fit(fit::Arguments),
    Figure(figure::Arguments),
    Replay(replay::Arguments),
    Check(check::Arguments),
    Paper(paper::Arguments),
    Trade(trade::Arguments),
    Extremes(extremes::Arguments),
    Completions(shell::Completions),
    #[command(name = "man")]
    Manual(shell::Manual),
}

impl Command {
    fn run(&self) -> Result<ExitCode, Failure> {
        let answered = match self {
            Command::Scan(command) => return command.run(),
            Command::Merge(command) => return command.run(),
            Command::Tour(command) => return command.run(),
            Command::Trajectory(command) => command.run(),
            Command::Cycles(command) => command.run(),
            Command::Check(command) => command.run(),
            Command::Branch(command) => command.run(),
            Command::Basin(command) => command.run(),
            Command::Margin(command) => command.run(),
            Command::Kicks(command) => command.run(),
            Command::Border(command) => command.run(),
            Command::Paper(command) => command.run(),
            Command::Belt(command) => command.run(),
            Command::Trade(command) => command.run(),
            Command::Figure(command) => command.run(),
            Command::Fit(command) => command.run(),
            Command::Scenes(command) => command.run(),
            Command::Keys(command) => command.run(),
            Command::Extremes(command) => command.run(),
            Command::Replay(command) => command.run(),
            Command::Completions(command) => command.run(),
            Command::Manual(command) => command.run(),
        };
        answered.map(|()| ExitCode::SUCCESS)
    }
}

/// Moves the options `--config` and `--no-config` from before a command to after it. Before a command they would
/// be options of the explorer, which exclude commands; but some commands have them, too.
fn settings_last(mut words: Vec<OsString>) -> Vec<OsString> {
    let named = words.iter().skip(1).take_while(|word| {
        let word = word.to_string_lossy();
        word.starts_with("--config") || word == "--no-config"
    });
    let separate = words.get(1).is_some_and(|word| word == "--config");
    let options = if separate { 2 } else { named.count() };
    let command = words.get(1 + options).map(|word| word.to_string_lossy().into_owned());
    if command.is_some_and(|command| command_names().contains(&command)) {
        words[1..=1 + options].rotate_right(1);
    }
    words
}

/// Parses the command line of this process, runs one command and returns its exit code.
pub fn main() -> ExitCode {
    // At the limit of its size the write of a file fails; it does not end the program.
    drop(flag::register(SIGXFSZ, Arc::default()));
    let result = match Cli::try_parse_from(settings_last(std::env::args_os().collect())) {
        Ok(Cli { command: Some(command), .. }) => command.run(),
        Ok(Cli { command: None, explore }) => explore.run(),
        Err(error) if error.use_stderr() => Err(Failure::from_parser(&error)),
        Err(help) => output::print(&help.render().to_string()).map(|()| ExitCode::SUCCESS),
    };
    result.unwrap_or_else(|failure| failure.report())
}

fn command_names() -> Vec<String> {
    use clap::CommandFactory;
    Cli::command().get_subcommands().map(|command| command.get_name().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;
    use crate::scene::library;

    #[test]
    fn the_definition_of_the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_settings_file_can_be_named_before_the_command() {
        for (given, taken) in [
            ("h --config F keys --format csv", "h keys --config F --format csv"),
            ("h --config=F keys", "h keys --config=F"),
            ("h --no-config tour", "h tour --no-config"),
            ("h --config F linear", "h --config F linear"),
            ("h keys --config F", "h keys --config F"),
            ("h", "h"),
            ("h --config", "h --config"),
        ] {
            let words = given.split(' ').map(OsString::from).collect();
            let words: Vec<_> = settings_last(words);
            assert_eq!(words.join(&OsString::from(" ")), OsString::from(taken));
        }
    }

    #[test]
    fn no_scene_hides_behind_a_command() {
        let commands = command_names();
        for scene in library() {
            assert!(!commands.contains(&scene.name), "hopfscope {} runs a command", scene.name);
        }
    }
}
