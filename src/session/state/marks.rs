//! Marks: points of the parameters to come back to, and the one that is compared with.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::flow::Trajectory;
use crate::scene::{Answer, Answered, Slot};
use crate::session::state::setup::Stand;
use crate::study::Cycles;

/// Marked points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// By letter.
    pub places: BTreeMap<char, Mark>,
    /// The point left last: what is compared with.
    pub left: Option<Mark>,
}

/// A point of the parameters, and what was known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The motion, and the speed of its belt.
    pub stand: Stand,
    /// The answers to its questions, as far as they were there.
    pub answers: BTreeMap<Slot, Arc<Answered>>,
}

impl Mark {
    /// A point about which nothing is known yet.
    #[must_use]
    pub fn new(stand: Stand) -> Self {
        Mark { stand, answers: BTreeMap::new() }
    }

    /// Its motion, if that was computed.
    #[must_use]
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self.answers.get(&Slot::Trajectory)?.result.as_ref().ok()? {
            Answer::Trajectory(found) => Some(found),
            _ => None,
        }
    }

    /// Its limit cycles, if those were computed.
    #[must_use]
    pub fn cycles(&self) -> Option<&Cycles> {
        match self.answers.get(&Slot::Cycles)?.result.as_ref().ok()? {
            Answer::Cycles(found) => Some(found),
            _ => None,
        }
    }
}
