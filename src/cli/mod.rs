//! The command line: one file per command.
//!
//! `hopfscope [SCENE]` opens the explorer; every other command answers one question without a terminal
//! and ends. What a command prints to standard output is its answer and nothing else; notes and errors
//! go to standard error, one line each. Exit codes: 0 answered, 1 could not be computed or written, 2 bad input.

mod basin;
mod belt;
mod branch;
mod call;
mod caller;
mod conditions;
mod cycles;
mod explore;
mod figure;
mod fit;
mod input;
mod level;
mod lists;
mod machine;
mod margin;
mod merge;
mod motion;
mod output;
mod part;
mod plan;
mod points;
mod progress;
mod replay;
mod scan;
mod settings;
mod shell;
mod sound;
mod source;
mod study;
mod study_outputs;
mod times;
mod window;

use std::ffi::OsString;
use std::sync::Arc;

use clap::{ArgMatches, Args, Command};
use explore::ExploreCommand;

pub use call::{answer, machine, scan};
pub use machine::CommandCase;

pub(super) use crate::runtime::failure::{Failure, Result};
pub(super) use caller::Call;
pub(super) use input::{given, half_widths, number, read, signed};
pub(super) use machine::{second, troubled};
pub(super) use output::{CERTIFY, Output, in_turn, print, provable, timed, write};
pub(super) use source::{QuestionOptions, SourceOptions, StartOptions};

use crate::runtime::provenance_file::words;
use crate::words::usage;

/// Runs a command with the options that were given, for a caller in this process if there is one.
type Run = Box<dyn FnOnce(&ArgMatches, Option<Caller<'_>>) -> Result<()>>;

/// A caller, and the machine that it asks about in place of what the options name.
type Caller<'a> = (&'a Arc<Call>, Option<CommandCase>);

/// A command that needs no terminal.
struct Subcommand {
    name: &'static str,
    /// Adds its options to a command.
    options: fn(Command) -> Command,
    run: Run,
}

fn row<C: Args + 'static>(name: &'static str, run: fn(&C) -> Result<()>) -> Subcommand {
    let run = move |given: &ArgMatches, _: Option<Caller>| run(&parsed(given)?);
    Subcommand { name, options: C::augment_args, run: Box::new(run) }
}

/// A command that puts a question to an oscillator or a machine.
fn question<C: Args + 'static>(
    name: &'static str,
    run: fn(&C, &QuestionOptions) -> Result<()>,
) -> Subcommand {
    let options = |command| written(C::augment_args(QuestionOptions::augment_args(command)));
    let run = move |given: &ArgMatches, caller: Option<Caller>| {
        let mut asked: QuestionOptions = parsed(given)?;
        if let Some((call, case)) = caller {
            asked.output.call = Some(Arc::clone(call));
            asked.source.case = case;
        } else {
            asked.output.check()?;
        }
        run(&parsed(given)?, &asked)
    };
    Subcommand { name, options, run: Box::new(run) }
}

/// A command whose answer `--output` writes, too; that of a fit writes its picture.
fn written(command: Command) -> Command {
    command.mut_arg("write", |option| option.visible_alias("output"))
}

/// The options that follow the name of a command.
fn given_in(words: &[String], options: fn(Command) -> Command) -> Result<ArgMatches> {
    let parser = signed(options(Command::new("hopfscope")));
    parser.try_get_matches_from(words).map_err(|error| usage::line(&error).into())
}

/// A command of its name and its options.
fn of_words<C: Args>(words: &[String]) -> Result<C> {
    parsed(&given_in(words, C::augment_args)?)
}

/// The options of a command, of those that were given.
fn parsed<C: Args>(given: &ArgMatches) -> Result<C> {
    C::from_arg_matches(given).map_err(|error| usage::line(&error).into())
}

