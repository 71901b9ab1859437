//! The mouse and its targets.

use crate::scene::Point;

/// What the mouse did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// The left button was pressed.
    Click,
    /// The wheel turned away from the user.
    Nearer,
    /// The wheel turned towards the user.
    Farther,
}

/// The mouse on a target; the outer rings determine it from the cell of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointed {
    /// What the mouse did.
    pub gesture: Gesture,
    pub place: PointerTarget,
}

/// A part of the screen that reacts to the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointerTarget {
    /// A row of the parameter pane, counted from 0.
    Row(usize),
    /// A point of a plot, in its world coordinates; the plot by its index among those of the session.
    Plot(usize, Point),
}
