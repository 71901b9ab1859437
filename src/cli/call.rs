//! Questions of a caller in this process, such as the Python package: asked in the words of the command line, answered as
//! documents, and interrupted when the caller says so.

use std::sync::{Arc, Mutex, PoisonError};

use clap::{ArgMatches, Args, Command};

use super::fit::FitCommand;
use super::scan::ScanCommand;
use super::{CommandCase, Failure, Result, commands, parsed, signed};
use crate::flow::Limits;
use crate::report::Answer;
use crate::scan::Scan;
use crate::words::provenance::Provenance;
use crate::words::usage;

/// What a caller brings along, and what it gets.
pub struct Call {
    /// The machine that it asks about, in place of one that the words name.
    pub case: Option<CommandCase>,
    interrupted: Box<dyn Fn() -> bool + Send + Sync>,
    answer: Mutex<Option<Answer>>,
}

impl Call {
    /// A call about a machine, or about what the words say; it ends when `interrupted` says so.
    pub fn new(
        case: Option<CommandCase>,
        interrupted: impl Fn() -> bool + Send + Sync + 'static,
    ) -> Self {
        Call { case, interrupted: Box::new(interrupted), answer: Mutex::default() }
    }

    /// What a question may cost.
    pub(super) fn limits(&self) -> Limits<'_> {
        Limits { interrupted: &*self.interrupted, ..Limits::PATIENT }
    }

    /// Takes what would be printed.
    pub(super) fn take(&self, answer: Answer) {
        *self.answer.lock().unwrap_or_else(PoisonError::into_inner) = Some(answer);
    }
}

/// The options that follow a command's name.
fn given(words: &[String], options: fn(Command) -> Command) -> Result<ArgMatches> {
    let parser = signed(options(Command::new("hopfscope")));
    parser.try_get_matches_from(words).map_err(|error| usage::line(&error).into())
}

/// The answer to a question, a command and its options, with its provenance; and what the program would say about an
/// answer that is incomplete, or that rests on a condition which fails.
///
/// # Errors
/// The line of the program, if there is no answer.
pub fn answer(words: &[String], call: Call) -> Result<(Answer, Option<Failure>)> {
    let call = Arc::new(call);
    let name = words.first().map_or("", String::as_str);
    let run = || {
        if name == "fit" {
            let mut fit: FitCommand = parsed(&given(words, FitCommand::augment_args)?)?;
            fit.output.call = Some(Arc::clone(&call));
            return fit.run();
        }
        let row = commands().into_iter().find(|row| row.name == name);
        let row = row.ok_or_else(|| format!("{name:?} is not a command"))?;
        (row.run)(&given(words, row.options)?, Some(&call))
    };
    let trouble = run().err();
    match (call.answer.lock().unwrap_or_else(PoisonError::into_inner).take(), trouble) {
        (Some(answer), trouble) => Ok((answer.from(&Provenance::of(words)), trouble)),
        (None, Some(trouble)) => Err(trouble),
        (None, None) => Err(format!("{name} gives no document").into()),
    }
}

/// The scan that words ask for, and its number of threads.
///
/// # Errors
/// The line of the program, if the words make no sense.
pub fn scan(words: &[String], case: Option<CommandCase>) -> Result<(Scan, Option<usize>)> {
    let mut command: ScanCommand = parsed(&given(words, ScanCommand::augment_args)?)?;
    command.source.case = case;
    Ok((command.asked()?.scan, command.jobs.map(usize::from)))
}
