//! Everything that can be run by name, commands of keys and commands that take words, and the bindings of keys to
//! commands, by context.
//!
//! This file describes commands: their lines are in `assets/commands.txt`, what they do in `session::commands`. A
//! [`Keymap`] is built from the default keys of all commands. Several contexts, in which keys have their meanings,
//! hold at once (a plot, the phase plane, everywhere); no key may have two meanings in contexts that can hold
//! together.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use strum::EnumString;

use crate::numerics::{cells, named};
use crate::scene::{Layer, VIEWS, View, ViewSpec};
use crate::session::{Done, Key, ListKind, Session};

/// Something that a key can do, or a line with words.
#[derive(Debug)]
pub struct Command {
    /// Its name, for settings and the palette.
    pub name: &'static str,
    /// The contexts where it applies, with its default keys there; the first one is shown in the footer. A command
    /// that takes words has none.
    pub keys: Vec<(Context, Vec<Key>)>,
    /// A word for the footer; empty if the footer has no room for it. Commands with the same word share one
    /// entry. Of a command that takes words, the row in the list of everything that does the same, if there is one.
    pub hint: &'static str,
    /// Explanation in one line, for the help.
    pub doc: &'static str,
    /// Syntax of the words after the name, for the help.
    pub arguments: &'static str,
    pub run: CommandAction,
    /// The steps by which it moves something.
    pub by: [i32; 2],
    /// What it waits for, in words of the file of commands.
    pub needs: &'static str,
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Command {
    /// What completes the words after its name; `None` if it takes none.
    pub fn words(&self) -> Option<Candidates> {
        if let CommandAction::Line(words, _) = self.run {
            Some(words)
        } else {
            None
        }
    }

    /// The contexts where it applies.
    pub fn contexts(&self) -> impl Iterator<Item = Context> + Clone {
        self.keys.iter().map(|(context, _)| *context)
    }
}

/// How a command is run.
#[derive(Clone, Copy, Debug)]
pub enum CommandAction {
    /// It changes the session.
    Act(fn(&mut Session)),
    /// It changes the session by the key that was pressed.
    Press(fn(&mut Session, Key)),
    /// It moves something by some steps, to the right or onwards, and upwards.
    Move(fn(&mut Session, [i32; 2])),
    /// It changes the session, unless it fails with one line that says why not.
    Try(fn(&mut Session) -> Done),
    /// It switches a layer.
    Toggle(Layer),
    /// It takes the words after its name, which the first function completes; the second one fails with one line that
    /// says why it cannot.
    Line(Candidates, fn(&mut Session, &str) -> Done),
}

/// The file of commands.
pub const COMMANDS: &str = include_str!("../../../assets/commands.txt");

/// The name of the command that a word stands for; the word itself unless it is another name of a command.
pub fn full_name(word: &str) -> &str {
    static OTHERS: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
        let others = COMMANDS.lines().filter_map(|line| line.strip_prefix("= ")?.split_once(": "));
        others.flat_map(|(name, words)| words.split(' ').map(move |word| (word, name))).collect()
    });
    OTHERS.get(word).copied().unwrap_or(word)
}

/// The name of the command that a line calls, and the words after it: assignments alone are those of `set`.
pub fn called(line: &str) -> (&str, &str) {
    let line = line.trim();
    let assigned = line.split_once('=').map_or("", |(name, _)| name.trim());
    if !assigned.is_empty() && assigned.chars().all(|it| it.is_ascii_alphanumeric() || it == '_') {
        return ("set", line);
    }
    let (name, words) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    (full_name(name), words.trim())
}

/// Candidates for the last of the words after the name of a command.
pub type Candidates = fn(&Session, &[&str]) -> Vec<String>;

