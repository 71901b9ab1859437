//! What lies over the panes and gets the keys while it is there.

use super::replay::Script;
use super::state::Row;

/// Something over the panes.
#[derive(Clone, Debug, PartialEq)]
pub enum Overlay {
    /// All keys, to be scrolled and searched.
    Help(List),
    /// The scenes, to pick one.
    Scenes(List),
    /// The layers, to switch them on and off.
    Layers(List),
    /// A line in which a value is typed.
    Entry(Entry),
    /// A pasted keystroke file, waiting for a yes.
    Offer(Script),
}

/// A list with a selected row and a search.
///
/// The view scrolls so that the selected row is seen; the session need not know the height.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// Index of the selected row among those that match.
    pub selected: usize,
    /// What the rows must contain, in any case of letters.
    pub search: String,
    /// Whether typed characters go to the search.
    pub searching: bool,
}

/// A value being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The row whose value it becomes.
    pub row: Row,
    /// What is typed so far.
    pub text: String,
    /// Characters of the text to the left of the caret.
    pub caret: usize,
    /// Why the text was refused, until it changes.
    pub refused: Option<String>,
}
