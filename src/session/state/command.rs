//! What has a name and can be run: commands of keys, and commands that take words.
//!
//! Here stands what is said about them; what they do stands in the tables of `session::commands` and
//! `session::lines`.

use crate::session::state::context::Context;

/// Something that a key can do.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// Its name, for settings and the palette.
    pub name: &'static str,
    /// Where it applies, and its default keys there, the first one shown in the footer.
    pub keys: &'static [(Context, &'static [&'static str])],
    /// A word for the footer; empty where the footer has more important things to say. Commands with
    /// the same word share it.
    pub hint: &'static str,
    /// What it does, in one line for the help.
    pub doc: &'static str,
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Other names of commands, and what those are called here: short ones that other programs have, and former ones.
///
/// Leaving keeps the session, so that `wq` has nothing else to write.
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

/// The name of the command that a word stands for: itself, unless it is another one.
pub fn full_name(word: &str) -> &str {
    OTHER_NAMES.iter().find(|(other, _)| *other == word).map_or(word, |(_, name)| name)
}

/// A command that takes words.
#[derive(Clone, Copy, Debug)]
pub struct LineCommand {
    pub name: &'static str,
    /// What follows the name, for the help.
    pub arguments: &'static str,
    /// What it does, in one line for the help.
    pub doc: &'static str,
    /// What its words can be, to complete them.
    pub words: Words,
}

impl PartialEq for LineCommand {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// What the words of a command can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// Nothing that is known here, such as a number or the name of a file.
    Unknown,
    /// Names of values with `=` and a value.
    Assignments,
    Methods,
    Scenes,
    /// A machine of the program.
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
    /// The letter of a register.
    Registers,
    Themes,
    /// A set of characters.
    Glyphs,
    /// A depth of colour.
    Colors,
}

/// What a command chooses to be run in its place.
#[derive(Clone, Debug, PartialEq)]
pub enum Chosen {
    /// A command of the palette.
    Command(&'static Command),
    /// The text of the command line.
    Line(String),
}
