//! The command line: one file per command.
//!
//! `hopfscope [SCENE]` opens the explorer; every other command answers one question without a terminal
//! and ends. What a command prints to standard output is its answer and nothing else; notes and errors
//! go to standard error, one line each. Exit codes: 0 answered, 1 could not be computed or written, 2 bad input.

mod belt;
mod branch;
mod cycles;
mod explore;
mod failure;
mod figure;
mod fit;
mod input;
mod lists;
mod machine;
mod margin;
mod merge;
mod motion;
mod output;
mod part;
mod places;
mod plan;
mod progress;
mod replay;
mod scan;
mod scene_cost;
mod settings;
mod shell;
mod source;
mod timing;
mod wrapped;

use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Parser, Subcommand};
use signal_hook::consts::SIGXFSZ;
use signal_hook::flag;

use crate::runtime::failure::Failure;
pub(super) use input::{given, number, read};
pub(super) use machine::{MachineCase, second, troubled};
pub(super) use output::{Certify, Output, print, write};
pub(super) use source::{SourceOptions, StartOptions};
pub(super) use timing::{in_turn, timed};

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
    command: Option<HeadlessCommand>,
    #[command(flatten)]
    explore: explore::ExploreCommand,
}

/// The commands that need no terminal.
#[derive(Debug, Subcommand)]
enum HeadlessCommand {
    Tour(explore::TourCommand),
    Scenes(lists::ScenesCommand),
    Keys(lists::KeysCommand),
    Trajectory(motion::TrajectoryCommand),
    Cycles(cycles::CyclesCommand),
    Branch(branch::BranchCommand),
    Border(branch::BorderCommand),
    Basin(margin::BasinCommand),
    Margin(margin::MarginCommand),
    Kicks(margin::KicksCommand),
    Scan(scan::ScanCommand),
    Merge(merge::MergeCommand),
    Belt(belt::BeltCommand),
    Fit(fit::FitCommand),
    Figure(figure::FigureCommand),
    Replay(replay::ReplayCommand),
    Check(cycles::CheckCommand),
    Paper(lists::PaperCommand),
    Trade(motion::TradeCommand),
    Extremes(lists::ExtremesCommand),
    Completions(shell::CompletionsCommand),
    #[command(name = "man")]
    Manual(shell::ManualCommand),
}

impl HeadlessCommand {
    fn run(&self) -> Result<ExitCode, Failure> {
        let answered = match self {
            HeadlessCommand::Tour(command) => return command.run(),
            HeadlessCommand::Scan(command) => return command.run(),
            HeadlessCommand::Merge(command) => return command.run(),
            HeadlessCommand::Scenes(command) => command.run(),
            HeadlessCommand::Keys(command) => command.run(),
            HeadlessCommand::Trajectory(command) => command.run(),
            HeadlessCommand::Cycles(command) => command.run(),
            HeadlessCommand::Branch(command) => command.run(),
            HeadlessCommand::Border(command) => command.run(),
            HeadlessCommand::Basin(command) => command.run(),
            HeadlessCommand::Margin(command) => command.run(),
            HeadlessCommand::Kicks(command) => command.run(),
            HeadlessCommand::Belt(command) => command.run(),
            HeadlessCommand::Fit(command) => command.run(),
            HeadlessCommand::Figure(command) => command.run(),
            HeadlessCommand::Replay(command) => command.run(),
            HeadlessCommand::Check(command) => command.run(),
            HeadlessCommand::Paper(command) => command.run(),
            HeadlessCommand::Trade(command) => command.run(),
            HeadlessCommand::Extremes(command) => command.run(),
            HeadlessCommand::Completions(command) => command.run(),
            HeadlessCommand::Manual(command) => command.run(),
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
        Err(help) => print(&help.render().to_string()).map(|()| ExitCode::SUCCESS),
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
