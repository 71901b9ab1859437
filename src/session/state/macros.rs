//! Keys recorded into registers.

use std::collections::BTreeMap;

use crate::session::replay::recorder::Recorder;
use crate::session::replay::script::Instruction;
use crate::session::state::history::Snapshot;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Macros {
    /// What was recorded, by letter.
    pub registers: BTreeMap<char, Vec<Instruction>>,
    /// What is being recorded, and where to.
    pub recording: Option<(char, Recorder)>,
    /// The register played last.
    pub last: Option<char>,
    /// The register that is being played.
    pub played: Option<Played>,
    /// Presses since nothing was open and nothing waited for: what asks for a command and is not it.
    pub chord: u32,
    /// Presses of the last such chord that is complete.
    pub asked: u32,
}

/// A register that is being played: all its changes become one.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    /// Presses that are left of it.
    pub left: u64,
    /// How deep the past was before it.
    pub depth: usize,
    pub before: Box<Snapshot>,
}
