//! A row of the table of commands: a command and how it is run.

use crate::scene::Layer;
use crate::session::effect::Done;
use crate::session::message::key::Key;
use crate::session::state::{Command, Context, NextCommand, Session};

/// The function of a command; its key is the one that was pressed.
pub(super) type Act = fn(&mut Session, Key);

/// The function of a command that chooses another one.
pub(super) type Choose = fn(&mut Session) -> Result<Option<NextCommand>, String>;

/// How a command is run.
#[derive(Clone, Copy, Debug)]
pub(super) enum CommandAction {
    /// It changes the session.
    Act(Act),
    /// It changes the session, unless it fails with one line that says why not.
    Try(fn(&mut Session) -> Done),
    /// It switches a layer.
    Toggle(Layer),
    /// It chooses another command to run.
    Choose(Choose),
}

#[derive(Debug)]
pub(super) struct CommandRow {
    pub(super) command: Command,
    pub(super) run: CommandAction,
}

/// A row of the table.
pub(super) const fn row(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    act: Act,
) -> CommandRow {
    CommandRow { command: Command { name, keys, hint, doc }, run: CommandAction::Act(act) }
}

/// A row of the table for a command that may be refused.
pub(super) const fn tries(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    act: fn(&mut Session) -> Done,
) -> CommandRow {
    CommandRow { command: Command { name, keys, hint, doc }, run: CommandAction::Try(act) }
}

/// A row of the table for a command that chooses another one.
pub(super) const fn chooses(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    choose: Choose,
) -> CommandRow {
    CommandRow { command: Command { name, keys, hint, doc }, run: CommandAction::Choose(choose) }
}
