//! Playing a keystroke file, action by action.

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};

use crate::session::replay::script::{MOST, ScriptError, too_long};
use crate::session::{Instruction, Key, Msg, Script, ScriptStep};

/// The next action.
#[derive(Clone, Debug)]
pub enum Action {
    Give(Msg),
    /// Keep a picture of the screen under this name.
    Keep(String),
    /// Ask again when the session is idle.
    Wait,
    /// A task is not done yet: ask again after the next key, or give this message, which does it.
    Task(Msg),
    /// The file has ended and the session is idle.
    Done,
}

/// A keystroke file being played.
///
/// The player has no clock: it continues when its driver reports that the session is idle. Until the file says
/// `<async>`, it waits for that before each step, so that each key finds the picture that its author saw.
#[derive(Clone, Debug, Default)]
pub struct Player {
    /// The remaining steps, each with whether it is from another file.
    steps: VecDeque<(ScriptStep, bool)>,
    /// Line and column of the last step that is not.
    place: (usize, usize),
    /// Number of steps given so far and of those that remain, presses of a key one by one.
    length: u64,
    asynchronous: bool,
    /// Number of pictures kept so far.
    pictures: usize,
    /// The files that the script embeds, by name.
    files: BTreeMap<PathBuf, String>,
    /// Number of captions shown so far.
    said: usize,
    /// Number of all captions.
    captions: usize,
    /// Whether time passes in pieces, with a frame after each.
    pub in_frames: bool,
    /// Whether what does the task has been given; `None` where no task has been told.
    task: Option<bool>,
}

/// The longest such piece, in s.
const FRAME: f64 = 0.04;

/// Maximum number of pictures that are kept: one of a large screen has a million cells.
const PICTURES: usize = 1000;

/// Number of captions among steps: those that are read, answered or done.
fn captions<'a>(steps: impl Iterator<Item = &'a ScriptStep>) -> usize {
    use Instruction::{Give, Until};
    let is_caption = |located: &&ScriptStep| {
        matches!(located.step, Give(Msg::Say(..) | Msg::Ask { .. }) | Until { .. })
    };
    steps.filter(is_caption).count()
}

impl Player {
    /// Plays a file from its beginning.
    pub fn new(script: Script) -> Self {
        let (captions, length) = (captions(script.steps.iter()), script.length());
        let steps = script.steps.into_iter().map(|step| (step, false)).collect();
        Player { steps, place: (1, 1), length, captions, ..Player::default() }
    }

    /// Inserts another file before the rest of this one. Fails with [`ScriptError`] if both together have more steps
    /// than [`MOST`], as those of a file that plays itself.
    pub fn interject(&mut self, script: Script) -> Result<(), ScriptError> {
        self.length += script.length();
        if self.length > u64::from(MOST) {
            let (line, column) = self.place;
            return Err(ScriptError { line, column, why: too_long() });
        }
        self.captions += captions(script.steps.iter());
        for step in script.steps.into_iter().rev() {
            self.steps.push_front((step, true));
        }
        Ok(())
    }

    /// Number of captions shown so far.
    pub fn said(&self) -> usize {
        self.said
    }

    /// Number of captions before the next chapter; `None` in the last one.
    pub fn next_chapter(&self) -> Option<usize> {
        let begins = |(located, _): &(ScriptStep, bool)| {
            matches!(located.step, Instruction::Give(Msg::Chapter(_)))
        };
        let at = self.steps.iter().position(begins)?;
        Some(self.said + captions(self.steps.iter().take(at).map(|(located, _)| located)))
    }

    /// Whether a task waits to be done.
    pub fn has_task(&self) -> bool {
        self.task == Some(false)
    }

    /// Notes that the message that does the task has been given.
    pub fn helped(&mut self) {
        self.task = Some(true);
    }

    /// The embedded text of a file, if there is one.
    pub fn file(&self, path: &Path) -> Option<&str> {
        self.files.get(path).map(String::as_str)
    }

