//! The bindings of keys to commands, by context.
//!
//! A [`Keymap`] is built from the default keys of all commands. Several contexts hold at once (a plot, the
//! phase plane, everywhere); no key may have two meanings in contexts that can hold together.

use std::collections::{BTreeMap, BTreeSet};

use crate::session::message::key::Key;
use crate::session::state::command::{Command, LineCommand};
use crate::session::state::context::{Context, chains};

/// The command of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Binding {
    command: &'static Command,
    /// Position of the key among those of the command.
    rank: usize,
}

/// Everything that can be run by name, and the command of each key in each context.
#[derive(Clone, Debug, PartialEq)]
pub struct Keymap {
    commands: Vec<&'static Command>,
    lines: Vec<&'static LineCommand>,
    bindings: BTreeMap<(Context, Key), Binding>,
}

/// Why a key cannot be bound to a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unbindable {
    /// The key would have two meanings in contexts that hold together.
    Clash { key: Key, command: &'static str, context: Context },
    /// A key that types a character cannot be bound where text is typed.
    Types(Key),
}

impl std::fmt::Display for Unbindable {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unbindable::Clash { key, command, context } => {
                let context = context.name();
                write!(
                    out,
                    "{key} already means {command}; give that other keys in [keys.{context}] first"
                )
            }
            Unbindable::Types(key) => {
                write!(out, "{key} types a character here; use a key that types none, as <f6>")
            }
        }
    }
}

impl Keymap {
    /// A keymap of commands with their default keys, and of commands that take words, each in the order of the
    /// help.
    pub fn new(
        commands: impl Iterator<Item = &'static Command>,
        lines: impl Iterator<Item = &'static LineCommand>,
    ) -> Self {
        let commands: Vec<_> = commands.collect();
        let mut bindings = BTreeMap::new();
        for command in &commands {
            for (context, keys) in command.keys {
                let keys = keys.iter().filter_map(|text| text.parse().ok()).enumerate();
                bindings
                    .extend(keys.map(|(rank, key)| ((*context, key), Binding { command, rank })));
            }
        }
        Keymap { commands, lines: lines.collect(), bindings }
    }

    /// All commands, in the order in which the help lists them.
    pub fn commands(&self) -> impl Iterator<Item = &'static Command> {
        self.commands.iter().copied()
    }

    /// All commands that take words, in the order in which the help lists them.
    pub fn lines(&self) -> impl Iterator<Item = &'static LineCommand> {
        self.lines.iter().copied()
    }

    pub fn named(&self, name: &str) -> Option<&'static Command> {
        self.commands().find(|command| command.name == name)
    }

    /// The command that takes words with this name.
    pub fn line(&self, name: &str) -> Option<&'static LineCommand> {
        self.lines().find(|line| line.name == name)
    }

    /// Removes all keys of a command in a context.
    pub fn unbind(&mut self, context: Context, command: &Command) {
        self.bindings.retain(|(at, _), bound| *at != context || bound.command != command);
    }

    /// Binds a key to a command in a context. Fails with [`Unbindable`] if the key means something else where
    /// this context holds, or types a character there.
    pub fn bind(
        &mut self,
        context: Context,
        command: &'static Command,
        key: Key,
    ) -> Result<(), Unbindable> {
        let together = chains().iter().filter(|chain| chain.contains(&context));
        let contexts: BTreeSet<Context> =
            together.flat_map(|chain| chain.iter()).copied().collect();
        if key.typed().is_some() && contexts.iter().any(|context| context.takes_text()) {
            return Err(Unbindable::Types(key));
        }
        let taken = contexts.iter().find_map(|at| Some((*at, *self.bindings.get(&(*at, key))?)));
        if let Some((context, bound)) = taken.filter(|(_, bound)| bound.command != command) {
            return Err(Unbindable::Clash { key, command: bound.command.name, context });
        }
        let rank = self.keys_in(context, command).count();
        self.bindings.entry((context, key)).or_insert(Binding { command, rank });
        Ok(())
    }

    /// The command of a key in contexts that hold together.
    pub fn command(&self, contexts: &[Context], key: Key) -> Option<&'static Command> {
        let mut bound = contexts.iter().filter_map(|context| self.bindings.get(&(*context, key)));
        bound.next().map(|bound| bound.command)
    }

    /// The keys of a command in a context, in the order in which they were bound.
    pub fn keys_in(&self, context: Context, command: &Command) -> impl Iterator<Item = Key> {
        let bound = self.bindings.iter();
        let of_it = bound.filter(|((at, _), bound)| *at == context && bound.command == command);
        let mut keys: Vec<(usize, Key)> =
            of_it.map(|((_, key), bound)| (bound.rank, *key)).collect();
        keys.sort_unstable();
        keys.into_iter().map(|(_, key)| key)
    }

    /// The first key of the command with this name, for texts that say what to press.
    pub fn key_of(&self, name: &str) -> Option<Key> {
        let (_, keys) = self.places(self.named(name)?).into_iter().next()?;
        keys.first().copied()
    }

    /// A sentence in which each `{command}` is replaced by the first key of that command, as `write` names it.
    pub fn fill(&self, sentence: &str, write: impl Fn(Key) -> String) -> String {
        let mut filled = String::new();
        let mut rest = sentence;
        while let Some((before, (name, after))) =
            rest.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
        {
            filled += before;
            match self.key_of(name) {
                Some(key) => filled += &write(key),
                // A command without a key is found in the palette by its name.
                None => filled += name,
            }
            rest = after;
        }
        filled + rest
    }

    pub fn places(&self, command: &Command) -> Vec<(Context, Vec<Key>)> {
        let contexts = command.keys.iter().map(|(context, _)| *context);
        contexts
            .map(|context| (context, self.keys_in(context, command).collect::<Vec<_>>()))
            .filter(|(_, keys)| !keys.is_empty())
            .collect()
    }
}