/// The commands, in the order of the help.
fn commands() -> [Subcommand; 25] {
    [
        row("tour", explore::TourCommand::run),
        row("lesson", explore::LessonCommand::run),
        row("scenes", lists::ScenesCommand::run),
        row("keys", lists::KeysCommand::run),
        question("trajectory", motion::TrajectoryCommand::run),
        question("cycles", cycles::CyclesCommand::run),
        question("branch", branch::BranchCommand::run),
        question("border", branch::BorderCommand::run),
        question("basin", basin::BasinCommand::run),
        question("margin", margin::MarginCommand::run),
        question("kicks", margin::KicksCommand::run),
        question("level", level::LevelCommand::run),
        row("scan", scan::ScanCommand::run),
        row("merge", merge::MergeCommand::run),
        Subcommand {
            options: |command| written(belt::BeltCommand::augment_args(command)),
            ..row("belt", belt::BeltCommand::run)
        },
        Subcommand { run: Box::new(fit::run), ..row("fit", fit::FitCommand::run) },
        row("figure", figure::FigureCommand::run),
        row("sound", sound::SoundCommand::run),
        row("replay", replay::ReplayCommand::run),
        row("check", cycles::CheckCommand::run),
        row("paper", lists::PaperCommand::run),
        question("trade", motion::TradeCommand::run),
        row("extremes", lists::ExtremesCommand::run),
        row("completions", shell::CompletionsCommand::run),
        row("man", shell::ManualCommand::run),
    ]
}

/// The command line: the explorer, unless a command stands first.
fn program() -> Command {
    let program = signed(ExploreCommand::augment_args(Command::new("hopfscope")))
        .version(env!("CARGO_PKG_VERSION"))
        .about("Explorer of one oscillator: dry friction and the Hopf bifurcation")
        .long_about(include_str!("../../assets/about.txt").trim_end())
        .after_help(include_str!("../../assets/examples.txt").trim_end())
        .args_conflicts_with_subcommands(true);
    commands()
        .into_iter()
        .fold(program, |all, row| all.subcommand(signed((row.options)(Command::new(row.name)))))
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
    let command = words.get(1 + options);
    if command.is_some_and(|command| command_names().iter().any(|name| command == name)) {
        words[1..=1 + options].rotate_right(1);
    }
    words
}

/// Parses the command line of this process, runs one command and returns its exit code.
pub fn main() -> u8 {
    // At the limit of its size the write of a file fails; it does not end the program.
    #[cfg(unix)]
    drop(signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default()));
    let words = settings_last(words());
    let result = match program().try_get_matches_from(words) {
        Ok(given) => run(&given),
        Err(error) if error.use_stderr() => Err(usage::line(&error).into()),
        Err(help) => print(&help.render().to_string()),
    };
    result.map_or_else(|failure| failure.report(), |()| 0)
}

/// Runs the command that was given.
fn run(given: &ArgMatches) -> Result<()> {
    let named = given.subcommand().and_then(|(name, options)| {
        Some((commands().into_iter().find(|row| row.name == name)?, options))
    });
    match named {
        Some((row, options)) => (row.run)(options, None),
        None => parsed::<ExploreCommand>(given)?.run(&command_names()),
    }
}

fn command_names() -> Vec<&'static str> {
    commands().map(|row| row.name).to_vec()
}

#[cfg(test)]
mod tests {
    use super::input::SIGNED;
    use super::*;
    use crate::scene::library;

    #[test]
    fn the_definition_of_the_command_line_is_consistent() {
        program().debug_assert();
    }

    #[test]
    fn what_may_begin_with_a_minus_is_an_option_of_some_command() {
        let program = program();
        let all = || program.get_subcommands().chain([&program]).flat_map(Command::get_arguments);
        for name in SIGNED.split(' ') {
            let is_named = |option: &&clap::Arg| option.get_long() == Some(name);
            assert!(
                all().find(is_named).is_some_and(clap::Arg::is_allow_hyphen_values_set),
                "{name}"
            );
        }
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
            assert!(
                !commands.contains(&scene.name.as_str()),
                "hopfscope {} runs a command",
                scene.name
            );
        }
    }
}
