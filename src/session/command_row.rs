//! A row of the tables of commands: a command and how it is run.

use crate::scene::Layer;
use crate::session::{Candidates, Command, Context, Done, Key, NextCommand, Session};

/// How a command is run.
#[derive(Clone, Copy, Debug)]
pub(super) enum CommandAction {
    /// It changes the session; the key is the one that was pressed.
    Act(fn(&mut Session, Key)),
    /// It changes the session, unless it fails with one line that says why not.
    Try(fn(&mut Session) -> Done),
    /// It switches a layer.
    Toggle(Layer),
    /// It chooses another command to run.
    Choose(fn(&mut Session) -> Result<Option<NextCommand>, String>),
    /// It takes the words after its name, and fails with one line that says why it cannot.
    Line(fn(&mut Session, &str) -> Done),
}

#[derive(Debug)]
pub(super) struct CommandRow {
    pub(super) command: Command,
    pub(super) run: CommandAction,
}

/// A row for a command of keys.
pub(super) const fn row(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    run: CommandAction,
) -> CommandRow {
    CommandRow { command: Command { name, keys, hint, doc, arguments: "", words: None }, run }
}

/// A row for a command that takes words.
pub(super) const fn line(
    name: &'static str,
    arguments: &'static str,
    doc: &'static str,
    words: Candidates,
    run: fn(&mut Session, &str) -> Done,
) -> CommandRow {
    let command = Command { name, keys: &[], hint: "", doc, arguments, words: Some(words) };
    CommandRow { command, run: CommandAction::Line(run) }
}
