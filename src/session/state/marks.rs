//! Marks: points of the parameters to come back to, and the one that is compared with.

use std::collections::BTreeMap;

use crate::scene::Request;
use crate::session::state::setup::Setup;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    pub places: BTreeMap<char, Bookmark>,
    /// The point left last: what is compared with.
    pub left: Option<Bookmark>,
}

/// A point of the parameters, and what is drawn of it beside another.
#[derive(Clone, Debug, PartialEq)]
pub struct Bookmark {
    /// The motion, and the speed of its belt.
    pub setup: Setup,
    /// The questions for its motion and its cycles, once the point was on show.
    pub asked: Vec<Request>,
}

impl Bookmark {
    /// A point that has not been on show.
    pub fn new(setup: &Setup) -> Self {
        Bookmark { setup: *setup, asked: Vec::new() }
    }
}
