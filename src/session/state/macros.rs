//! Keys recorded into registers.

use std::collections::BTreeMap;

use crate::session::replay::recorder::Recorder;
use crate::session::replay::script::Instruction;
use crate::session::state::history::Snapshot;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Macros {
    /// The recorded steps, by letter.
    pub registers: BTreeMap<char, Vec<Instruction>>,
    /// The register that is being recorded, and its steps so far.
    pub recording: Option<(char, Recorder)>,
    /// The register played last.
    pub last: Option<char>,
    /// The register that is being played.
    pub played: Option<Played>,
    /// Number of presses since nothing was open and nothing pending: they lead up to a command.
    pub chord: u32,
    /// Number of presses of the last such sequence that is complete.
    pub asked: u32,
}

/// A register that is being played; all its changes are merged into one.
#[derive(Clone, Debug, PartialEq)]
pub struct Played {
    /// Number of presses that are still to come.
    pub left: u64,
    /// Depth of the past when it began.
    pub depth: usize,
    pub before: Box<Snapshot>,
}
