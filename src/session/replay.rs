//! Keystroke files: their steps.

use super::key::Key;

/// One instruction of a keystroke file.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A key, pressed so many times.
    Key {
        /// The key.
        key: Key,
        /// How many times.
        count: u32,
    },
    /// Go on when no computation is pending.
    Wait,
    /// From here on, do not wait after each key.
    Async,
    /// Give the screen this size.
    Resize {
        /// Columns.
        width: u16,
        /// Rows.
        height: u16,
    },
    /// The screen must show this text.
    Expect(String),
    /// Keep the screen under this name.
    Screen(String),
}

/// A step and where it stands, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
    /// The step.
    pub step: Step,
}

/// A keystroke file, read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Its steps, in order.
    pub steps: Vec<Located>,
}
