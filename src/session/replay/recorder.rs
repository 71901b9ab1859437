//! Records a live session as a keystroke file.

use crate::session::replay::script::{LONGEST, MOST};
use crate::session::{Instruction, Msg};

/// Longest line of a recorded file, in characters, unless one step is longer.
const LINE: usize = 72;

/// The beginning of the first line of a recording, by which it is recognized.
pub const HEADER: &str = "# A recording of hopfscope";

/// The actions of a user, as steps of a keystroke file.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    /// How the session was started, in words, for the heading.
    started: String,
    steps: Vec<Instruction>,
    /// Whether steps have changed since this was last asked for.
    changed: bool,
}

impl Recorder {
    /// A recording of a session that was started in this way, which begins with these steps.
    pub fn new(started: String, steps: Vec<Instruction>) -> Self {
        Recorder { started, steps, changed: true }
    }

    /// Records a message that has an equivalent in a keystroke file. Other messages, such as answers of the
    /// worker, result from these.
    pub fn note(&mut self, message: &Msg) {
        if let Some(step) = Instruction::of(message) {
            self.add(step);
        }
    }

    /// Adds a step, merged with the last one if possible.
    pub fn add(&mut self, step: Instruction) {
        use Instruction::{Give, Key};
        self.changed = true;
        match (self.steps.last_mut(), step) {
            (Some(Key { key, count }), Key { key: pressed, count: 1 })
                if *key == pressed && *count < MOST =>
            {
                *count += 1;
            }
            (Some(Give(Msg::Elapsed { seconds: passed })), Give(Msg::Elapsed { seconds }))
                if *passed + seconds <= LONGEST =>
            {
                *passed += seconds;
            }
            (Some(Give(last @ Msg::Resize { .. })), Give(size @ Msg::Resize { .. })) => {
                *last = size;
            }
            (_, step) => self.steps.push(step),
        }
    }

    pub fn steps(&self) -> &[Instruction] {
        &self.steps
    }

    /// Whether steps have changed since the last call of this function.
    pub fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Removes the last presses of keys, pastes and clicks. Resizes and the passing of time are not presses,
    /// and stay.
    pub fn forget(&mut self, presses: u32) {
        let first = self.before(presses);
        let forgotten: Vec<Instruction> = self.steps.drain(first..).collect();
        let nobodys = |step: &Instruction| matches!(step, Instruction::Give(it) if !is_press(it));
        forgotten.into_iter().filter(nobodys).for_each(|step| self.add(step));
    }

    /// Embeds the text of a file before the last presses, which ask for it, unless it is embedded already.
    pub fn embed(&mut self, name: &str, text: &str, presses: u32) {
        let known = self.steps.iter().rev().find_map(|step| match step {
            Instruction::File { name: other, text } if other == name => Some(text),
            _ => None,
        });
        if known.is_none_or(|known| known != text) {
            let at = self.before(presses);
            let file = Instruction::File { name: name.to_owned(), text: text.to_owned() };
            self.steps.insert(at, file);
        }
    }

    /// Index of the step at which the last presses begin.
    fn before(&mut self, mut presses: u32) -> usize {
        let mut at = self.steps.len();
        while presses > 0 && at > 0 {
            at -= 1;
            match &mut self.steps[at] {
                Instruction::Key { key, count } if *count > presses => {
                    *count -= presses;
                    let rest = Instruction::Key { key: *key, count: presses };
                    at += 1;
                    self.steps.insert(at, rest);
                    presses = 0;
                }
                Instruction::Key { count, .. } => presses -= *count,
                Instruction::File { .. } => {}
                Instruction::Give(message) if !is_press(message) => {}
                _ => presses -= 1,
            }
        }
        self.changed = true;
        at
    }

    /// The file so far, below comments that describe it and how the session was started.
    pub fn text(&self) -> String {
        text(&heading(&self.started), &self.steps)
    }
}

/// Whether a user does it; the size of the screen and the passing of time are nobody's doing.
fn is_press(message: &Msg) -> bool {
    !matches!(message, Msg::Resize { .. } | Msg::Elapsed { .. })
}

/// The comments at the beginning of a recording, without the comment characters.
pub fn heading(started: &str) -> String {
    format!("{}; `hopfscope replay FILE` plays it.\n{started}", &HEADER["# ".len()..])
}

/// The text of a keystroke file of these steps, below a comment.
pub fn text(comment: &str, steps: &[Instruction]) -> String {
    let lines = lines(steps).into_iter().map(|(_, line)| line);
    std::iter::once(self::comment(comment)).chain(lines).collect()
}

pub fn comment(lines: &str) -> String {
    lines.lines().flat_map(|line| ["# ", line, "\n"]).collect()
}

/// The lines of a keystroke file with their line ends, each with the index of its first step.
pub fn lines(steps: &[Instruction]) -> Vec<(usize, String)> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut length = 0;
    for (index, step) in steps.iter().enumerate() {
        let step = format!("{step}\n");
        let added = step.chars().count();
        match lines.last_mut() {
            Some((_, line)) if length + added <= LINE + 1 => {
                line.replace_range(line.len() - 1.., " ");
                line.push_str(&step);
                length += added;
            }
            _ => {
                lines.push((index, step));
                length = added;
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::session::key::{Code, Key};
    use crate::session::replay::{Action, Player, parse};

    /// The messages that a script gives to a session that is always idle.
    fn played(text: &str) -> Vec<String> {
        let mut player = Player::new(parse(text).unwrap());
        let mut given = Vec::new();
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            given.push(format!("{message:?}"));
        }
        given
    }

    #[test]
    fn a_key_that_begins_a_file_unseen_is_played() {
        let mark = Msg::Key(Key::plain(Code::Char('\u{feff}')));
        let steps: Vec<Instruction> = Instruction::of(&mark).into_iter().collect();
        assert_eq!(lines(&steps)[0].1, "<u+feff>\n");
        assert_eq!(played(&lines(&steps)[0].1), [format!("{mark:?}")]);
    }

    proptest! {
        #[test]
        fn a_recording_plays_what_was_recorded(
            keys in prop::collection::vec((crate::session::key::tests::any_key(), 1..4), 0..60)
        ) {
            let mut recorder = Recorder::default();
            let mut wanted = Vec::new();
            for (key, count) in keys {
                for _ in 0..count {
                    recorder.note(&Msg::Key(key));
                    wanted.push(format!("{:?}", Msg::Key(key)));
                }
            }
            let text = recorder.text();
            let text = text.trim_start_matches(|char| char != '\n').trim_start().to_owned();
            prop_assert!(text.lines().all(|line| line.chars().count() <= LINE));
            prop_assert_eq!(played(&text), wanted);
        }
    }
}
