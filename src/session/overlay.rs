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
    /// The views, to pick what a plot shows.
    Views(List),
    /// A line in which a value is typed.
    Entry(Entry),
    /// A pasted keystroke file, waiting for a yes.
    Offer(Script),
}

impl Overlay {
    /// The list, if it is one.
    #[must_use]
    pub fn list(&self) -> Option<&List> {
        match self {
            Overlay::Help(list)
            | Overlay::Scenes(list)
            | Overlay::Layers(list)
            | Overlay::Views(list) => Some(list),
            Overlay::Entry(_) | Overlay::Offer(_) => None,
        }
    }

    /// The list, to be changed.
    pub fn list_mut(&mut self) -> Option<&mut List> {
        match self {
            Overlay::Help(list)
            | Overlay::Scenes(list)
            | Overlay::Layers(list)
            | Overlay::Views(list) => Some(list),
            Overlay::Entry(_) | Overlay::Offer(_) => None,
        }
    }
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

impl List {
    /// Whether a row with these words is among those searched for.
    #[must_use]
    pub fn matches(&self, words: &[&str]) -> bool {
        let wanted = self.search.to_lowercase();
        words.iter().any(|word| word.to_lowercase().contains(&wanted))
    }
}

impl Entry {
    /// A line with this text, the caret behind it.
    #[must_use]
    pub fn new(row: Row, text: String) -> Self {
        Entry { row, caret: text.chars().count(), text, refused: None }
    }

    /// Byte at which a character begins.
    fn byte(&self, index: usize) -> usize {
        self.text.char_indices().nth(index).map_or(self.text.len(), |(byte, _)| byte)
    }

    /// Types a character at the caret.
    pub fn insert(&mut self, char: char) {
        let at = self.byte(self.caret);
        self.text.insert(at, char);
        self.caret += 1;
        self.refused = None;
    }

    /// Deletes the character before the caret.
    pub fn delete_before(&mut self) {
        if self.caret > 0 {
            self.caret -= 1;
            self.delete_after();
        }
    }

    /// Deletes the character after the caret.
    pub fn delete_after(&mut self) {
        let at = self.byte(self.caret);
        if at < self.text.len() {
            self.text.remove(at);
        }
        self.refused = None;
    }

    /// Moves the caret, as far as there is text.
    pub fn move_caret(&mut self, by: isize) {
        let last = self.text.chars().count();
        self.caret = self.caret.saturating_add_signed(by).min(last);
    }

    /// Deletes everything.
    pub fn clear(&mut self) {
        *self = Entry::new(self.row, String::new());
    }
}