    /// The next action, given whether the session is idle. `screen` is called only if needed; it returns the
    /// rows of the screen, separated by newlines. Fails with [`ScriptError`] if the screen does not show an expected
    /// text; the player is then after that step.
    pub fn next(&mut self, idle: bool, screen: impl Fn() -> String) -> Result<Action, ScriptError> {
        loop {
            let Some((ScriptStep { line, column, step }, inserted)) = self.steps.front().cloned()
            else {
                return Ok(if idle { Action::Done } else { Action::Wait });
            };
            if !idle && (!self.asynchronous || step == Instruction::Wait) {
                return Ok(Action::Wait);
            }
            if !inserted {
                self.place = (line, column);
            }
            let failed = |why| Err(ScriptError { line, column, why });
            if let (Instruction::Until { task, shown, line }, told) = (&step, self.task) {
                match told {
                    None => {
                        self.task = Some(false);
                        return Ok(Action::Give(self.asked(task.clone(), None)));
                    }
                    _ if screen().contains(shown) => self.task = None,
                    Some(false) => return Ok(Action::Task(Msg::Run(line.clone()))),
                    Some(true) => return failed(format!("the screen does not show {shown:?}")),
                }
            }
            self.advance();
            match step {
                Instruction::Give(Msg::Ask { text, answer, .. }) => {
                    return Ok(Action::Give(self.asked(text, answer)));
                }
                Instruction::Async => self.asynchronous = true,
                Instruction::File { name, text } => drop(self.files.insert(name.into(), text)),
                Instruction::Screen(name) if self.pictures < PICTURES => {
                    self.pictures += 1;
                    return Ok(Action::Keep(name));
                }
                Instruction::Screen(_) => {
                    return failed(format!("more than {PICTURES} screens, the most that are kept"));
                }
                Instruction::Expect(text) if !screen().contains(&text) => {
                    return failed(format!("the screen does not show {text:?}"));
                }
                Instruction::Give(Msg::Say(text, _)) => {
                    self.said += 1;
                    return Ok(Action::Give(Msg::Say(text, Some((self.said, self.captions)))));
                }
                Instruction::Key { key, .. } => return Ok(Action::Give(Msg::Key(key))),
                Instruction::Give(Msg::Elapsed { seconds }) if self.in_frames => {
                    return Ok(Action::Give(Msg::Elapsed { seconds: seconds.min(FRAME) }));
                }
                Instruction::Give(message) => return Ok(Action::Give(message)),
                Instruction::Wait | Instruction::Expect(_) | Instruction::Until { .. } => {}
            }
        }
    }

    /// The message that asks a question or for something to be done.
    fn asked(&mut self, text: String, answer: Option<Key>) -> Msg {
        self.said += 1;
        Msg::Ask { text, answer, place: Some((self.said, self.captions)) }
    }

    /// Moves past the first step, or past one press of it.
    fn advance(&mut self) {
        match self.steps.front_mut().map(|(located, _)| &mut located.step) {
            Some(Instruction::Key { count, .. }) if *count > 1 => *count -= 1,
            Some(Instruction::Give(Msg::Elapsed { seconds }))
                if self.in_frames && *seconds > FRAME =>
            {
                *seconds -= FRAME;
            }
            _ => drop(self.steps.pop_front()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::replay::script::parse;

    #[test]
    fn a_file_that_plays_itself_comes_to_an_end_at_its_own_step() {
        for (file, itself) in
            [("\n b a", "\n\nb a"), ("\n b a<x*9>", "b a<x*9>"), ("\n b a", "a a")]
        {
            let mut player = Player::new(parse(file).unwrap());
            let mut given = 0;
            let unmet = loop {
                let Action::Give(message) = player.next(true, String::new).unwrap() else {
                    panic!("ended after {given}")
                };
                given += 1;
                if !matches!(message, Msg::Key(key) if key == "a".parse().unwrap()) {
                    continue;
                }
                if let Err(unmet) = player.interject(parse(itself).unwrap()) {
                    break unmet;
                }
            };
            assert_eq!((unmet.line, unmet.column, unmet.why), (2, 4, too_long()));
            assert!(given <= MOST && player.steps.len() <= MOST as usize, "{given}");
        }
    }
}
