//! Overlays: what covers the panes and gets the keys while it is open, such as a list, a line of text being typed, and
//! the form for typing a scan.

use crate::model::Knob;
use crate::scan::measure::MEASURES;
use crate::session::{Row, Script};

/// An overlay over the panes.
#[derive(Clone, Debug, PartialEq)]
pub enum Overlay {
    /// A list that can be scrolled and searched.
    List(Listed, List),
    /// A line for typing a value.
    Entry(Entry),
    /// The line for typing commands by name.
    Prompt(Prompt),
    /// The form for typing a scan.
    Scan(ScanForm),
    /// A pasted keystroke file, waiting for confirmation.
    Offer(Script),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listed {
    /// The scenes, to pick one.
    Scenes,
    /// The layers, to switch on and off.
    Layers,
    /// The views, to pick one for a plot.
    Views,
    /// The claims of the paper.
    Paper,
    /// Everything that can be picked by name: commands, scenes, views, layers, claims.
    Palette,
    /// The cost of the picture, question by question.
    Cost,
    /// The sessions that were interrupted, to continue one.
    Interrupted,
}

impl Overlay {
    pub fn list(&self) -> Option<&List> {
        if let Overlay::List(_, list) = self { Some(list) } else { None }
    }

    /// The list, if it is one.
    pub fn list_mut(&mut self) -> Option<&mut List> {
        if let Overlay::List(_, list) = self { Some(list) } else { None }
    }

    /// Whether this is another kind of overlay than `other`, whatever both contain.
    pub fn differs(&self, other: &Self) -> bool {
        match (self, other) {
            (Overlay::List(one, _), Overlay::List(other, _)) => one != other,
            _ => std::mem::discriminant(self) != std::mem::discriminant(other),
        }
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
}

/// A value being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The row whose value is typed.
    pub row: Row,
    /// The text typed so far.
    pub input: Input,
    /// Why the text was refused, until it is changed.
    pub refused: Option<String>,
}

/// A command being typed by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Prompt {
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

impl Entry {
    /// A line with this text and the caret at its end.
    pub fn new(row: Row, text: impl Into<String>) -> Self {
        Entry { row, input: Input::new(text), refused: None }
    }
}

impl Prompt {
    /// A line with this text and the caret at its end.
    pub fn new(text: impl Into<String>) -> Self {
        Prompt { input: Input::new(text), ..Prompt::default() }
    }
}

/// A line of text being typed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Input {
    text: String,
    caret: usize,
}

impl Input {
    /// A line with this text and the caret at its end.
    pub fn new(text: impl Into<String>) -> Self {
        let text = text.into();
        Input { caret: text.chars().count(), text }
    }

    /// The text typed so far.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Byte offset of a character.
    fn byte(&self, index: usize) -> usize {
        self.text.char_indices().nth(index).map_or(self.text.len(), |(byte, _)| byte)
    }

    /// The text before the caret and the text after it.
    pub fn halves(&self) -> (&str, &str) {
        self.text.split_at(self.byte(self.caret))
    }

    /// Types a character at the caret.
    pub fn insert(&mut self, char: char) {
        let at = self.byte(self.caret);
        self.text.insert(at, char);
        self.caret += 1;
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
    }

    /// Deletes the word before the caret.
    pub fn delete_word(&mut self) {
        let word = |char: char| !char.is_whitespace();
        let kept = self.halves().0.trim_end().trim_end_matches(word).to_owned();
        self.replace_before(&kept);
    }

    /// Replaces the text before the caret.
    pub fn replace_before(&mut self, text: &str) {
        let after = self.halves().1.to_owned();
        *self = Input::new(text);
        self.text += &after;
    }

    pub fn clear(&mut self) {
        *self = Input::default();
    }

    /// Moves the caret by `by` characters, within the text.
    pub fn move_caret(&mut self, by: isize) {
        let last = self.text.chars().count();
        self.caret = self.caret.saturating_add_signed(by).min(last);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormField {
    /// The name of a parameter.
    Parameter,
    From,
    To,
    Count,
    Measure,
}

/// One row of [`FIELDS`].
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    pub field: FormField,
    /// Its name on the screen.
    pub name: &'static str,
    /// Explanation of what may be typed.
    pub help: &'static str,
}

const fn field(field: FormField, name: &'static str, help: &'static str) -> FieldSpec {
    FieldSpec { field, name, help }
}

const FROM: FieldSpec =
    field(FormField::From, "from", "first value; log: before it for equal ratios");
const TO: FieldSpec = field(FormField::To, "to", "last value");
const COUNT: FieldSpec = field(FormField::Count, "count", "how many values");

/// All fields of the form, in their order on the screen.
pub const FIELDS: [FieldSpec; 9] = [
    field(FormField::Parameter, "over", "D, D2, D3, r, q0 or v0"),
    FROM,
    TO,
    COUNT,
    field(FormField::Parameter, "and over", "a second parameter, or nothing"),
    FROM,
    TO,
    COUNT,
    field(FormField::Measure, "measure", "one or more, with commas between"),
];

/// The form of a scan being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScanForm {
    /// The typed texts, one for each of [`FIELDS`].
    pub inputs: [Input; 9],
    /// Index of the field with the caret.
    pub at: usize,
    /// Why the form was refused, until it is changed.
    pub refused: Option<String>,
}

impl ScanForm {
    /// Index of the field for the second parameter.
    pub const SECOND: usize = 4;

    /// The form as it opens the first time: for a sweep of this parameter over this range.
    pub fn new(symbol: Knob, (from, to): (f64, f64)) -> Self {
        let (name, from, to) = (symbol.spec().name, format!("{from:?}"), format!("{to:?}"));
        let texts = [name, &from, &to, "100", "", "", "", "20", "from-rest"];
        ScanForm { inputs: texts.map(Input::new), at: 0, refused: None }
    }

    /// The line of the field with the caret.
    pub fn input_mut(&mut self) -> &mut Input {
        &mut self.inputs[self.at]
    }

    /// The values that a field offers for selection.
    pub fn choices(at: usize) -> Vec<&'static str> {
        match FIELDS[at].field {
            FormField::Parameter => {
                let none = (at > 0).then_some("");
                none.into_iter().chain(Knob::MOTION.map(|knob| knob.spec().name)).collect()
            }
            FormField::Measure => MEASURES.map(|row| row.name).to_vec(),
            FormField::From | FormField::To | FormField::Count => Vec::new(),
        }
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
            let mut input = Input::new(text);
            input.move_caret(-left);
            let after = input.halves().1.to_owned();
            input.delete_word();
            assert!(kept.starts_with(input.halves().0), "{text}: {input:?}");
            assert_eq!(input.halves().1, after);
            if left == 0 {
                assert_eq!(input.text(), kept);
            }
        }
    }
}
