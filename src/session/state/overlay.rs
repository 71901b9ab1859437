//! What lies over the panes and gets the keys while it is there.

use crate::session::replay::script::Script;
use crate::session::state::input::Input;
use crate::session::state::rows::Row;
use crate::session::state::scan_form::ScanForm;

/// Something over the panes.
#[derive(Clone, Debug, PartialEq)]
pub enum Overlay {
    /// A list, to be scrolled and searched.
    List(Listed, List),
    /// A line in which a value is typed.
    Entry(Entry),
    /// The line in which commands are typed by name.
    Prompt(Prompt),
    /// The form in which a scan is typed.
    Scan(ScanForm),
    /// A pasted keystroke file, waiting for a yes.
    Offer(Script),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listed {
    /// The scenes, to pick one.
    Scenes,
    /// The layers, to switch them on and off.
    Layers,
    /// The views, to pick what a plot shows.
    Views,
    /// The claims of the paper.
    Paper,
    /// Everything that has a name: commands, scenes, views, layers, claims.
    Palette,
    /// What the picture costs, question by question.
    Cost,
    /// The sessions that were interrupted, to continue one.
    Interrupted,
}

impl Overlay {
    pub fn list(&self) -> Option<&List> {
        if let Overlay::List(_, list) = self { Some(list) } else { None }
    }

    /// The list, to be changed.
    pub fn list_mut(&mut self) -> Option<&mut List> {
        if let Overlay::List(_, list) = self { Some(list) } else { None }
    }

    /// Whether this is another kind of overlay than `other`, whatever stands in both.
    pub fn differs(&self, other: &Self) -> bool {
        match (self, other) {
            (Overlay::List(one, _), Overlay::List(other, _)) => one != other,
            _ => std::mem::discriminant(self) != std::mem::discriminant(other),
        }
    }
}

/// What is said in words above the status lines, without taking keys.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SessionCaption {
    #[default]
    Nothing,
    /// What there is to see in the scene, and what to press.
    Scene,
    /// A caption of a tour, and which it is of how many.
    Tour(String, Option<(usize, usize)>),
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
    pub input: Input,
    /// Why the text was refused, until it changes.
    pub refused: Option<String>,
}

/// A command being typed, by its name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Prompt {
    /// What is typed so far.
    pub input: Input,
    /// Why the text was refused, until it changes.
    pub refused: Option<String>,
    /// What the last word can become, once that was asked for.
    pub completion: Option<Completion>,
    /// How many lines back in the history the text stands; 0 for a new one.
    pub back: usize,
    /// The new line, while an old one stands in its place.
    pub draft: String,
}

/// What a word of a line can become.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The text before the word.
    pub stem: String,
    /// The words, never none.
    pub words: Vec<String>,
    /// The one that stands in the line.
    pub at: usize,
}

impl List {
    /// Whether a row with these texts, in which all searched words stand, is among those searched for.
    pub fn matches(&self, words: &[impl AsRef<str>]) -> bool {
        let words: Vec<String> = words.iter().map(|word| word.as_ref().to_lowercase()).collect();
        let found = |wanted: &str| words.iter().any(|word| word.contains(wanted));
        self.search.to_lowercase().split_whitespace().all(found)
    }
}

impl Entry {
    /// A line with this text, the caret behind it.
    pub fn new(row: Row, text: impl Into<String>) -> Self {
        Entry { row, input: Input::new(text), refused: None }
    }
}

impl Prompt {
    /// A line with this text, the caret behind it.
    pub fn new(text: impl Into<String>) -> Self {
        Prompt { input: Input::new(text), ..Prompt::default() }
    }
}
