//! Questions of a caller in this process, such as the Python package: asked in the words of the command line, answered as
//! documents, and interrupted when the caller says so.

use std::sync::Arc;

use super::scan::ScanCommand;
use super::{Call, CommandCase, Failure, Result, SourceOptions, commands, given_in, of_words};
use crate::report::Answer;
use crate::scan::Scan;
use crate::words::provenance::Provenance;

/// The answer to a question, a command and its options, about a machine if one is given, with its provenance; and what
/// the program would say about an answer that is incomplete, or that rests on a condition which fails.
///
/// # Errors
/// The line of the program, if there is no answer.
pub fn answer(
    words: &[String],
    case: Option<CommandCase>,
    interrupted: impl Fn() -> bool + Send + Sync + 'static,
) -> Result<(Answer, Option<Failure>)> {
    let call = Arc::new(Call::new(interrupted));
    let name = words.first().map_or("", String::as_str);
    let asked = [words, &["--format", "json"].map(str::to_owned)].concat();
    let run = || {
        let row = commands().into_iter().find(|row| row.name == name);
        let row = row.ok_or_else(|| format!("{name:?} is not a command"))?;
        (row.run)(&given_in(&asked, row.options)?, Some((&call, case)))
    };
    let trouble = run().err();
    match (call.replace(None), trouble) {
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
    let mut command: ScanCommand = of_words(words)?;
    command.source.case = case;
    Ok((command.asked()?.scan, command.jobs.map(usize::from)))
}

/// The machine that words name, or that a text with a name describes in place of a file, with the numbers that they set.
///
/// # Errors
/// The line of the program, if there is none.
pub fn machine(words: &[String], text: Option<(&str, &str)>) -> Result<CommandCase> {
    let words = [&["machine".to_owned()], words].concat();
    let mut options: SourceOptions = of_words(&words)?;
    options.case = text.map(|(name, text)| CommandCase::written(name, text)).transpose()?;
    options.machine()?.ok_or("which machine?")?.checked()
}