/// Everything that can be run by name, and the command of each key in each context.
#[derive(Clone, Debug, PartialEq)]
pub struct Keymap {
    commands: &'static [Command],
    /// The keys of each context with their commands, in the order in which they were bound.
    bindings: BTreeMap<Context, Vec<(Key, &'static Command)>>,
}

impl Keymap {
    /// A keymap of commands with their default keys, in the order of the help.
    pub fn new(commands: &'static [Command]) -> Self {
        let mut bindings: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for command in commands {
            for (context, keys) in &command.keys {
                let bound = keys.iter().map(|key| (*key, command));
                bindings.entry(*context).or_default().extend(bound);
            }
        }
        Keymap { commands, bindings }
    }

    /// All commands of keys, in the order in which the help lists them.
    pub fn commands(&self) -> impl Iterator<Item = &'static Command> {
        self.commands.iter().filter(|command| command.words().is_none())
    }

    /// All commands that take words, in the order in which the help lists them.
    pub fn lines(&self) -> impl Iterator<Item = &'static Command> {
        self.commands.iter().filter(|command| command.words().is_some())
    }

    /// The command of keys with this name.
    pub fn named(&self, name: &str) -> Option<&'static Command> {
        self.commands().find(|command| command.name == name)
    }

    /// The command that takes words with this name.
    pub fn line(&self, name: &str) -> Option<&'static Command> {
        self.lines().find(|line| line.name == name)
    }

    /// Removes all keys of a command in a context.
    pub fn unbind(&mut self, context: Context, command: &Command) {
        if let Some(bindings) = self.bindings.get_mut(&context) {
            bindings.retain(|(_, bound)| *bound != command);
        }
    }

    /// Binds a key to a command in a context. Fails with one line if the key means something else where this
    /// context holds, or types a character there.
    pub fn bind(&mut self, context: Context, command: &'static Command, key: Key) -> Done {
        let chains = CONTEXTS.iter().map(|row| &row.chain);
        let together = chains.filter(|chain| chain.contains(&context)).flatten().copied();
        let together: BTreeSet<Context> = together.collect();
        if key.typed().is_some() && together.iter().any(|at| at.takes_text()) {
            return Err(format!(
                "{key} types a character here; use a key that types none, as <f6>"
            ));
        }
        let taken = together.into_iter().find_map(|at| Some((at, self.bound(at, key)?)));
        if let Some((at, bound)) = taken.filter(|(_, bound)| *bound != command) {
            let (bound, at) = (bound.name, at.spec().name);
            return Err(format!(
                "{key} already means {bound}; give that other keys in [keys.{at}] first"
            ));
        }
        if self.bound(context, key).is_none() {
            self.bindings.entry(context).or_default().push((key, command));
        }
        Ok(())
    }

    /// The command of a key in a context.
    fn bound(&self, context: Context, key: Key) -> Option<&'static Command> {
        self.bindings.get(&context)?.iter().find(|(own, _)| *own == key).map(|(_, bound)| *bound)
    }

    /// The command of a key in contexts that hold together.
    pub fn command(&self, contexts: &[Context], key: Key) -> Option<&'static Command> {
        contexts.iter().find_map(|context| self.bound(*context, key))
    }

    /// The keys of a command in a context, in the order in which they were bound.
    pub fn keys_in(&self, context: Context, command: &Command) -> impl Iterator<Item = Key> {
        let bound = self.bindings.get(&context).into_iter().flatten();
        bound.filter(move |(_, bound)| *bound == command).map(|(key, _)| *key)
    }

    /// The first key of the command with this name, for texts that say what to press.
    pub fn key_of(&self, name: &str) -> Option<Key> {
        let command = self.named(name)?;
        command.contexts().find_map(|context| self.keys_in(context, command).next())
    }

    /// A sentence in which each `{command}` is replaced by the first key of that command, as `write` names it.
    pub fn fill(&self, sentence: &str, write: impl Fn(Key) -> String) -> String {
        let mut filled = String::new();
        let mut rest = sentence;
        while let Some((before, (name, after))) =
            rest.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
        {
            filled += before;
            // A command without a key is found in the palette by its name.
            filled += &self.key_of(name).map_or_else(|| name.to_owned(), &write);
            rest = after;
        }
        filled + rest
    }

    pub fn places(&self, command: &Command) -> Vec<(Context, Vec<Key>)> {
        let bound = |context| (context, self.keys_in(context, command).collect::<Vec<_>>());
        command.contexts().map(bound).filter(|(_, keys)| !keys.is_empty()).collect()
    }
}

