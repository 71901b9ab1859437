//! Keystroke files as data: their steps, the messages that these give to a session, and how they are written.

use std::fmt;

use crate::model::Knob;
use crate::scene::Point;
use crate::session::{Gesture, Key, Msg, Pointed, PointerTarget};
use crate::words::printable;

/// Longest time in a single step, in s.
pub const LONGEST: f64 = 3600.0;

/// Maximum number of steps that are run, presses of a key one by one: those of a file, and those of the files that
/// it plays. The quickest take a tenth of a millisecond each.
pub const MOST: u32 = 100_000;

/// Characters that are escaped by a backslash in quoted text, and the letters after it.
pub(super) const ESCAPES: [(char, char); 5] =
    [('"', '"'), ('\\', '\\'), ('\n', 'n'), ('\r', 'r'), ('\t', 't')];

/// What the mouse does, by the words for it. Positions refer to the plots, not to the screen, so that a file has the
/// same effect at every size.
pub(super) const GESTURES: [(Gesture, &str); 3] =
    [(Gesture::Click, "click"), (Gesture::Nearer, "nearer"), (Gesture::Farther, "farther")];

/// Why a text is no keystroke file, or why its replay ends early: the screen does not show an expected text, or there
/// are too many keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// Line, from 1; of keys from another file, that of the step that plays them.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what is allowed, in one line.
    pub why: String,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, why } = self;
        write!(out, "line {line}, column {column}: {}", printable::line(why))
    }
}

impl std::error::Error for ScriptError {}

/// Why a file with more steps is not run.
pub(super) fn too_long() -> String {
    format!(
        "with what is played here there are more than {MOST} keys, the most that a file may press"
    )
}

/// One instruction of a keystroke file.
#[derive(Clone, Debug, PartialEq)]
pub enum Instruction {
    /// A key, pressed this many times: `x`, `<right>`, `<right*5>`.
    Key { key: Key, count: u32 },
    /// The mouse: `<click 1 0.5 -0.25>` on the first plot, `<click row 2>`; `<nearer ..>` and `<farther ..>` for its wheel.
    Pointed(Pointed),
    /// Text pasted at once: `<paste "text">`.
    Paste(String),
    /// Time passes, in seconds: `<elapse 0.25>`.
    Elapse(f64),
    /// Wait until no computation is pending: `<wait>`.
    Wait,
    /// From here on, do not wait after each key: `<async>`.
    Async,
    /// Set the size of the screen: `<resize 80x24>`.
    Resize { width: u16, height: u16 },
    /// The screen must show this text on one of its rows: `<expect "text">`.
    Expect(String),
    /// Run a line of the command line, independently of key bindings: `<run "set D=-0.3">`.
    Run(String),
    /// Show a caption and, in the explorer, wait for a key: `<say "text">`.
    Say(String),
    /// Keep a picture of the screen under this name: `<screen name>`.
    Screen(String),
    /// Make the present state the start of the session, with an empty history: `<start>`, or `<start D3 r>`
    /// with the parameters that are added to those of its scene.
    Start(Vec<Knob>),
    /// Embed a file: a command that reads a file of this name during the replay gets this text. `<file "a.toml"
    /// "text">`.
    File {
        /// The name by which the file is asked for.
        name: String,
        text: String,
    },
}

impl Instruction {
    /// The step that gives this message; `None` for a message that results from other steps.
    pub fn of(message: &Msg) -> Option<Self> {
        Some(match message {
            Msg::Key(key) => Instruction::Key { key: *key, count: 1 },
            Msg::Pointed(pointed) => Instruction::Pointed(*pointed),
            Msg::Paste(text) if !text.is_empty() => Instruction::Paste(text.clone()),
            Msg::Elapsed { seconds } => Instruction::Elapse(*seconds),
            Msg::Resize { width, height } => Instruction::Resize { width: *width, height: *height },
            Msg::Run(line) => Instruction::Run(line.clone()),
            Msg::Say(text, _) if !text.is_empty() => Instruction::Say(text.clone()),
            Msg::Start(names) => Instruction::Start(names.clone()),
            Msg::Paste(_)
            | Msg::Say(..)
            | Msg::Read { .. }
            | Msg::Answered(_)
            | Msg::Idle
            | Msg::Written(_)
            | Msg::Told(_) => return None,
        })
    }

