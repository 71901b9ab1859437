//! Marks: points of the parameters to come back to, and the point for comparison.

use std::collections::BTreeMap;

use crate::scene::Request;
use crate::session::state::setup::Setup;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bookmarks {
    pub places: BTreeMap<char, Bookmark>,
    /// The point that was left last, for comparison.
    pub left: Option<Bookmark>,
}

/// A point of the parameters, and what is drawn of it beside the present one.
#[derive(Clone, Debug, PartialEq)]
pub struct Bookmark {
    /// The motion and the speed of its belt.
    pub setup: Setup,
    /// The questions for its motion and its cycles; empty until the point was on show.
    pub asked: Vec<Request>,
}

impl Bookmark {
    /// A point that has not been on show.
    pub fn new(setup: &Setup) -> Self {
        Bookmark { setup: *setup, asked: Vec::new() }
    }
}
