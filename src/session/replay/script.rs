//! Keystroke files as data: their steps, and the messages that these give to a session.

use crate::model::Knob;
use crate::session::message::Msg;
use crate::session::message::key::Key;
use crate::session::message::pointer::Pointed;

/// Longest time in a single step, in s.
pub const LONGEST: f64 = 3600.0;

/// Maximum number of steps that are run, presses of a key one by one: those of a file, and those of the files that
/// it plays. The quickest take a tenth of a millisecond each.
pub const MOST: u64 = 100_000;

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
