//! The mouse on something that is on show.

use crate::scene::Point;

/// What the mouse did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Its left button went down.
    Click,
    /// Its wheel turned away from the user.
    Nearer,
    /// Its wheel turned towards the user.
    Farther,
}

/// The mouse on something that is on show; which cell of the screen that is, the outer rings know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointed {
    /// What the mouse did.
    pub gesture: Gesture,
    pub place: PointerTarget,
}

/// A place on the screen that means something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointerTarget {
    /// A row of the parameter pane, counted from 0.
    Row(usize),
    /// A point of a plot, in its world coordinates; the plot by its index among those of the session.
    Plot(usize, Point),
}