/// A context in which a key can have a meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum Context {
    /// The focus is on the parameter pane.
    Parameters,
    /// The focus is on a plot that shows this view.
    #[strum(disabled)]
    View(View),
    /// A point of the branch is held.
    Walk,
    /// The size of a kick is being tried.
    Kick,
    /// The focus is on a plot.
    Plots,
    /// No overlay is open.
    Everywhere,
    /// The page of help is open.
    Page,
    /// This list is open and not being searched; that of the costs has the keys of the palette.
    #[strum(disabled)]
    List(ListKind),
    /// The palette is being searched.
    Palette,
    /// A count is being typed before a key.
    Count,
    /// The next key is the letter of a mark.
    Letter,
    /// Some list is open.
    Lists,
    /// The search of a list is being typed.
    Search,
    /// A value is being typed.
    Entry,
    /// A command is being typed.
    Prompt,
    /// A pasted keystroke file waits for a yes.
    Offer,
    /// Something is being explained.
    Explanation,
    Always,
}

/// The description of a context.
#[derive(Debug)]
pub struct ContextSpec {
    pub context: Context,
    /// Its name in settings files.
    pub name: &'static str,
    /// A heading for its keys.
    pub title: &'static str,
    /// The contexts that hold together where it is the most specific, which is the first of them; none if it never is.
    pub chain: Vec<Context>,
    /// The same while a kick is being tried, whose keys come first.
    pub kicked: Vec<Context>,
}

/// All contexts, those of the views after the first one: the lines of `assets/contexts.txt`.
pub static CONTEXTS: LazyLock<Vec<ContextSpec>> = LazyLock::new(|| {
    let lines = include_str!("../../../assets/contexts.txt").lines();
    let mut all: Vec<ContextSpec> = lines.filter_map(cells).filter_map(described).collect();
    let of_view = |row: &ViewSpec| {
        let others = match row.view {
            // A scan has a cursor and keys of its own.
            View::Scan => "everywhere always",
            _ => "plots everywhere always",
        };
        described([row.name, row.heading, others])
    };
    all.splice(1..1, VIEWS.iter().filter_map(of_view));
    all
});

/// A context by its name, its heading and the names of those that hold with it.
fn described([name, title, others]: [&'static str; 3]) -> Option<ContextSpec> {
    let context = Context::named(name)?;
    let others = others.split(' ').map(Context::named).collect::<Option<Vec<_>>>();
    let chain = others.map(|others| [&[context], &others[..]].concat()).unwrap_or_default();
    let kicked = [&[Context::Kick], &chain[..]].concat();
    Some(ContextSpec { context, name, title, chain, kicked })
}

impl Context {
    /// The context of this name.
    pub fn named(name: &str) -> Option<Self> {
        let of_list = || Some(Context::List(name.parse().ok()?));
        let of_view = || named(name).map(Context::View);
        name.parse().ok().or_else(of_list).or_else(of_view)
    }

    /// The description of this context.
    pub fn spec(self) -> &'static ContextSpec {
        CONTEXTS.iter().find(|row| row.context == self).expect("every context has its line")
    }

    /// Whether characters that are no commands are typed into a line.
    pub fn takes_text(self) -> bool {
        matches!(self, Context::Palette | Context::Search | Context::Entry | Context::Prompt)
    }

    /// Whether this context holds only while something is open or awaited.
    pub fn is_overlay(self) -> bool {
        use Context::{Always, Everywhere, Kick, Parameters, Plots, View, Walk};
        !matches!(self, Parameters | View(_) | Walk | Kick | Plots | Everywhere | Always)
    }

    /// The view that must have the focus for this context to hold; `None` if it depends on no view.
    pub fn view(self) -> Option<View> {
        if let Context::View(view) = self {
            Some(view)
        } else {
            None
        }
    }
}
