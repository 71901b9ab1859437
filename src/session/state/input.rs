//! A line of text being typed: its characters and a caret. The owner decides what the text is for.

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
        let (before, after) = self.halves();
        let word = |char: char| !char.is_whitespace();
        let kept = before.trim_end().trim_end_matches(word).len();
        let (kept, after) = (before.get(..kept).unwrap_or_default(), after.to_owned());
        *self = Input::new(kept);
        self.text.push_str(&after);
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
