//! Everything that can be run by name: commands of keys, and commands that take words.
//!
//! This file describes them; their functions are in the tables of `session::commands` and `session::lines`.

use crate::session::state::context::Context;

/// Something that a key can do.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// Its name, for settings and the palette.
    pub name: &'static str,
    /// The contexts where it applies, with its default keys there; the first one is shown in the footer.
    pub keys: &'static [(Context, &'static [&'static str])],
    /// A word for the footer; empty if the footer has no room for it. Commands with the same word share one
    /// entry.
    pub hint: &'static str,
    /// Explanation in one line, for the help.
    pub doc: &'static str,
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Other names of commands and the names that they stand for: short ones from other programs, and former ones.
///
/// Quitting keeps the session, so `wq` has nothing else to write.
const OTHER_NAMES: [(&str, &str); 9] = [
    ("q", "quit"),
    ("q!", "quit"),
    ("wq", "quit"),
    ("x", "quit"),
    ("w", "write"),
    ("w!", "write!"),
    ("e", "open"),
    ("toggle-borders", "toggle-boundaries"),
    ("toggle-harmonic-border", "toggle-harmonic-fold"),
];

/// The name of the command that a word stands for; the word itself unless it is an alternative name.
pub fn full_name(word: &str) -> &str {
    OTHER_NAMES.iter().find(|(other, _)| *other == word).map_or(word, |(_, name)| name)
}

/// A command that takes words.
#[derive(Clone, Copy, Debug)]
pub struct LineCommand {
    pub name: &'static str,
    /// Syntax of the words after the name, for the help.
    pub arguments: &'static str,
    /// Explanation in one line, for the help.
    pub doc: &'static str,
    /// The kind of its words, for completion.
    pub words: WordKind,
}

impl PartialEq for LineCommand {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Kinds of words that a command takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordKind {
    /// Words that cannot be completed, such as a number or the name of a file.
    Unknown,
    /// Names of values, each with `=` and a value.
    Assignments,
    Methods,
    Scenes,
    /// A built-in machine.
    Machines,
    Views,
    /// A layer, then on or off.
    Layers,
    Switch,
    Window,
    /// A parameter, then a property of the cycles.
    Axes,
    /// Parameters with their values, then measures.
    Scan,
    /// The letter of a mark.
    Marks,
    Themes,
    /// A set of characters.
    Glyphs,
    /// A depth of colour.
    Colors,
}

/// The result of a command that chooses another one.
#[derive(Clone, Debug, PartialEq)]
pub enum NextCommand {
    /// A command of the palette.
    Command(&'static Command),
    /// The text of the command line.
    Line(String),
}
