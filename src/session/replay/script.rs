//! Keystroke files as data: their steps, the messages that these give to a session, and how they are written.

use std::fmt;

use thiserror::Error;

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
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}, column {column}: {}", printable::line(.why))]
pub struct ScriptError {
    /// Line, from 1; of keys from another file, that of the step that plays them.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what is allowed, in one line.
    pub why: String,
}

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
    /// A message: the mouse, `<click 1 0.5 -0.25>` on the first plot, `<click row 2>`, and `<nearer ..>` and
    /// `<farther ..>` for its wheel; text pasted at once, `<paste "text">`; time that passes, in seconds, `<elapse 0.25>`;
    /// the size of the screen, `<resize 80x24>`; a line of the command line, independently of key bindings,
    /// `<run "set D=-0.3">`; a caption, for which the explorer waits for a key, `<say "text">`; and the present state as
    /// the start of the session, with an empty history: `<start>`, or `<start D3 r>` with the parameters that are added to
    /// those of its scene.
    Give(Msg),
    /// Wait until no computation is pending: `<wait>`.
    Wait,
    /// From here on, do not wait after each key: `<async>`.
    Async,
    /// The screen must show this text on one of its rows: `<expect "text">`.
    Expect(String),
    /// Keep a picture of the screen under this name: `<screen name>`.
    Screen(String),
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
        match message {
            Msg::Key(key) => Some(Instruction::Key { key: *key, count: 1 }),
            Msg::Paste(text) | Msg::Say(text, _) if text.is_empty() => None,
            Msg::Say(text, _) => Some(Instruction::Give(Msg::Say(text.clone(), None))),
            Msg::Pointed(_)
            | Msg::Paste(_)
            | Msg::Elapsed { .. }
            | Msg::Resize { .. }
            | Msg::Run(_)
            | Msg::Start(_) => Some(Instruction::Give(message.clone())),
            Msg::Read { .. } | Msg::Answered(_) | Msg::Written(_) | Msg::Told(_) => None,
        }
    }

    /// Number of times that it is done.
    pub(super) fn length(&self) -> u64 {
        if let Instruction::Key { count, .. } = self { u64::from(*count) } else { 1 }
    }

    /// The message that a step gives to a session; for a key, that of one press.
    pub fn message(&self) -> Option<Msg> {
        match self {
            Instruction::Key { key, .. } => Some(Msg::Key(*key)),
            Instruction::Give(message) => Some(message.clone()),
            _ => None,
        }
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
            Instruction::Give(message) => out.write_str(&written(message)),
            Instruction::Wait => write!(out, "<wait>"),
            Instruction::Async => write!(out, "<async>"),
            Instruction::Expect(text) => write!(out, "<expect {}>", quoted(text)),
            Instruction::Screen(name) => write!(out, "<screen {name}>"),
            Instruction::File { name, text } => {
                write!(out, "<file {} {}>", quoted(name), quoted(text))
            }
        }
    }
}

/// A message as it is written in a file; nothing for one that results from other steps.
fn written(message: &Msg) -> String {
    match message {
        Msg::Pointed(Pointed { gesture, place }) => {
            let gesture = GESTURES.iter().find(|row| row.0 == *gesture).map_or("", |row| row.1);
            match place {
                PointerTarget::Row(row) => format!("<{gesture} row {row}>"),
                PointerTarget::Plot(index, Point { x, y }) => {
                    format!("<{gesture} {} {x:?} {y:?}>", index + 1)
                }
            }
        }
        Msg::Paste(text) => format!("<paste {}>", quoted(text)),
        Msg::Elapsed { seconds } => format!("<elapse {seconds}>"),
        Msg::Resize { width, height } => format!("<resize {width}x{height}>"),
        Msg::Run(line) => format!("<run {}>", quoted(line)),
        Msg::Say(text, _) => format!("<say {}>", quoted(text)),
        Msg::Start(names) => {
            let names: String = names.iter().flat_map(|knob| [" ", knob.spec().name]).collect();
            format!("<start{names}>")
        }
        _ => String::new(),
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
