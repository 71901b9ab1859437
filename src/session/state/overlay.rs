//! Overlays: what covers the panes and gets the keys while it is open, such as a list or a line of text being typed.

use std::collections::BTreeMap;
use std::mem::{Discriminant, discriminant};

use strum::EnumString;

use crate::scene::GlossaryEntry;
use crate::session::{Key, Row, Script};

/// An overlay over the panes.
#[derive(Clone, Debug, PartialEq)]
pub enum Overlay {
    /// The page of help, about what is open below it, to which it returns.
    Help(Option<Box<Overlay>>),
    /// A list that can be scrolled and searched.
    List(ListKind, List),
    /// A line for typing a command by name, or a value.
    Prompt(Prompt),
    /// A pasted keystroke file, waiting for confirmation.
    Offer(Script),
    /// A card that explains what is on the screen.
    Explanation(Explanation),
}

/// What is being explained: an entry of the glossary, or what the steps lead to that were taken over what is on show.
///
/// The view knows what stands where, so that the session keeps the steps alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// What is explained until the first step.
    pub entry: Option<&'static GlossaryEntry>,
    /// Steps to the next thing, and to the first of the next pane.
    pub steps: Vec<[i32; 2]>,
    /// Whether what it refers to is explained, too.
    pub more: bool,
}

/// A list over the panes; its keys have the context of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum ListKind {
    /// The scenes, to pick one.
    Scenes,
    /// The layers, to switch on and off.
    Layers,
    /// The views, to pick one for a plot.
    Views,
    /// The claims of the paper.
    Paper,
    /// Everything that can be picked by name: commands, scenes, views, layers, claims.
    #[strum(serialize = "help")]
    Palette,
    /// The cost of the picture, question by question.
    #[strum(disabled)]
    Cost,
    /// The sessions that were interrupted, to continue one.
    Interrupted,
}

impl Overlay {
    /// What kind of overlay this is, whatever it contains.
    pub fn kind(&self) -> (Discriminant<Self>, Option<ListKind>) {
        let kind = if let Overlay::List(kind, _) = self {
            Some(*kind)
        } else {
            None
        };
        (discriminant(self), kind)
    }
}

/// The caption above the status lines; it takes no keys.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SessionCaption {
    #[default]
    Nothing,
    /// What the scene shows, and what to press.
    Scene,
    /// A caption of a tour; if known, its number and the number of all captions.
    Tour(String, Option<(usize, usize)>),
    /// A question of a lesson with its answer, or a task, which has none.
    Asked(String, Option<(usize, usize)>, Option<Key>),
}

impl SessionCaption {
    /// Shows the caption of the scene, or hides it.
    pub fn explain(&mut self) {
        *self = match self {
            SessionCaption::Scene => SessionCaption::Nothing,
            _ => SessionCaption::Scene,
        };
    }
}

/// A list with a selected row and a search.
///
/// The view scrolls to the selected row, so the session need not know the height of the list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// Index of the selected row among those that match.
    pub selected: usize,
    /// Words that the rows must contain, ignoring case.
    pub search: String,
    /// Whether typed characters go to the search.
    pub searching: bool,
    /// Commands that cannot be run at present, with why not, in the list of everything.
    pub refused: BTreeMap<&'static str, String>,
}

/// A command being typed by name, or a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Prompt {
    /// The row whose value is typed; `None` for a command.
    pub row: Option<Row>,
    /// The text typed so far.
    pub input: Input,
    /// Why the text was refused, until it is changed.
    pub refused: Option<String>,
    /// Candidates for the last word, once completion was asked for.
    pub completion: Option<Completion>,
    /// How many lines back in the history the shown line is; 0 for the new line.
    pub back: usize,
    /// The new line, while an old one is shown.
    pub draft: String,
}

/// Candidates for a word of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The text before the word.
    pub stem: String,
    /// The candidates, at least one.
    pub words: Vec<String>,
    /// Index of the candidate that the line shows.
    pub at: usize,
}

impl List {
    /// Whether a row with these texts contains all searched words.
    pub fn matches(&self, words: &[impl AsRef<str>]) -> bool {
        let words: Vec<String> = words.iter().map(|word| word.as_ref().to_lowercase()).collect();
        let found = |wanted: &str| words.iter().any(|word| word.contains(wanted));
        self.search.to_lowercase().split_whitespace().all(found)
    }
}

impl Prompt {
    /// A line with this text and the caret at its end.
    pub fn new(text: impl Into<String>) -> Self {
        let input = Input { before: text.into(), after: String::new() };
        Prompt { input, ..Prompt::default() }
    }

    /// The same for the value of a row.
    pub fn of_row(row: Row, text: impl Into<String>) -> Self {
        Prompt { row: Some(row), ..Prompt::new(text) }
    }
}

/// A line of text being typed, in two parts between which the caret stands.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Input {
    pub before: String,
    pub after: String,
}

impl Input {
    /// The text typed so far.
    pub fn text(&self) -> String {
        format!("{}{}", self.before, self.after)
    }

    /// Deletes the character after the caret.
    pub fn delete_after(&mut self) {
        self.after = self.after.chars().skip(1).collect();
    }

    /// Deletes the word before the caret.
    pub fn delete_word(&mut self) {
        let kept = self.before.trim_end().trim_end_matches(|char: char| !char.is_whitespace());
        self.before.truncate(kept.len());
    }

    /// Moves the caret by `by` characters, within the text.
    pub fn move_caret(&mut self, by: isize) {
        let caret = self.before.chars().count().saturating_add_signed(by);
        let text = self.text();
        self.before = text.chars().take(caret).collect();
        self.after = text.chars().skip(caret).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_deleted_up_to_the_one_before() {
        for (text, left, kept) in [
            ("set D=1 r=2", 0, "set D=1 "),
            ("set D=1 r=2", 3, "set D=1 r=2"),
            ("set D=1  ", 0, "set "),
            ("é", 0, ""),
            ("", 0, ""),
        ] {
            let mut input = Prompt::new(text).input;
            input.move_caret(-left);
            let after = input.after.clone();
            input.delete_word();
            assert!(kept.starts_with(&input.before), "{text}: {input:?}");
            assert_eq!(input.after, after);
            if left == 0 {
                assert_eq!(input.text(), kept);
            }
        }
    }
}