    /// Number of times that it is done.
    pub(super) fn length(&self) -> u64 {
        if let Instruction::Key { count, .. } = self { u64::from(*count) } else { 1 }
    }

    /// The message that a step gives to a session; for a key, that of one press.
    pub fn message(&self) -> Option<Msg> {
        Some(match self {
            Instruction::Key { key, .. } => Msg::Key(*key),
            Instruction::Pointed(pointed) => Msg::Pointed(*pointed),
            Instruction::Paste(text) => Msg::Paste(text.clone()),
            Instruction::Elapse(seconds) => Msg::Elapsed { seconds: *seconds },
            Instruction::Resize { width, height } => Msg::Resize { width: *width, height: *height },
            Instruction::Run(line) => Msg::Run(line.clone()),
            Instruction::Say(text) => Msg::Say(text.clone(), None),
            Instruction::Start(names) => Msg::Start(names.clone()),
            Instruction::Wait
            | Instruction::Async
            | Instruction::Expect(_)
            | Instruction::Screen(_)
            | Instruction::File { .. } => {
                return None;
            }
        })
    }
}

/// A step and its place in the file, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptStep {
    pub line: usize,
    pub column: usize,
    pub step: Instruction,
}

/// A parsed keystroke file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Its steps, in order.
    pub steps: Vec<ScriptStep>,
}

impl Script {
    /// A file of these steps.
    pub fn of(steps: Vec<Instruction>) -> Self {
        let located = (1..).zip(steps).map(|(column, step)| ScriptStep { line: 1, column, step });
        Script { steps: located.collect() }
    }

    /// Number of steps, presses of a key one by one.
    pub fn length(&self) -> u64 {
        self.steps.iter().map(|located| located.step.length()).sum()
    }

    /// Number of key presses.
    pub fn keys(&self) -> u64 {
        let presses = |located: &ScriptStep| match located.step {
            Instruction::Key { count, .. } => u64::from(count),
            _ => 0,
        };
        self.steps.iter().map(presses).sum()
    }
}

/// Text that the parser can read back.
impl fmt::Display for Instruction {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Instruction::Key { key, count: 1 } => write!(out, "{key}"),
            Instruction::Key { key, count } => {
                let key = key.to_string();
                let name = key.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
                write!(out, "<{}*{count}>", name.unwrap_or(&key))
            }
            Instruction::Pointed(Pointed { gesture, place }) => {
                let gesture = GESTURES.iter().find(|row| row.0 == *gesture).map_or("", |row| row.1);
                match place {
                    PointerTarget::Row(row) => write!(out, "<{gesture} row {row}>"),
                    PointerTarget::Plot(index, Point { x, y }) => {
                        write!(out, "<{gesture} {} {x:?} {y:?}>", index + 1)
                    }
                }
            }
            Instruction::Paste(text) => write!(out, "<paste {}>", quoted(text)),
            Instruction::Elapse(seconds) => write!(out, "<elapse {seconds}>"),
            Instruction::Wait => write!(out, "<wait>"),
            Instruction::Async => write!(out, "<async>"),
            Instruction::Resize { width, height } => write!(out, "<resize {width}x{height}>"),
            Instruction::Expect(text) => write!(out, "<expect {}>", quoted(text)),
            Instruction::Run(line) => write!(out, "<run {}>", quoted(line)),
            Instruction::Say(text) => write!(out, "<say {}>", quoted(text)),
            Instruction::Screen(name) => write!(out, "<screen {name}>"),
            Instruction::Start(names) => {
                write!(out, "<start")?;
                names.iter().try_for_each(|symbol| write!(out, " {}", symbol.spec().name))?;
                write!(out, ">")
            }
            Instruction::File { name, text } => {
                write!(out, "<file {} {}>", quoted(name), quoted(text))
            }
        }
    }
}

/// Text in quotes on one line, with exactly the escapes that the parser knows.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for char in text.chars() {
        match ESCAPES.iter().find(|(plain, _)| *plain == char) {
            Some((_, letter)) => quoted.extend(['\\', *letter]),
            None => quoted.push(char),
        }
    }
    quoted.push('"');
    quoted
}
