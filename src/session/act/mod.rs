//! The effects of commands on a session, one family of commands per file; and what they say.

pub mod answers;
pub mod compare;
pub mod copy;
pub mod files;
pub mod general;
pub mod history;
pub mod kick;
pub mod lists;
pub mod motions;
pub mod parameters;
pub mod plots;
pub mod preview;
pub mod prompt;
pub mod run;
pub mod scan;
pub mod screen_setup;
pub mod values;
pub mod walk;

use crate::session::{Done, Effect, Key, Notice, Session};

impl Session {
    /// Shows a notice that reports no refusal.
    pub(crate) fn inform(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice { error: false, text: text.into() });
    }

    /// A sentence in which each `{command}` is replaced by the key of that command.
    pub(crate) fn with_keys(&self, sentence: &str) -> String {
        self.keymap.fill(sentence, Key::said)
    }

    /// Shows such a sentence.
    pub(crate) fn inform_of_keys(&mut self, sentence: &str) {
        self.inform(self.with_keys(sentence));
    }

    /// Shows a notice that says what was refused.
    pub(crate) fn refuse(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice { error: true, text: text.into() });
    }

    /// Does something, or says why it was refused.
    pub(crate) fn attempt(&mut self, act: impl FnOnce(&mut Self) -> Done) {
        if let Err(why) = act(self) {
            self.refuse(why);
        }
    }

    /// Asks the outer rings for something.
    pub fn effect(&mut self, effect: Effect) -> Done {
        self.effects.push(effect);
        Ok(())
    }

    /// Shows what is unlikely about the numbers of the machine that was just read or typed.
    pub(crate) fn warn_of_units(&mut self) {
        if let Some(line) = self.unlikely_number() {
            self.inform(line);
        }
    }
}
