//! Questions of a caller in this process, such as the Python package: asked in the words of the command line, answered as
//! documents, and interrupted when the caller says so.

use std::sync::{Arc, Mutex, PoisonError};

use super::scan::ScanCommand;
use super::{CommandCase, Failure, Result, SourceOptions, commands, given_in, of_words};
use crate::flow::Limits;
use crate::report::Answer;
use crate::scan::Scan;
use crate::words::provenance::Provenance;

/// Where a caller waits for an answer.
pub struct Call {
    interrupted: Box<dyn Fn() -> bool + Send + Sync>,
    answer: Mutex<Option<Answer>>,
}

impl Call {
    /// A call that ends when `interrupted` says so.
    pub fn new(interrupted: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Call { interrupted: Box::new(interrupted), answer: Mutex::default() }
    }

    /// What a question may cost.
    pub fn limits(&self) -> Limits<'_> {
        Limits { interrupted: &*self.interrupted, ..Limits::PATIENT }
    }

    /// Puts down what would be printed; returns what was there.
    pub fn replace(&self, answer: Option<Answer>) -> Option<Answer> {
        std::mem::replace(&mut *self.answer.lock().unwrap_or_else(PoisonError::into_inner), answer)
    }
}

/// The answer to a question, a command and its options, about a machine if one is given, with its provenance; and what the program would
/// say about an answer that is incomplete, or that rests on a condition which fails.
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
